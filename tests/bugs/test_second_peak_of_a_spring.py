"""Of a spring that is pressed beyond its first peak again, the largest force was the first."""

import numpy as np

import stackbounce as sb


def test_the_highest_of_two_peaks_is_told():
    drop = sb.Drop([sb.Ball(0.1), sb.Ball(1.0)], [sb.Spring(1.0), sb.Spring(1.0)], impact_speed=1.0)
    result = sb.simulate(drop)
    (floor,) = result.intervals[result.intervals["contact"] == 0]
    record = result.sample(np.linspace(0.0, floor["end"], 2001)).sel(contact=0)
    assert abs(floor["peak_compression"] - float(record.compression.max())) < 1e-5
    assert abs(floor["peak_force"] - float(record.force.max())) < 1e-5
