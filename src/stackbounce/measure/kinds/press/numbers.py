"""From the plain numbers of a cycle to what is told of it."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import finite
from stackbounce.measure.kinds.press.branches import Cycle, Record
from stackbounce.measure.kinds.press.cycle import Found, analysed
from stackbounce.measure.kinds.press.result import Curve, Press
from stackbounce.measure.quantities import measured

__all__ = ["result_of", "unloading_only"]

Array = NDArray[np.float64]

_WAVES = 9  # polynomials that make up a smooth misfit
_SMALL = 0.01  # of the peak force, below which a misfit does not matter
_CLEAR = 5.0  # times the noise that a smooth part must have to be one


def result_of(record: Record, cycle: Cycle, place: int, count: int) -> Press:
    """Return what one cycle gives, without its notes."""
    from uncertainties import correlated_values

    found = analysed(record, cycle)
    numbers = _correlated(correlated_values, found)
    top, p, length = numbers["top"], numbers["exponent"], numbers["length"]
    peak, back, lost = numbers["peak_force"], numbers.get("work_out"), None
    restitution = energy = relaxed = None
    if back is not None and numbers["work_in"].nominal_value > 0.0:
        kept = back / numbers["work_in"]
        lost = 1.0 - kept
        if kept.nominal_value > 0.0:
            restitution, energy = kept**0.5, (p + 1.0) / kept - 1.0
        relaxed = top - numbers["top_out"]
    contact = cycle.peak - float(length.nominal_value)
    up, down = found.loading, found.unloading
    residual = found.residuals
    height = float(peak.nominal_value)
    level = found.zero[0] + found.zero[1] * np.arange(len(record.force))
    return Press(
        stiffness=top / length**p,
        exponent=p,
        linear_stiffness=numbers["linear"],
        tangent_stiffness=p * top / length,
        secant_stiffness=peak / length,
        peak_compression=length,
        peak_force=peak,
        work_in=numbers["work_in"],
        work_out=back,
        loss=lost,
        restitution=restitution,
        unloading_exponent=numbers.get("unloading"),
        energy_exponent=energy,
        contact=numbers["contact"],
        zero=numbers["zero"],
        relaxed=relaxed,
        loading=_curve(up.x - contact, up.y, residual[0], height),
        unloading=_curve(down.x - contact, down.y, residual[1], height) if len(down.x) else None,
        record=(record.compression - contact, record.force - level),
        cycle=place,
        cycles=count,
        others=(),
        notes=(),
    )


def _correlated(correlated_values: Any, found: Found) -> dict[str, Any]:
    """Return the numbers of a cycle with their errors and correlations."""
    scale = np.sqrt(np.clip(np.diag(found.covariance), 0.0, None))
    known = scale > 0.0
    # in units of the errors themselves, which span many decades
    part = found.covariance[np.ix_(known, known)] / np.outer(scale[known], scale[known])
    units = iter(correlated_values(np.zeros(int(known.sum())), part) if known.any() else ())
    return {
        name: value + size * next(units) if size > 0.0 else measured(name, value, "", finite)
        for (name, value), size in zip(found.values.items(), scale.tolist(), strict=True)
    }


def _curve(compression: Array, force: Array, residual: Array, peak: float) -> Curve:
    """Return a branch with its fit, and how well that fits."""
    misfit, noise, clear = _smooth_part(residual)
    share = misfit / peak if peak > 0.0 else float("inf")
    fits = share < _SMALL or not clear
    return Curve(compression, force, force - residual, share, noise, fits)


def _smooth_part(residual: Array) -> tuple[float, float, bool]:
    """Return the smooth part of residuals and the rest, root mean squares, and if it is clear."""
    count = len(residual)
    waves = min(_WAVES, count // 3)
    basis = np.polynomial.chebyshev.chebvander(np.linspace(-1.0, 1.0, count), waves)
    base = np.linalg.qr(basis)[0]
    smooth = float(((base.T @ residual) ** 2).sum())
    rest = max(float(residual @ residual) - smooth, 0.0)
    free = max(1, count - waves - 1)
    expected = rest / free * (waves + 1)
    clear = smooth > _CLEAR * expected
    return (
        float(np.sqrt(max(smooth - expected, 0.0) / count)),
        float(np.sqrt(rest / free)),
        clear,
    )


def unloading_only(record: Record, cycle: Cycle, place: int, count: int) -> Press:
    """Return the peak, the work given back and the exponent n of an unloading without a loading.

    Parameters
    ----------
    record : Record
        The whole record.
    cycle : Cycle
        With an unloading and no loading.
    place, count : int
        Which cycle of how many.

    Returns
    -------
    Press
    """
    # Read backwards it is a loading, whose exponent is n.
    back = Cycle(
        cycle.unloading[::-1], np.empty(0, np.intp), cycle.held, cycle.peak, cycle.peak_error
    )
    mirror = result_of(record, back, place, count)
    note = "There is no loading: only the peak, the work given back and n can be known."
    return Press(
        stiffness=None,
        exponent=None,
        linear_stiffness=None,
        tangent_stiffness=None,
        secant_stiffness=mirror.secant_stiffness,
        peak_compression=mirror.peak_compression,
        peak_force=mirror.peak_force,
        work_in=None,
        work_out=mirror.work_in,
        loss=None,
        restitution=None,
        unloading_exponent=mirror.exponent,
        energy_exponent=None,
        contact=mirror.contact,
        zero=mirror.zero,
        relaxed=None,
        loading=None,
        unloading=mirror.loading,
        record=mirror.record,
        cycle=place,
        cycles=count,
        others=(),
        notes=(*record.notes, note),
    )
