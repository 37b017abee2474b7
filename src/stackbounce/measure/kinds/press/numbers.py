"""From the plain numbers of a cycle to a result with errors."""

from typing import Any

import numpy as np

from stackbounce.measure.kinds.press.branches import Cycle, Record
from stackbounce.measure.kinds.press.cycle import Branch, Found, analysed
from stackbounce.measure.kinds.press.result import Curve, Press

__all__ = ["result_of", "unloading_only"]

_WAVES = 9  # polynomials that make up a smooth misfit
_SMALL = 0.01  # of the peak force, below which a misfit does not matter
_CLEAR = 5.0  # times the noise that a smooth part must have to be one


def result_of(record: Record, cycle: Cycle) -> Press:
    """Return what one cycle with a loading gives, without its notes."""
    found = analysed(record, cycle)
    numbers = _correlated(found)
    top, top_out = numbers.pop("top"), numbers.pop("top_out", None)
    p, length, peak = (numbers[name] for name in ("exponent", "peak_compression", "peak_force"))
    work, back = numbers["work_in"], numbers.get("work_out")
    if back is not None and work.nominal_value > 0.0:
        kept = back / work
        numbers |= {"loss": 1.0 - kept, "relaxed": top - top_out}
        if kept.nominal_value > 0.0:
            numbers |= {"restitution": kept**0.5, "energy_exponent": (p + 1.0) / kept - 1.0}
    contact, height = found.values["contact"], float(peak.nominal_value)
    return Press(
        **numbers,
        stiffness=top / length**p,
        tangent_stiffness=p * top / length,
        secant_stiffness=peak / length,
        loading=_curve(found.loading, contact, height),
        unloading=None if back is None else _curve(found.unloading, contact, height),
        record=(record.compression - contact, record.force - found.level),
    )


def _correlated(found: Found) -> dict[str, Any]:
    """Return the numbers of a cycle with their errors and correlations."""
    from uncertainties import correlated_values_norm

    scale = np.sqrt(np.clip(np.diag(found.covariance), 0.0, None))
    scale = np.where(scale > 0.0, scale, 0.0)
    both = np.outer(scale, scale)
    correlations = np.eye(len(scale))
    np.divide(found.covariance, both, out=correlations, where=both > 0.0)
    known = list(zip(found.values.values(), scale.tolist(), strict=True))
    return dict(zip(found.values, correlated_values_norm(known, correlations), strict=True))


def _curve(branch: Branch, contact: float, peak: float) -> Curve:
    """Return a branch with its fit; its residuals are divided into a smooth part and noise."""
    residual = branch.residual
    count = len(residual)
    waves = min(_WAVES, count // 3)
    basis = np.polynomial.chebyshev.chebvander(np.linspace(-1.0, 1.0, count), waves)
    smooth = float(((np.linalg.qr(basis)[0].T @ residual) ** 2).sum())
    rest = max(float(residual @ residual) - smooth, 0.0) / max(1, count - waves - 1)
    expected = rest * (waves + 1)
    misfit = float(np.sqrt(max(smooth - expected, 0.0) / count))
    share = misfit / peak if peak > 0.0 else float("inf")
    fits = share < _SMALL or smooth <= _CLEAR * expected
    fit = branch.y - residual
    return Curve(branch.x - contact, branch.y, fit, share, float(np.sqrt(rest)), fits)


def unloading_only(record: Record, cycle: Cycle) -> Press:
    """Return the peak, the returned work and the exponent n of an unloading without a loading."""
    # Read backwards it is a loading, whose exponent is n.
    back = Cycle(
        cycle.unloading[::-1], np.empty(0, np.intp), cycle.held, cycle.peak, cycle.peak_error
    )
    mirror = result_of(record, back)
    note = "There is no loading curve: only the peak, the energy returned and n can be determined."
    return Press(
        secant_stiffness=mirror.secant_stiffness,
        peak_compression=mirror.peak_compression,
        peak_force=mirror.peak_force,
        work_out=mirror.work_in,
        unloading_exponent=mirror.exponent,
        contact=mirror.contact,
        zero=mirror.zero,
        unloading=mirror.loading,
        record=mirror.record,
        notes=(note,),
    )
