"""What the data leave open is said, and its errors are those of not knowing."""

import numpy as np
import pytest

import stackbounce as sb
from drops import STACK

BOTH = ["contacts.0.stiffness", "contacts.1.stiffness"]
RATIOS = {"rebound_ratios": [(0.39, 0.01), (1.80, 0.01)]}
ANYWHERE = 12.0**-0.5


def test_ratios_at_no_gap_tell_the_stiffness_ratio_alone():
    found = sb.fit(STACK, RATIOS, BOTH)
    (sentence,) = found.undetermined
    assert sentence == (
        "the data do not determine contacts.0.stiffness and contacts.1.stiffness separately: "
        "they can change together without effect"
    )
    ratio = found[BOTH[0]] / found[BOTH[1]]
    alone = sb.fit(STACK, RATIOS, [BOTH[1]])[BOTH[1]]
    assert ratio.nominal_value == pytest.approx(2500.0 / alone.nominal_value, rel=1e-5)
    relative = alone.std_dev / alone.nominal_value
    assert ratio.std_dev / ratio.nominal_value == pytest.approx(relative, rel=1e-2)
    for name in BOTH:  # along the open direction: even between bounds a factor of 10,000 apart
        spread = np.log(1e4) * ANYWHERE / np.sqrt(2.0)
        assert found[name].std_dev / found.best[name] == pytest.approx(spread, rel=1e-2)
    assert found.correlations.values[0, 1] > 0.99
    lower, upper = found.intervals().values()
    assert (upper.high, upper.high_is_bound) == (1e5, True)
    assert (lower.low, lower.low_is_bound) == (25.0, True)
    assert lower.high == pytest.approx(1e5 * ratio.nominal_value, rel=0.02)  # where the upper ends


def test_what_is_left_open_stays_where_the_drop_has_it():
    values = [sb.fit(STACK, RATIOS, BOTH, rng=seed).best for seed in range(3)]
    for one in values:
        assert one == pytest.approx(values[0], rel=1e-5)
        assert one["contacts.0.stiffness"] == pytest.approx(2500.0, rel=0.02)


def test_a_prior_decides():
    found = sb.fit(STACK, RATIOS, {BOTH[0]: "2500 ± 100", BOTH[1]: None})
    assert found.undetermined == ()
    alone = sb.fit(STACK, RATIOS, [BOTH[1]])[BOTH[1]]
    relative = np.hypot(alone.std_dev / alone.nominal_value, 0.04)
    both = found[BOTH[1]]
    assert both.std_dev / both.nominal_value == pytest.approx(relative, rel=1e-2)


def test_a_duration_decides_and_what_is_known_counts_as_a_datum():
    assert sb.fit(STACK, {**RATIOS, "durations.0": "30 ± 1 ms"}, BOTH).undetermined == ()
    known = {BOTH[0]: "2500 ± 25", BOTH[1]: None}
    assert sb.fit(STACK, {"rebound_ratios.1": (1.6, 0.02)}, known).undetermined == ()


def test_a_number_that_plays_no_part():
    found = sb.fit(STACK, RATIOS, {"balls.0.diameter": (0.1, 0.2), BOTH[1]: None})
    (sentence,) = found.undetermined
    assert sentence.endswith("balls.0.diameter: near its best value it hardly matters")
    assert found["balls.0.diameter"].std_dev == pytest.approx(0.1 * ANYWHERE, rel=1e-9)
    assert found.intervals()["balls.0.diameter"] == (0.1, 0.2, True, True)
    alone = sb.fit(STACK, RATIOS, [BOTH[1]])[BOTH[1]]
    assert found[BOTH[1]].std_dev == pytest.approx(alone.std_dev, rel=1e-6)
    assert found.correlations.values[0, 1] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("error", [0.05, 0.5, 1.0, 2.0, 10.0, 100.0])
def test_no_error_is_larger_than_that_of_the_bounds(error):
    """A height that is hardly known: the error grows with its own, up to that of not knowing."""
    drop = sb.Drop([sb.Ball(0.1)], [sb.Rigid(0.5)], impact_speed=1.0)
    found = sb.fit(drop, {"rebound_ratios.0": (0.5, error)}, {"contacts.0.restitution": (0.0, 1.0)})
    spread = found["contacts.0.restitution"].std_dev
    assert spread == pytest.approx(min(error, ANYWHERE), rel=1e-6)
    assert bool(found.undetermined) == (error >= 1.0)
