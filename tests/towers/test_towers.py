"""Gaps from touching to separate, stacks in order, and the masses in between."""

import dataclasses
import itertools
import math
import tomllib

import numpy as np
import pytest

import stackbounce as sb
from stackbounce import plots
from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.model.catalogue import catalogue_ball
from stackbounce.model.laws.series import between
from stackbounce.run.collision import separate
from stackbounce.towers.masses import solve_drops
from stackbounce.towers.separation import replace_gaps


def pair(lower, upper, laws, **options):
    return sb.Drop([sb.Ball(lower), sb.Ball(upper)], laws, **({"impact_speed": 1.0} | options))


SPRINGS = [sb.Spring(1.0)] * 2
FAST = {  # a restitution that does not depend on the speed: the textbook is met
    "springs": pair(2.0, 1.0, [sb.Spring(1.0), sb.Spring(0.3)]),
    "light below": pair(0.1, 1.0, SPRINGS),
    "hertz": pair(1.0, 0.5, [sb.Hertz(1.0)] * 2),
    "dashpot": pair(1.0, 1.0, [sb.Dashpot(1.0, 0.2)] * 2),
    "hysteretic": pair(1.0, 0.4, [sb.Hysteretic(1.0, restitution=0.8), sb.Spring(0.5)]),
    "three": sb.Drop([sb.Ball(m) for m in (3.0, 1.5, 0.4)], [sb.Spring(1.0)] * 3, impact_speed=1.0),
    "row": sb.Drop([sb.Ball(1.0)] * 3, [None, *SPRINGS], velocities=[1.0, 0.0, 0.0]),
}
SLOW = {  # a restitution that does
    "viscoelastic": pair(1.0, 0.5, [sb.Viscoelastic(1.0, 0.1)] * 2),
    "hunt-crossley": pair(1.0, 0.5, [sb.HuntCrossley(1.0, 1.5, 0.2)] * 2),
}


@pytest.mark.fast_cases(2)
@pytest.mark.parametrize("drop", (FAST | SLOW).values(), ids=FAST | SLOW)
def test_nothing_changes_from_there_on_and_something_just_before(drop):
    limit = sb.separation_limit(drop)

    def intervals(share):
        result = sb.simulate(replace_gaps(drop, None, share * limit))
        return result.rebound_ratios, result.intervals["end"] - result.intervals["start"]

    ratios, lasting = intervals(1.0)
    for share in (1.5, 50.0):
        assert intervals(share)[0] == pytest.approx(ratios, abs=1e-9)
        assert intervals(share)[1] == pytest.approx(lasting, rel=1e-6)
    assert np.abs(intervals(0.9)[0] - ratios).max() > 1e-9
    if drop in FAST.values():
        textbook = sb.simulate(separate(replace_gaps(drop, None, limit)))
        assert ratios == pytest.approx(textbook.rebound_ratios, abs=1e-9)


def test_equal_balls_on_equal_springs_are_separate_after_half_a_period():
    assert sb.separation_limit(pair(1.0, 1.0, SPRINGS)) == pytest.approx(math.pi, rel=1e-12)
    drop = pair(4.0, 1.0, [sb.Spring(9.0)] * 2, impact_speed=2.0)  # m2 < m1
    half = math.pi * math.sqrt(4.0 / 9.0)
    assert sb.separation_limit(drop) == pytest.approx(2.0 * half, rel=1e-12)


def test_a_dashpot_is_waited_for_until_its_compression_is_gone():
    """When the floor's force ends the compression goes on at a constant rate for b/k."""
    law = sb.Dashpot(1.0, 0.2)
    time = sb.contact_time(law, mass=5.0) + law.damping / law.stiffness
    limit = sb.separation_limit(pair(5.0, 1.0, [law, sb.Spring(0.01)]))
    assert limit == pytest.approx(time, rel=1e-9)  # the upper ball came down at 1 m/s


def test_collisions_without_end_are_never_separate():
    laws = [sb.Hysteretic(1.0, restitution=0.5)] * 2
    assert sb.separation_limit(pair(1.0, 10.0, laws)) == math.inf


def test_touches_of_round_off_do_not_count():
    """The cannon's lower balls come to rest but for round-off: they touch again, much later."""
    balls = [sb.Ball(m) for m in (0.3, 0.1, 0.05)]
    drop = sb.Drop(balls, [sb.Hertz(1e9)] * 3, impact_speed=1.0)
    assert 0.0 < sb.separation_limit(drop) < 1e-2


def test_one_gap_varies_and_the_others_stay():
    balls = [sb.Ball(m) for m in (3.0, 1.0, 0.5)]
    drop = sb.Drop(balls, [sb.Spring(1.0)] * 3, [0.3, 0.2], impact_speed=1.0)
    limit = sb.separation_limit(drop, 1)
    ratios = [
        sb.simulate(dataclasses.replace(drop, gaps=[0.3, share * limit])).rebound_ratios
        for share in (0.98, 1.0, 30.0)
    ]
    assert ratios[1] == pytest.approx(ratios[2], abs=1e-9)
    assert ratios[0] != pytest.approx(ratios[2], abs=1e-9)


@pytest.mark.parametrize(
    ("drop", "options", "message"),
    [
        (sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], height=1.0), {}, "two or more for a gap, got 1"),
        (pair(1.0, 1.0, [sb.Rigid(1.0)] * 2), {}, "finite ones, such as Spring, got Rigid"),
        (pair(1.0, 1.0, SPRINGS, gravity=9.81), {}, "gravity must be 0, got 9.81"),
        (pair(1.0, 1.0, [None, sb.Spring(1.0)]), {}, "contacts that close"),
        (pair(1.0, 1.0, SPRINGS), {"only": 1}, "only must be a whole number from 0 to 0, got 1"),
        ("basketball", {}, "drop must be a Drop"),
    ],
)
def test_what_has_no_limit_is_refused(drop, options, message):
    with pytest.raises((InvalidValue, InvalidType), match=message):
        sb.separation_limit(drop, **options)


def test_stacks_are_as_simulated_and_in_order():
    ds = sb.highest(["tennis", "B1", "B2"], 2, gaps=[0.001, 0.0], law=sb.Spring, impact_speed=3.0)
    assert ds.sizes == {"stack": 6, "gap": 2, "ball": 2, "contact": 2}
    for i, gap in [(0, 0), (3, 1), (5, 0)]:
        lower, upper = (catalogue_ball(name) for name in ds.balls.values[i])
        floors = [
            sb.calibrate(sb.Spring, mass=one.ball.mass, contact_time=one.contact_time)
            for one in (lower, upper)
        ]
        laws = [floors[0], between(*floors)]
        drop = sb.Drop([lower.ball, upper.ball], laws, [float(ds.gap[gap])], impact_speed=3.0)
        result = sb.simulate(drop)
        row = ds.isel(stack=i, gap=gap)
        assert row.rebound_ratio.values == pytest.approx(result.rebound_ratios, abs=1e-12)
        assert (row.collisions == result.collisions).all()
        top = result.rebound_ratios[1]
        assert float(row.height_ratio) == pytest.approx(top**2)
        masses = [ball.mass for ball in drop.balls]
        assert float(row.energy_share) == pytest.approx(masses[1] * top**2 / sum(masses))
    top = ds.rebound_ratio.isel(ball=-1)
    assert (np.diff(top.isel(gap=0)) <= 0.0).all()
    for gap in range(2):
        order = np.argsort(-top.isel(gap=gap).values)
        assert ds.place.values[order, gap].tolist() == [1, 2, 3, 4, 5, 6]


def test_how_many_stacks_there_are():
    assert sb.highest(["B1", "B2", "B3"], 2, gaps=[0.0]).sizes["stack"] == 6
    assert sb.highest(["B1", "B2", "B3"], 2, gaps=[0.0], repeat=True).sizes["stack"] == 9
    assert sb.highest(["B1", "B1", "B2"], 2, gaps=[0.0]).sizes["stack"] == 3  # equal ones once


def test_balls_of_ones_own_and_of_different_laws():
    heavy = sb.Drop([sb.Ball(0.5, name="heavy")], [sb.Hysteretic(5e4, restitution=0.9)], height=1.0)
    light = sb.Drop([sb.Ball(0.05)], [sb.Spring(2e4)], height=1.0)
    ds = sb.highest([heavy, light, "B2"], 2, gaps=[0.0])
    names = sorted(map(tuple, ds.balls.values.tolist()))
    assert names == sorted(itertools.permutations(["heavy", "ball 1", "B2"], 2))
    row = ds.isel(stack=[list(one) == ["heavy", "ball 1"] for one in ds.balls.values].index(True))
    drop = sb.Drop(
        [heavy.balls[0], light.balls[0]],
        [heavy.contacts[0], between(heavy.contacts[0], light.contacts[0])],
        impact_speed=ds.impact_speed,
    )
    assert row.rebound_ratio.values[0] == pytest.approx(sb.simulate(drop).rebound_ratios, abs=1e-12)


@pytest.mark.parametrize(
    ("arguments", "error", "message"),
    [
        ({"balls": ["B1", "B2"], "count": 3}, InvalidValue, "whole number from 2 to 2, got 3"),
        ({"balls": ["B1"]}, InvalidValue, "balls must be two or more, unless they repeat, got 1"),
        ({"count": 1}, InvalidValue, "count of balls must be a whole number from 2 to 5, got 1"),
        ({"balls": ["B1", 3]}, InvalidType, "balls.1 must be a name of the catalogue or a Drop"),
        ({"balls": [FAST["springs"]]}, InvalidValue, "balls.0 must be a drop of one ball"),
        ({"law": sb.Rigid}, InvalidValue, "law must be one with a stiffness"),
        ({"law": sb.HuntCrossley}, InvalidValue, "basketball and tennis: .*dissipation"),
        ({"count": 8, "repeat": True}, InvalidValue, "at most 100000 drops, got 390625 of 5 balls"),
        ({"gaps": [0.0, 0.0]}, InvalidValue, "gaps must be different ones"),
        ({"gaps": 0.0}, InvalidType, "gaps must be a list"),
    ],
)
def test_what_makes_no_stacks_is_refused(arguments, error, message):
    with pytest.raises(error, match=message):
        sb.highest(**arguments)


def test_many_drops_of_several_kinds_keep_their_order():
    drops = [
        pair(1.0, 0.5, SPRINGS),
        pair(2.0, 0.5, [sb.Hertz(1.0), sb.Spring(2.0)]),
        pair(1.0, 0.7, SPRINGS),
        pair(1.0, 0.5, [sb.Hysteretic(1.0, unloading_exponent=3.0), sb.Spring(1.0)]),
        pair(1.0, 0.5, [sb.Hysteretic(1.0, restitution=0.5), sb.Spring(1.0)]),
        *(pair(1.0, 0.5, [sb.Tabulated([0, 9], [0, k]), sb.Spring(1.0)]) for k in (9.0, 18.0)),
    ]
    for row, drop in zip(solve_drops(drops).rebound_ratio.values, drops, strict=True):
        assert row == pytest.approx(sb.simulate(drop).rebound_ratios, abs=1e-12)


@pytest.mark.fast_cases(2)
@pytest.mark.parametrize("restitution", [1.0, 0.8])
@pytest.mark.parametrize("count", [3, 4])
def test_rigid_balls_are_best_with_geometric_means(count, restitution):
    balls = [sb.Ball(1.0)] + [sb.Ball(0.5)] * (count - 2) + [sb.Ball(0.01)]
    best = sb.best_masses(sb.Drop(balls, [sb.Rigid(restitution)] * count, impact_speed=1.0))
    masses = [ball.mass for ball in best.balls]
    assert masses == pytest.approx(np.geomspace(1.0, 0.01, count), rel=1e-5)
    gained = np.prod([(1.0 + restitution) / (1.0 + b / a) for a, b in itertools.pairwise(masses)])
    top = (1.0 + restitution) * gained - 1.0
    assert sb.simulate(best).rebound_ratios[-1] == pytest.approx(top, abs=1e-9)


@pytest.mark.fast_cases(1)
@pytest.mark.parametrize("law", [sb.Spring(1e4), sb.Hertz(1e6)])
def test_no_other_mass_is_better(law):
    balls = [sb.Ball(1.0), sb.Ball(0.5), sb.Ball(0.01)]
    drop = sb.Drop(balls, [law] * 3, impact_speed=1.0)
    best = sb.best_masses(drop)
    own = sb.simulate(best).rebound_ratios[-1]
    others = sb.sweep(drop, {"balls.1.mass": np.geomspace(0.01, 1.0, 4001)}).rebound_ratio[:, -1]
    assert own >= float(others.max())
    assert own == pytest.approx(float(others.max()), abs=1e-4)
    assert best.balls[1].mass > 0.2  # and not the geometric mean, 0.1


@pytest.mark.slow
def test_contacts_may_depend_on_the_masses():
    seen = []

    def contacts(balls):
        seen.append(balls)
        return [sb.Spring(1e4 * ball.mass) for ball in balls]

    balls = [sb.Ball(1.0), sb.Ball(0.5, diameter=0.1), sb.Ball(0.01)]
    best = sb.best_masses(sb.Drop(balls, [sb.Spring(1.0)] * 3, impact_speed=1.0), contacts)
    middle = best.balls[1]
    assert best.contacts[1].stiffness == 1e4 * middle.mass
    assert middle.mass / middle.diameter**3 == pytest.approx(0.5 / 0.1**3)
    assert len(seen) > 100


def test_a_given_stack_is_ranked_with_its_best_masses():
    balls = [sb.Ball(1.0), sb.Ball(0.5, name="middle"), sb.Ball(0.01)]
    drop = sb.Drop(balls, [sb.Rigid(1.0)] * 3, [0.01, 0.02], impact_speed=2.0)
    ds = sb.highest(drop, masses=(0.2, 0.4))
    assert ds["stack"].values.tolist() == [
        "ball 0 + 100 g + ball 2 (geometric means)",
        "ball 0 + 200 g + ball 2 (best masses)",
        "ball 0 + middle + ball 2",
    ]
    best = sb.Drop.from_mapping(tomllib.loads(ds.attrs["best"]))
    assert best.balls[1].mass == ds.mass.values[1, 1] == pytest.approx(0.2)
    assert (best.gaps, ds.impact_speed) == (drop.gaps, 2.0)
    assert (ds.attrs["within"], ds.attrs["at_the_end"]) == ((0.2, 0.4), [1])
    assert np.isnan(ds.gap).all()
    assert ds.rebound_ratio.values[2, 0] == pytest.approx(sb.simulate(drop).rebound_ratios)
    assert plots.highest(ds).axes[0].get_legend().get_texts()[0].get_text() == "with its own gaps"


def test_masses_are_best_at_the_first_gap():
    balls = [sb.Ball(1.0), sb.Ball(0.5), sb.Ball(0.01)]
    drop = sb.Drop(balls, [sb.Spring(1e4)] * 3, impact_speed=1.0)
    ds = sb.highest(drop, gaps=[0.003, 0.0], masses=True)
    best = ds.isel(stack=0)
    assert str(best["stack"].values).endswith("(best masses)")
    assert best.place.values.tolist() == [1, 2]
    assert float(best.mass[1]) == sb.best_masses(replace_gaps(drop, None, 0.003)).balls[1].mass
    assert (ds.attrs["at_the_end"], ds.attrs["within"]) == ([], (0.01, 1.0))


@pytest.mark.parametrize(
    ("masses", "options", "error", "message"),
    [
        ([1.0, 0.1], {}, InvalidValue, "balls must be three or more, got 2"),
        ([1.0, 0.1, 1.0], {}, InvalidValue, "outer masses that differ, unless within is given"),
        ([1.0, 0.1, 0.1], {"within": (2.0, 1.0)}, InvalidValue, "the smaller first, got 2.0 and"),
        ([1.0, 0.1, 0.1], {"within": 3.0}, InvalidType, "within must be a list, got 3.0"),
        ([1.0, 0.1, 0.1], {"contacts": [1]}, InvalidType, "contacts must be a function"),
    ],
)
def test_masses_that_make_no_search_are_refused(masses, options, error, message):
    balls = [sb.Ball(mass) for mass in masses]
    drop = sb.Drop(balls, [sb.Spring(1e4)] * len(balls), impact_speed=1.0)
    with pytest.raises(error, match=message):
        sb.best_masses(drop, **options)


def test_the_picture_of_stacks_shows_the_best_above():
    ds = sb.highest(["B1", "B2", "B3"], 2)
    (axes,) = plots.highest(ds).axes
    names = [text.get_text() for text in axes.get_yticklabels()]
    assert names == [" + ".join(stack) for stack in ds.balls.values] == ds["stack"].values.tolist()
    assert axes.get_ylim()[0] > axes.get_ylim()[1]
    assert np.array_equal(axes.get_lines()[0].get_xdata(), ds.height_ratio.isel(gap=0))


def test_pictures_of_something_else_are_refused():
    with pytest.raises(InvalidType, match="data must be a Dataset from"):
        plots.highest(sb.sweep(pair(1.0, 1.0, SPRINGS), {"balls.0.mass": [1.0, 2.0]}))
    many = sb.highest(["B1", "B2"], 2, gaps=list(np.linspace(0.0, 0.01, 9)))
    with pytest.raises(InvalidValue, match="at most 8 gaps, got 9"):
        plots.highest(many)
