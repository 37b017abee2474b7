"""The balls that a class owns do what their figures say, and each figure has a source."""

import math
import re

import pytest

import stackbounce as sb
from stackbounce.model.catalogue import BALLS, CLASS_BALLS, KINDS, catalogue_ball, stacked
from stackbounce.model.laws.series import between

FIGURES = {"mass", "diameter", "restitution", "contact_time", "stiffness"}
NAMES = [str(entry.ball.name) for entry in CLASS_BALLS]


@pytest.mark.parametrize("entry", CLASS_BALLS, ids=NAMES)
def test_each_figure_has_a_source_and_a_kind(entry):
    assert set(dict(entry.sources)) == FIGURES
    assert all(source.strip() for _, source in entry.sources)
    assert set(dict(entry.kinds)) <= FIGURES
    assert {entry.kind_of(figure) for figure in FIGURES} <= set(KINDS)


def test_a_figure_is_measured_unless_the_table_says_otherwise():
    ball = catalogue_ball("football")
    kinds = [ball.kind_of(figure) for figure in ("mass", "restitution", "contact_time")]
    assert kinds == ["rule", "rule", "estimate"]
    assert catalogue_ball("B1").kinds == ()


@pytest.mark.parametrize("figure", ["mass", "diameter", "restitution", "contact_time"])
def test_a_figure_is_what_its_source_says(figure):
    words, derived = {
        "mass": (r"(\d+) to (\d+) g", lambda low, high: 0.5e-3 * (low + high)),
        "diameter": (r"(\d+) to (\d+) cm round", lambda low, high: 5e-3 * (low + high) / math.pi),
        "restitution": (
            r"(?:([\d.]+) to )?([\d.]+) m from ([\d.]+) m",
            lambda low, high, fall: math.sqrt(0.5 * (low + high) / fall),
        ),
        "contact_time": (r"([\d.]+) mm times v", lambda slope: 1e-3 * math.pi * slope),
    }[figure]
    found = 0
    for entry in (*BALLS, *CLASS_BALLS):
        said = re.search(words, dict(entry.sources).get(figure, ""))
        if said:
            found += 1
            given = [float(number or said[2]) for number in said.groups()]
            assert entry.to_mapping()[figure] == pytest.approx(derived(*given), rel=1e-15)
    assert found >= 4


@pytest.mark.parametrize("entry", CLASS_BALLS, ids=NAMES)
def test_a_ball_bounces_as_its_figures_say(entry):
    result = sb.simulate(sb.Drop([entry.ball], [entry.contact], height=0.7))
    assert result.rebound_ratios[0] == pytest.approx(entry.restitution, rel=1e-9)
    assert result.end_time == pytest.approx(entry.contact_time, rel=1e-9)


def test_names_differ_from_the_papers_and_are_typed_with_hyphens():
    names = [str(entry.ball.name) for entry in (*BALLS, *CLASS_BALLS)]
    assert len({name.casefold() for name in names}) == len(names)
    for entry in CLASS_BALLS:
        typed = str(entry.ball.name).replace(" ", "-")
        assert catalogue_ball(typed) is catalogue_ball(typed.upper()) is entry


@pytest.mark.parametrize("lower", ["big basketball", "B1"])
@pytest.mark.parametrize("upper", ["tennis ball", "marble"])
def test_a_pair_loses_what_both_lose_by_their_shares_of_the_work(lower, upper):
    a, b = catalogue_ball(lower), catalogue_ball(upper)
    law = stacked([lower, upper]).contacts[1]
    share = b.stiffness / (a.stiffness + b.stiffness)  # of the work, that the lower ball takes
    kept = (a.restitution if a.lossy else 1.0) ** 2, b.restitution**2
    assert law.stiffness == pytest.approx(1.0 / (1.0 / a.stiffness + 1.0 / b.stiffness), rel=1e-12)
    assert law.restitution**2 == pytest.approx(share * kept[0] + (1.0 - share) * kept[1], rel=1e-12)
    assert law.restitution == pytest.approx(between(a.contact, b.contact).restitution, rel=1e-12)


def test_a_pair_is_the_same_either_way_round():
    one, other = stacked(["football", "golf ball"]), stacked(["golf ball", "football"])
    assert one.contacts[1].stiffness == pytest.approx(other.contacts[1].stiffness, rel=1e-14)
    assert one.contacts[1].restitution == pytest.approx(other.contacts[1].restitution, rel=1e-14)
    assert one.contact_sources[1] == "football and golf ball in series"


def test_the_papers_balls_keep_their_springs_beside_a_classs():
    chosen = stacked(["basketball", "tennis", "superball"])
    assert chosen.contacts[:2] == (sb.Spring(2500.0), sb.Spring(1000.0))
    assert chosen.contacts[2].restitution < 1.0


def test_the_balls_are_a_mapping_and_a_table():
    assert len(sb.balls) == len(list(sb.balls)) == len(BALLS) + len(CLASS_BALLS)
    assert all(sb.balls[name].name == name for name in sb.balls)
    assert "Tennis-Ball" in sb.balls
    with pytest.raises(KeyError, match="'tenis'; did you mean tennis"):
        sb.balls["tenis"]
    assert repr(sb.balls).splitlines()[2].split()[:2] == ["basketball", "150"]
    assert ">golf ball</th>" in sb.balls._repr_html_()


def test_a_stack_has_the_numbers_that_are_given_and_those_of_the_catalogue():
    drop = sb.stack("b1", "B2", "tennis ball", gravity=9.81, velocities=[-1, "-2 m/s", 0])
    assert (drop.gaps, drop.velocities, drop.gravity) == ((1e-3, 0.0), (-1.0, -2.0, 0.0), 9.81)
    assert drop.contacts == stacked(["B1", "B2", "tennis ball"]).contacts
    drop = sb.stack("B1", "B2", gap="2 mm").replace(height=2.0)
    assert drop == sb.stack("B1", "B2", gaps=[2e-3], height="2 m")
    with pytest.raises(ValueError, match="gap and gaps: only one of the two can be given"):
        sb.stack("B1", "B2", gap=0.0, gaps=[0.0])
