"""Simulated press curves, whose true values are known."""

from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from stackbounce.model.laws import ContactLaw
from synthetic import attributes
from synthetic.disturbances import ar_noise

Array = NDArray[np.float64]


def press_record(
    law: ContactLaw,
    *,
    peak: float,
    points: int = 400,
    cycles: int = 1,
    slack: float = 0.0,
    hold: int = 0,
    relaxation: float = 0.0,
    noise: float = 0.0,
    jitter: float = 0.0,
    memory: float = 0.0,
    drift: float = 0.0,
    offset: float = 0.0,
    force_step: float = 0.0,
    seed: int = 0,
) -> xr.Dataset:
    """Return the record of slow loading and unloading of a contact, as a testing machine writes it.

    The force of the law must not depend on the rate; each cycle starts afresh. Half of the `points`
    of a cycle, rounded down, are the loading to the `peak` (m), after a travel (`slack`) before the
    contact; `hold` are further points at the peak, where the `relaxation`, a share of the force, is
    lost. `noise` is of the force (N), with a `memory` in points, and `jitter` of the compression;
    the zero has an `offset` and a `drift` over the record.

    Examples
    --------
    >>> import stackbounce as sb
    >>> data = press_record(sb.Spring(1e4), peak=2e-3, points=8)
    >>> (1e3 * data.compression.values).round(2)
    array([0. , 0.67, 1.33, 2. , 1.5 , 1. , 0.5 , 0. ])
    >>> data.force.values.round(1)
    array([ 0. ,  6.7, 13.3, 20. , 15. , 10. ,  5. ,  0. ])
    """
    inward = np.linspace(-slack, peak, points // 2)
    outward = np.linspace(peak, 0.0 - slack, points - points // 2 + 1)[1:]  # 0.0, not -0.0
    way = np.concatenate([inward, np.full(hold, peak), outward])
    force = _force(law, way, len(inward), hold, peak, relaxation)
    way, force = (np.tile(column, cycles) for column in (way, force))
    generator = np.random.default_rng(seed)
    count = len(force)
    force = force + offset + drift * np.linspace(0.0, 1.0, count)
    correlation = np.exp(-1.0 / memory) if memory else 0.0
    force = force + noise * ar_noise(generator, (count,), correlation)
    if force_step:
        force = force_step * np.round(force / force_step)
    compression = way + jitter * generator.standard_normal(count)
    columns = {
        "compression": ("point", compression, {"units": "m", "long_name": "Compression (m)"}),
        "force": ("point", force, {"units": "N", "long_name": "Force (N)"}),
    }
    return xr.Dataset(columns, attrs=attributes("press curve"))


def _force(law: Any, way: Array, inward: int, hold: int, peak: float, relaxation: float) -> Array:
    unit = np.clip(way / peak, 0.0, None)
    top = law.stiffness * peak**law.exponent
    n = getattr(law, "unloading_exponent", law.exponent)
    force = top * unit ** np.where(np.arange(len(way)) < inward, law.exponent, n)
    kept = np.ones(len(way))
    kept[inward:] = 1.0 - relaxation
    if hold:
        kept[inward : inward + hold] = 1.0 - relaxation * np.linspace(0.0, 1.0, hold + 1)[1:]
    return np.asarray(force * kept)
