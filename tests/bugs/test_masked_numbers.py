"""Masked numbers were taken as numbers: a prediction from draws gave 6 ± 26 m/s for 6.3 ± 0.05."""

import numpy as np
import pytest

import stackbounce as sb
from stackbounce import errors, measure

MASKED = np.ma.array([0.1, 9.0, 0.2] * 100, mask=[False, True, False] * 100)
TIMES = np.linspace(0.0, 1.0, 300)
DROP = sb.Drop([sb.Ball(0.1), sb.Ball(0.05)], [sb.Spring(1e4)] * 2, height=0.6, gravity=9.81)
USES = {
    "sample": lambda values: sb.simulate(DROP).sample(values),
    "sweep": lambda values: sb.sweep(DROP, {"gaps.0": values}),
    "sweep of pairs": lambda values: sb.sweep(DROP, {"gaps.0": ("row", values)}),
    "sweep of a list": lambda values: sb.sweep(DROP, {"gaps.0": list(values)}),
    "predict": lambda values: sb.predict(DROP, {"height": values}),
    "fit": lambda values: sb.fit(
        DROP, {"force.0": (TIMES, values)}, {"contacts.0.stiffness": None}
    ),
    "waveform": lambda values: measure.waveform((TIMES, values)),
    "waveform in one array": lambda values: measure.waveform(np.ma.array([TIMES, values])),
    "press": lambda values: measure.press((values, TIMES)),
    "track": lambda values: measure.track((TIMES, values)),
    "accelerometer": lambda values: measure.accelerometer((TIMES, values)),
    "bounces": measure.bounces,
    "heights": lambda values: measure.heights(1.0, values),
    "knocks": lambda values: measure.knocks(values, rate=44100.0),
    "velocities": lambda values: sb.Drop(
        [sb.Ball(0.1)] * 300, [sb.Spring(1e4)] * 300, velocities=values
    ),
}


@pytest.mark.parametrize("use", USES.values(), ids=USES)
def test_a_masked_number_is_refused(use):
    with pytest.raises(
        errors.InvalidType, match=r"masked$|no masked numbers, got .*leave them out$"
    ):
        use(MASKED)


def test_an_array_that_masks_nothing_is_one_of_numbers():
    values = np.ma.array([0.1, 0.2])
    assert sb.sweep(DROP, {"gaps.0": values}).equals(sb.sweep(DROP, {"gaps.0": values.data}))
