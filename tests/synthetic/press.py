"""Simulated press curves, whose true values are known."""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidType, finite, fraction, non_negative, positive, shown, whole
from stackbounce.model.laws import LAWS, ContactLaw

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["press_record"]

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
    compression_step: float = 0.0,
    compliance: float = 0.0,
    seed: int = 0,
) -> "xr.Dataset":
    """Return the record of slow loading and unloading of a contact, as a testing machine writes it.

    Parameters
    ----------
    law : ContactLaw
        The contact, whose force must not depend on the rate; each cycle starts afresh.
    peak : float
        Compression from contact to peak, in m.
    points : int, optional
        Of a cycle, at constant speed: half of them, rounded down, are the loading with the peak.
    cycles : int, optional
        How many.
    slack : float, optional
        Travel before the contact, and after it, in m.
    hold : int, optional
        Further points at the peak.
    relaxation : float, optional
        Share of the force that is lost by the end of the hold, or at the turn, and is not regained.
    noise, jitter : float, optional
        Standard deviations of force, in N, and of compression, in m.
    memory : float, optional
        Correlation length of the force's AR(1) noise, in points; 0 is white noise.
    drift : float, optional
        Of the force's zero from the first point to the last, in N.
    offset : float, optional
        Of the force's zero, in N.
    force_step, compression_step : float, optional
        To which both are rounded, in N and m.
    compliance : float, optional
        Of the machine, in m/N, which adds to the compression that is recorded.
    seed : int, optional
        Of the noise.

    Returns
    -------
    xarray.Dataset
        `compression` (m) and `force` (N) along `point`, as a file of a press curve is read.

    Raises
    ------
    InvalidType
        If `law` is none of these.
    InvalidValue
        If a number is out of its range.

    Examples
    --------
    >>> import stackbounce as sb
    >>> data = press_record(sb.Spring(1e4), peak=2e-3, points=8)
    >>> (1e3 * data.compression.values).round(2)
    array([0. , 0.67, 1.33, 2. , 1.5 , 1. , 0.5 , 0. ])
    >>> data.force.values.round(1)
    array([ 0. ,  6.7, 13.3, 20. , 15. , 10. ,  5. ,  0. ])
    """
    if not (isinstance(law, ContactLaw) and law.rate_free):
        known = " or ".join(name for name, one in LAWS.items() if one.rate_free)
        raise InvalidType(
            f"law must be {known}, whose force does not depend on the rate, got {shown(law)}"
        )
    positive("peak", peak, "metres")
    whole("points", points, 4)
    for name, value in (("slack", slack), ("noise", noise), ("jitter", jitter)):
        non_negative(name, value)
    for name, value in (("memory", memory), ("force_step", force_step)):
        non_negative(name, value)
    non_negative("compression_step", compression_step)
    finite("drift", drift)
    fraction("relaxation", relaxation)
    inward = np.linspace(-slack, peak, points // 2)
    outward = np.linspace(peak, -slack, points - points // 2 + 1)[1:]
    way = np.concatenate([inward, np.full(whole("hold", hold), peak), outward])
    force = _force(law, way, len(inward), hold, peak, relaxation)
    way, force = (np.tile(one, whole("cycles", cycles, 1)) for one in (way, force))
    compression = way + compliance * force
    generator = np.random.default_rng(seed)
    count = len(force)
    force = force + offset + drift * np.linspace(0.0, 1.0, count)
    force = force + noise * _noise(generator, count, memory)
    compression = compression + jitter * generator.standard_normal(count)
    return _dataset(_rounded(compression, compression_step), _rounded(force, force_step))


def _force(law: Any, way: Array, inward: int, hold: int, peak: float, relaxation: float) -> Array:
    """Return the force along one cycle."""
    unit = np.clip(way / peak, 0.0, None)
    top = law.stiffness * peak**law.exponent
    n = getattr(law, "unloading_exponent", law.exponent)
    force = top * unit ** np.where(np.arange(len(way)) < inward, law.exponent, n)
    kept = np.ones(len(way))
    kept[inward:] = 1.0 - relaxation
    if hold:
        kept[inward : inward + hold] = 1.0 - relaxation * np.linspace(0.0, 1.0, hold + 1)[1:]
    return np.asarray(force * kept)


def _noise(generator: np.random.Generator, count: int, memory: float) -> Array:
    """Return AR(1) noise of unit standard deviation."""
    from scipy.signal import lfilter

    white = generator.standard_normal(count)
    if memory == 0.0:
        return white
    phi = float(np.exp(-1.0 / memory))
    white[1:] *= np.sqrt(1.0 - phi * phi)
    return np.asarray(lfilter([1.0], [1.0, -phi], white))


def _rounded(values: Array, step: float) -> Array:
    return values if step == 0.0 else step * np.round(values / step)


def _dataset(compression: Array, force: Array) -> "xr.Dataset":
    import xarray as xr

    return xr.Dataset(
        {
            "compression": ("point", compression, {"units": "m", "long_name": "Compression (m)"}),
            "force": ("point", force, {"units": "N", "long_name": "Force (N)"}),
        },
        attrs={
            "format": "synthetic",
            "why": "It was computed from a contact law.",
            "doubt": "",
            "holds": "press curve",
            "source": "synthetic",
        },
    )
