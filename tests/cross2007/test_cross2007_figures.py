"""The paper's figures and tables, recomputed."""

import xml.etree.ElementTree as ET

import numpy as np
import pytest

import stackbounce as sb
from stackbounce.cross2007 import PAPER, changed
from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.cases import list_cases
from stackbounce.cross2007.drops import bisect, force_above, peak_times, spring_pair
from stackbounce.cross2007.figures_models import after_collision, sample_forces
from stackbounce.cross2007.report import FIGURES, figure, table
from stackbounce.cross2007.stacks import (
    early_twins,
    gap_for_delay,
    hollow_pair,
    hollow_record,
    late_pair,
    late_twins,
    reversed_pair,
    stiffen,
    twin_pair,
)
from stackbounce.cross2007.style import GREY, render
from stackbounce.cross2007.tables import make_table_one, make_table_two

CURVES = [4, 4, 2, 2, 4, 6, 6, 4, 4, 2, 2, 2, 2, 2, 5, 2]  # in each figure


@pytest.fixture(scope="module")
def drawn():
    return {name: figure(name) for name in FIGURES}


@pytest.fixture
def bench():
    return Bench(PAPER)


def curves(ax):
    return [line for line in ax.lines if line.get_color() != GREY]


@pytest.mark.parametrize(("name", "count"), list(zip(FIGURES, CURVES, strict=True)))
def test_axes_curves_and_guesses(drawn, name, count):
    picture = drawn[name]
    axes = picture.picture.axes
    assert axes[-1].get_xlabel()
    assert all(ax.get_ylabel() for ax in axes)
    assert sum(len(curves(ax)) for ax in axes) == count
    assert all(np.isfinite(line.get_ydata()).all() for ax in axes for line in curves(ax))
    assert all((picture.guesses, picture.title, picture.caption))


def test_the_data_are_the_curves_and_what_the_text_tells(drawn):
    data, (ax,) = drawn["4a"].data, drawn["4a"].picture.axes
    assert np.array_equal(ax.lines[1].get_ydata(), data.rebound_ratio[1])
    at = data.rebound_ratio.sel(mass_ratio=1.0, method="nearest").values
    assert at == pytest.approx(data.known_rebound_ratio.values[[2, 1]], abs=0.01)
    assert drawn["8-hollow"].data.force.dims == ("run", "contact", "time")
    assert drawn["8-hollow"].data.floor.values.tolist() == ["HollowBall", "HollowBall", "Spring"]
    assert drawn["6"].data.known_rebound_ratio.values[:2].tolist() == [0.18, 1.64]
    assert drawn["5"].data.known_time.values.tolist() == [0.005, 0.019, 0.029]
    assert drawn["7"].data.compression.attrs == {"units": "m"}


def test_figures_and_tables_have_the_names_of_the_paper(drawn):
    for name in ("13", "Fig. 13", "figure 13", 13):
        assert repr(figure(name)) == repr(drawn["13"])
    assert repr(drawn["13"]).startswith("Figure 13: Middle ball B2 on large ball B1: mass-spring ")
    assert "data:image/svg+xml;base64," in drawn["13"]._repr_html_()
    assert repr(table("Table II")).startswith("Table II: Rebound ratios of the pairs")
    with pytest.raises(sb.StackbounceError, match=r"no figure '4'; .* Known: 2a, 2b, 4a, 4b, 5"):
        figure("4")
    with pytest.raises(sb.StackbounceError, match="no table 3; known: I, II"):
        table(3)


@pytest.mark.parametrize(("name", "delay"), [("10a", 2), ("10b", 2), ("11a", 2), ("11b", 7)])
def test_the_measured_delay_is_marked(drawn, name, delay):
    texts = [text.get_text() for ax in drawn[name].picture.axes for text in ax.texts]
    assert f"measured: {delay} ms delay" in texts


def test_cases_of_the_explorer_have_the_ratios_that_their_titles_say():
    drops = {case.name: case.drop for case in list_cases()}
    ratios = {name: drop.balls[0].mass / drop.balls[1].mass for name, drop in drops.items()}
    named = ("textbook", "equal", "figure-4a", "figure-4b", "figure-5")
    assert [ratios[name] for name in named] == pytest.approx([1000.0, 1.0, 3.0, 3.0, 2.0])
    floor, between = drops["figure-4b"].contacts
    assert floor.stiffness / between.stiffness == pytest.approx(20.0)
    assert drops["figure-8-gap"].gaps == pytest.approx([2e-3])


@pytest.mark.parametrize("name", ["6", "12"])
def test_files_are_images(drawn, name):
    files = render(drawn[name].picture)
    assert ET.fromstring(files["svg"]).tag == "{http://www.w3.org/2000/svg}svg"
    assert files["png"].startswith(b"\x89PNG")


def test_the_same_figure_gives_the_same_bytes(drawn):
    assert render(figure("9").picture) == render(drawn["9"].picture)


def test_figure_six_is_dashed_and_solid_as_the_caption_says(drawn):
    styles = [line.get_linestyle() for line in curves(drawn["6"].picture.axes[0])]
    assert styles == ["--", "-"] * 3


def test_figures_follow_the_data(drawn):
    assert figure("9", changed(PAPER, "tennis.mass", 0.99)).features != drawn["9"].features


def test_heavy_lower_balls_collide_once(bench):
    assert np.isnan(after_collision(bench, np.array([2.0]), 1.0, 2)).all()


def test_forces_start_at_zero_and_end_with_the_contacts(bench):
    drop = spring_pair((0.150, 0.057), (2500.0, 1000.0), speed=3.53)
    (floor, between), result = sample_forces(bench, drop, np.array([0.0, 0.012, 0.05]))
    assert (floor[[0, 2]], between[[0, 2]]) == pytest.approx((0.0, 0.0))
    assert floor[1] > 0.0 < between[1]
    rise, fall = force_above(result, 0, 0.5)
    assert 0.0 < rise < fall < result.last_release[0]


def test_measured_delays_and_durations_set_the_gaps(bench):
    gap = gap_for_delay(bench, reversed_pair(bench, 0.0), 2e-3)
    delays = {2e-3: reversed_pair(bench, gap), 7e-3: late_pair(bench), 1e-3: early_twins(bench)}
    for delay, drop in delays.items():
        assert bench.simulate(drop).first_touch[1] == pytest.approx(delay, rel=1e-9)
    assert bench.simulate(late_twins(bench)).last_release[0] == pytest.approx(12e-3, rel=1e-9)


def test_the_hollow_ball_is_set_to_two_measurements_and_misses_the_others(bench):
    film, record = bench.simulate(hollow_pair(bench)), bench.simulate(hollow_record(bench))
    assert film.rebound_ratios[0] == pytest.approx(bench("tennis_on_basketball.lower"), abs=1e-9)
    assert record.last_release[0] == pytest.approx(bench("stack.duration"), rel=1e-9)
    assert film.rebound_ratios[1] == pytest.approx(1.555, abs=1e-3)  # measured: 1.64
    apart = bench.simulate(hollow_record(bench, bench("stack.gap")))
    assert apart.first_touch[1] == pytest.approx(5.28e-3, abs=1e-5)  # measured: 7 ms
    floor, _ = film.drop.contacts
    alone = sb.simulate(sb.Drop(film.drop.balls[:1], [floor], impact_speed=3.53))
    bounce = bench("basketball.rebound_height") / bench("stack.drop_height")
    assert alone.rebound_ratios[0] ** 2 == pytest.approx(bounce, rel=1e-9)


def test_bisection_meets_a_jump_and_a_root():
    assert bisect(lambda x: 1.0 if x > 0.3 else -1.0, 0.0, 1.0) == pytest.approx(0.3, abs=1e-15)
    assert bisect(lambda x: 2.0 - x * x, 0.0, 2.0) == pytest.approx(2.0**0.5, abs=1e-15)


def test_the_floor_force_shows_the_peaks_that_the_text_counts(bench):
    three = reversed_pair(bench, bench("superballs.gap"))
    assert len(peak_times(bench.simulate(three), 0, 0.011)) == 3
    assert len(peak_times(bench.simulate(early_twins(bench)), 0, 0.0095)) == 2
    assert list(bench.simulate(late_twins(bench)).collisions) == [2, 1]


def test_stiffening_keeps_the_contact_times(bench):
    drop = twin_pair(bench, 0.0)
    hard, masses = stiffen(drop), [ball.mass for ball in drop.balls]
    for mass, spring, law in zip((masses[0], masses), drop.contacts, hard.contacts, strict=True):
        assert isinstance(law, sb.Hertz)
        time = sb.contact_time(law, mass, drop.reference_speed)
        assert time == pytest.approx(sb.contact_time(spring, mass))


def test_table_one_carries_the_errors(bench):
    table = make_table_one(bench)
    columns = ("printed (1e4 N/m)", "= m (π/time)²")
    printed, computed = (table.head.index(f"dynamic k {column}") for column in columns)
    assert [row[printed] for row in table.rows] == ["5.4", "3.6", "2.3"]
    assert [row[computed] for row in table.rows] == ["5.39±0.25", "3.62±0.28", "2.32±0.24"]


def test_table_two_has_printed_and_computed_values(bench):
    table = make_table_two(bench)
    assert all(len(row) == len(table.head) for row in table.rows)
    first = dict(zip(table.head, table.rows[0], strict=True))
    assert first["m1/m2 printed"] == "4.23"
    assert first["from Table I"].startswith("4.07")
    assert first["B1 = 105 g"].startswith("4.23")
    assert first["e2 squared"] == "3.65±0.08"
