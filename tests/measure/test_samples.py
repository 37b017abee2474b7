"""The step that numbers were rounded to, as all analyses see it."""

import numpy as np
import pytest

from stackbounce.measure.samples import resolution
from synthetic.falls import falls
from synthetic.track import track as track_record

RANDOM = np.random.default_rng(1)
PARABOLA = 1.0 - 4.9 * np.linspace(0.0123, 0.45, 30) ** 2
NOISE = RANDOM.normal(0.0, 1.0, 2000)


@pytest.mark.parametrize("step", [1e-4, 0.1, 0.7])
def test_the_step_of_repeated_numbers_is_seen(step):
    assert resolution(step * np.round(NOISE / step)) == pytest.approx(step)


@pytest.mark.parametrize("pixel", [1e-3, 2e-3, 4e-3])
def test_the_step_of_pixels_is_seen_in_a_track_where_few_repeat(pixel):
    heights = track_record(falls(0.8, 0.75, bounces=2), pixel=pixel, noise=0.0, seed=1).y.values
    assert len(np.unique(heights)) > 0.5 * len(heights)
    assert resolution(heights[:, 0]) == pytest.approx(pixel)


def test_one_number_between_the_steps_does_not_matter():
    values = np.round(40.0 * NOISE)
    values[7] += 0.37
    assert resolution(values) == 1.0


def test_the_digits_of_a_coarse_converter_do_not_matter():
    volts = np.round(np.round(NOISE * 20.0) * 0.0392157, 4)
    assert resolution(volts) == pytest.approx(0.0392, abs=2e-4)


@pytest.mark.parametrize(
    "values",
    [NOISE, PARABOLA, np.linspace(0.0, 1.0, 300), np.zeros(9), np.zeros(1), np.zeros(0)],
    ids=["noise", "a parabola", "a ramp", "zeros", "one", "none"],
)
def test_no_step_of_numbers_that_are_not_rounded(values):
    assert resolution(values) == 0.0
