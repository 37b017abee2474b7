"""The delay and the gap of two balls by two sensors: one on the floor, one between the balls."""

from typing import Any

from stackbounce.errors import InvalidValue
from stackbounce.measure.finding import force_channels
from stackbounce.measure.kinds.waveform.gap.delay import delay, gap_from_delay
from stackbounce.measure.kinds.waveform.gap.result import SensorGap

__all__ = ["sensor_gap"]


def sensor_gap(data: Any, *, impact_speed: Any = None, contact_time: Any = None) -> SensorGap:
    """Return the delay between the first two channels of a record, and the gap.

    Parameters
    ----------
    data : Dataset
        A waveform as `read` gives it: the first channel is the floor's.
    impact_speed : float or UFloat, optional
        In m/s.
    contact_time : float or UFloat, optional
        Of the lower ball alone on the floor, in s.

    Returns
    -------
    SensorGap

    Raises
    ------
    InvalidValue
        If there are not two channels with a contact each, the second one later.
    InvalidType
        If something has the wrong type.

    Examples
    --------
    >>> import numpy as np
    >>> import stackbounce as sb
    >>> import xarray as xr
    >>> balls, laws = [sb.Ball(0.101), sb.Ball(0.0248)], [sb.Spring(5.6e4), sb.Spring(1.6e4)]
    >>> drop = sb.Drop(balls, laws, gaps=[1e-3], impact_speed=2.0)
    >>> times = np.arange(-2e-3, 1e-2, 1e-5)  # s
    >>> forces = sb.simulate(drop).sample(np.maximum(times, 0.0)).force.values * (times >= 0.0)
    >>> forces += np.random.default_rng(1).normal(0.0, 0.5, forces.shape)
    >>> columns = {name: ("time", force) for name, force in zip(("force", "force_2"), forces)}
    >>> record = xr.Dataset(columns, {"time": times})
    >>> found = sensor_gap(record, impact_speed=2.0, contact_time=4.22e-3)
    >>> abs(found.gap.nominal_value - 1e-3) < 3.0 * found.gap.std_dev < 2e-4
    True
    """
    names = force_channels(data)
    if len(names) < 2:
        raise InvalidValue(f"data must have two channels, got {', '.join(names) or 'none'}")
    later = delay(data[[names[0]]], data[[names[1]]])
    if not later.nominal_value > 0.0:
        raise InvalidValue(
            f"data must have the floor's channel first, got {names[1]} {-1e3 * later:.1uS} ms "
            f"before {names[0]}"
        )
    said = f"{names[0]} is taken as the floor's force, {names[1]} as that between the balls"
    if impact_speed is None or contact_time is None:
        missing = "impact speed" if impact_speed is None else "contact time of the lower ball alone"
        return SensorGap(later, None, (said, f"the gap needs the {missing} too"))
    gap = gap_from_delay(later, impact_speed, contact_time=contact_time)
    return SensorGap(later, gap, (said,))
