"""Two balls on nonlinear or damped contacts in lanes: closed forms, energy, the general engine."""

import math

import numpy as np
import pytest

import stackbounce as sb
from batches import bits, in_lanes, numbers_of, pairs, rigid_pairs, swept, swept_in_lanes
from stackbounce.engine import codes, pair_series, pair_step, two_springs
from stackbounce.engine.elementary import quick_log, swift_exp, swift_log
from stackbounce.engine.memory import FINITE, lane_workspace
from stackbounce.engine.pairs import run_linear, run_pairs
from stackbounce.engine.records import SCRATCH, Drops
from stackbounce.run.batch import new_outcomes
from stackbounce.run.engines import choose_lanes
from stackbounce.run.options import Options, run_options
from stackbounce.run.paths import base_rows, number_at

HERTZ = sb.Drop([sb.Ball(0.15), sb.Ball(0.057)], [sb.Hertz(1e6)] * 2, impact_speed=2.0)
LIMIT = 1_000_000
COUNTS = [(3000, False), (1000, True), pytest.param(8000, False, marks=pytest.mark.slow)]
ENTRIES = [(run_pairs, codes.PAIR_FORMS, 1e-6), (run_linear, codes.LINEAR_FORMS, LIMIT)]


@pytest.mark.parametrize(
    ("entry", "forms", "digits"),
    [*((*ENTRIES[0][:2], digits) for digits in (3, 6, 9, 12)), (*ENTRIES[1][:2], 12)],
)
@pytest.mark.parametrize(("count", "gravity"), COUNTS)
def test_as_the_general_engine(entry, forms, digits, count, gravity):
    """Under gravity a few drops come to rest or swing on."""
    drops, rtol = pairs(count, digits, 1.5, gravity, forms), 10.0**-digits
    work = 10**7 if gravity else 10**12
    out = in_lanes(entry.__name__, drops, rtol if entry is run_pairs else LIMIT)
    exact = swept(FINITE, drops, (math.inf, 1e-13, LIMIT, work))
    whole, _ = swept_in_lanes(entry.__name__, drops, Options(math.inf, rtol, LIMIT, work))
    ended = (exact.status == codes.FINISHED) & (whole.status == codes.FINISHED)
    assert ended.mean() > (0.99 if gravity else 0.9999)
    assert np.array_equal(whole.collisions[ended], exact.collisions[ended])
    known = (out.status == codes.FINISHED) & ended
    assert known.mean() > (0.9 if rtol < 1e-9 else 0.95)  # long ones are not solved again there
    error = np.abs(whole.rebound_ratio - exact.rebound_ratio).max(axis=1)[ended]
    assert np.median(error) < 0.1 * rtol
    assert np.max(error) < 10.0 * rtol
    last = np.nanmax(exact.last_release[known], axis=1)[:, None]
    for name in ("first_touch", "last_release"):
        time, right = getattr(out, name)[known], getattr(exact, name)[known]
        assert np.array_equal(np.isnan(time), np.isnan(right))
        assert np.nanquantile(np.abs(time - right) / last, 0.98) < 10.0 * rtol


@pytest.mark.parametrize(
    "numbers",  # masses, stiffnesses, exponents, losses, gap, speed, rtol
    [
        # a short cycle; four cycles inside one another; a contact that nearly opens
        (0.410271, 2.21153, 234400.0, 231257.0, 1.0, 1.0, 1.81903, 1.01857, 0.0, 0.746102, 1e-4),
        (0.0426, 0.186, 4.95e6, 75800.0, 1.0, 1.0, 4.894, 1.99, 0.0, 0.192, 1e-6),
        (0.777318, 0.0769091, 1.7144e7, 376391.0, 2.2, 1.0, 2.25741, 0.0, 8.1127e-9, 2.96849, 1e-6),
    ],
)
def test_hard_cycles_of_hysteresis(numbers):
    mass, stiffness, exponent, loss = np.reshape(numbers[:8], (4, 1, 2))
    gap, speed, rtol = numbers[8:]
    form = np.where(loss > 0.0, codes.HYSTERETIC, codes.POWER)
    given = mass, form, stiffness, exponent, loss, 0.0 * loss, np.array([[0.0, gap]])
    drops = Drops(*given, np.full((1, 2), -speed), np.zeros(1))
    exact = swept(FINITE, drops, (math.inf, 1e-13, LIMIT, 10**12))
    out, _ = swept_in_lanes("run_pairs", drops, Options(math.inf, rtol, LIMIT, 10**12))
    assert np.array_equal(out.collisions, exact.collisions)
    assert out.rebound_ratio == pytest.approx(exact.rebound_ratio, abs=rtol)


def test_a_dashpot_that_opens_by_less_than_the_error_does_not_touch_again():
    drops = numbers_of(pairs(50_000, 33, 1.5), slice(3973, 3974))
    out, _ = swept_in_lanes("run_pairs", drops, Options(math.inf, 1e-3, LIMIT, 10**12))
    assert out.collisions.tolist() == [[1, 1]]


@pytest.mark.parametrize("rtol", [1e-4, 1e-8, 1e-12])
def test_energy_is_kept(rtol):
    drops = pairs(2000, seed=4, reach=2.0)
    drops = drops._replace(form=np.full_like(drops.form, codes.POWER))
    out = in_lanes("run_pairs", drops, rtol)
    known = out.status == codes.FINISHED
    assert known.mean() > 0.8
    error = np.abs(out.energy_retained - 1.0)[known]
    assert np.median(error) < 2.0 * rtol
    assert np.quantile(error, 0.98) < 20.0 * rtol


@pytest.mark.parametrize("rtol", [1e-4, 1e-8, 1e-12])
def test_separate_collisions_have_a_closed_form(rtol):
    """The gap is so wide that the upper ball meets the lower one after its bounce."""
    drops = pairs(500, seed=5, reach=1.0)
    hertz = {"form": np.full_like(drops.form, codes.POWER), "second": np.full((500, 2), 1.5)}
    drops = drops._replace(gap=np.tile([0.0, 1e3], (500, 1)), **hertz)
    out = in_lanes("run_pairs", drops, rtol)
    lower, upper, speed = *drops.mass.T, -drops.velocity[:, 0]
    known = (out.status == codes.FINISHED) & (3.0 * upper > lower) & (out.collisions[:, 1] == 1)
    final = np.column_stack([lower - 3.0 * upper, 3.0 * lower - upper])
    final /= (lower + upper)[:, None]
    twice = out.collisions[:, 0] == 2
    final[twice, 0] *= -1.0
    assert known.sum() > 100
    error = np.abs(out.rebound_ratio - final)[known]
    assert error.max() < 2.0 * rtol
    # Hertz: R. Cross, Am. J. Phys. 67, 222 (1999); from m v'' = -k x^1.5
    root = (lower**2 / (drops.first[:, 0] ** 2 * speed)) ** 0.2
    contact_time = 2.0 * 1.25**0.4 * root * math.sqrt(math.pi)
    contact_time *= math.gamma(1.4) / math.gamma(0.9)
    once = known & ~twice
    assert out.last_release[once, 0] == pytest.approx(contact_time[once], rel=10.0 * rtol)


@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.2])
def test_the_balls_touch_at_any_time_while_the_floor_presses(exponent):
    gaps = 1e-3 * np.concatenate([10.0 ** np.linspace(-6.0, -1.0, 100), np.linspace(0.1, 8.0, 400)])
    one = np.ones((500, 2))
    numbers = numbers_of(pairs(1, seed=1), np.zeros(500, dtype=int))
    law = {"first": one * [1e6, 2e6] * 1e-3 ** (1.5 - exponent), "second": exponent * one}
    law |= {"mass": one * [0.15, 0.057], "form": np.full((500, 2), codes.POWER)}
    gap = np.column_stack([np.zeros(500), gaps])
    drops = numbers._replace(velocity=-one, gap=gap, **law)
    exact = swept(FINITE, drops, (math.inf, 1e-13, LIMIT, 10**12))
    out = in_lanes("run_pairs", drops, 1e-12)
    done = out.status == codes.FINISHED
    assert done.mean() > 0.95
    assert np.array_equal(out.collisions[done], exact.collisions[done])
    assert out.rebound_ratio[done] == pytest.approx(exact.rebound_ratio[done], abs=1e-11)
    assert out.first_touch[done] == pytest.approx(exact.first_touch[done], rel=1e-10, nan_ok=True)


@pytest.mark.parametrize(("entry", "forms", "limit"), ENTRIES)
def test_a_drop_does_not_depend_on_the_others(entry, forms, limit):
    drops = pairs(700, seed=6, forms=forms)
    chosen = np.random.default_rng(1).permutation(700)
    some = (numbers_of(drops, rows) for rows in (slice(None), chosen, slice(13, 14)))
    whole, mixed, alone = (in_lanes(entry.__name__, each, limit) for each in some)
    done = whole.status == codes.FINISHED
    assert done[13]
    for array, other, single in zip(whole, mixed, alone, strict=True):
        kept = done[chosen]
        assert bits(array[chosen][kept]) == bits(other[kept])
        assert bits(array[13:14]) == bits(single)


@pytest.mark.parametrize("gravity", [False, True])
@pytest.mark.parametrize(("entry", "forms", "limit"), ENTRIES)
def test_plain_python_and_compiled_code(entry, forms, limit, gravity):
    drops = pairs(24, seed=7, reach=1.0, gravity=gravity, forms=forms)
    out, compiled = new_outcomes(24, 2), in_lanes(entry.__name__, drops, limit)
    with np.errstate(all="ignore"):
        entry(drops, limit, out, lane_workspace(compiled=False))
    done = out.status == codes.FINISHED
    assert done.sum() > 15
    assert bits(out.status) == bits(compiled.status)
    for array, other in zip(out, compiled, strict=True):
        assert bits(array[done]) == bits(other[done])


@pytest.mark.parametrize("scale", [1e-300, 1e-150, 1e150, 1e300])
@pytest.mark.parametrize("name", ["mass", "first", "velocity", "gap"])
@pytest.mark.parametrize("kind", ["rigid", "linear", "pairs"])
def test_extremes_are_right_or_left_to_the_general_engine(name, scale, kind):
    forms = codes.LINEAR_FORMS if kind == "linear" else codes.PAIR_FORMS
    drops = rigid_pairs(60, 8, least=0.7) if kind == "rigid" else pairs(60, 8, 1.0, forms=forms)
    factor = [1.0, scale] if kind == "rigid" and name == "mass" else scale
    drops = drops._replace(**{name: getattr(drops, name) * factor})
    entries = {"rigid": "run_two_rigid", "linear": "run_linear", "pairs": "run_pairs"}
    out = in_lanes(entries[kind], drops, 1e-6 if kind == "pairs" else 10_000)
    done = out.status == codes.FINISHED
    assert np.isin(out.status, [codes.FINISHED, codes.ASK]).all()
    assert np.isfinite(out.rebound_ratio[done]).all()
    retained = out.energy_retained[done & (drops.form == codes.POWER).all(axis=1)]
    assert retained == pytest.approx(1.0, abs=1e-4)


def test_a_drop_with_very_many_contacts_is_left_to_the_general_engine():
    drop = HERTZ.replace(balls=[sb.Ball(1e-10), sb.Ball(1.0)], gaps=[1e4])
    assert in_lanes("run_pairs", base_rows(drop, 1), 1e-4).status.tolist() == [codes.ASK]


def test_all_engines_in_lanes_have_room():
    assert max(pair_step.SLOTS, pair_series.SLOTS, two_springs.SLOTS) <= SCRATCH


@pytest.mark.parametrize(
    ("changes", "options", "varied", "lanes"),
    [
        ({}, {}, [], "run_pairs"),
        ({"contacts": [sb.Spring(1e4)] * 2}, {}, [], "run_two_springs"),
        ({"contacts": [sb.Spring(1e4), sb.Dashpot(1e4, 1.0)]}, {}, ["gaps.0"], "run_linear"),
        ({"contacts": [sb.Hertz(1e6), sb.Dashpot(1e4, 1.0)]}, {}, [], "run_pairs"),
        ({"contacts": [sb.Hertz(1e6), sb.StandardLinearSolid(1e4, 0.5, 2e-3)]}, {}, [], None),
        ({"contacts": [sb.PowerLaw(1e4, 1.0)] * 2}, {}, ["contacts.0.exponent"], "run_pairs"),
        ({"contacts": [sb.Hysteretic(1e4, restitution=0.8)] * 2}, {}, [], "run_pairs"),
        ({"contacts": [sb.Hysteretic(1e4, restitution=0.8)] * 2}, {"rtol": 1e-12}, [], None),
        ({"contacts": [sb.Hertz(1e6), sb.HollowBall(1e4, 0.01, 0.5, 0.9)]}, {}, [], None),
        ({"contacts": [sb.Rigid(0.8)] * 2}, {}, ["balls.0.mass"], "run_two_rigid"),
        ({"contacts": [sb.Rigid(0.8), sb.RigidBySpeed(0.8, speed=1.0)]}, {}, [], None),
        ({"contacts": [None, sb.Hertz(1e6)], "velocities": [1.0, -1.0]}, {}, [], None),
        ({"gravity": 9.8}, {}, [], "run_pairs"),
        ({}, {}, ["gravity"], "run_pairs"),
        ({"contacts": [sb.Spring(1e4)] * 2}, {}, ["gravity"], "run_linear"),
        ({"contacts": [sb.Rigid(0.8)] * 2, "gravity": 9.8}, {}, [], None),
        ({}, {"until": 1.0}, [], None),
        ({}, {"rtol": 1e-14}, [], None),
        ({}, {"event_limit": 100}, [], None),
        ({"velocities": [-2.0, -2.0]}, {}, ["velocities.1"], None),
    ],
)
def test_which_sweeps_run_in_lanes(changes, options, varied, lanes):
    if "velocities" in changes:
        changes = changes | {"impact_speed": None}
    drop = HERTZ.replace(**changes)
    numbers = [number_at(drop, path) for path in varied]
    options = {"until": None, "rtol": 1e-9, "event_limit": LIMIT} | options
    assert choose_lanes(drop, numbers, run_options(drop, *options.values())) == lanes


def test_a_swift_power_and_a_quick_logarithm():
    random = np.random.default_rng(2)
    bases, exponents = 10.0 ** random.uniform(-12, 3, 500), random.uniform(0.01, 4.0, 500)
    for x, y in zip(bases, exponents, strict=True):
        bound = 3e-16 * (2.0 + abs(y * math.log(x)))
        assert swift_exp(y * swift_log(x)) == pytest.approx(x**y, rel=bound)
        assert quick_log(x) == pytest.approx(math.log(x), abs=3e-16 * (1.0 + abs(math.log(x))))
    assert swift_exp(2.0 * swift_log(0.0)) < 1e-300
