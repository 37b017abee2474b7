"""The analysis of a press curve."""

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from stackbounce.errors import InvalidType, InvalidValue, non_negative, shown, whole
from stackbounce.measure.kinds.press.branches import Cycle, Record, cycles, record_of
from stackbounce.measure.kinds.press.cycle import result_of
from stackbounce.measure.kinds.press.notes import sentences
from stackbounce.measure.kinds.press.result import Press
from stackbounce.measure.quantities import measured

if TYPE_CHECKING:
    import xarray as xr


def press(
    data: "xr.Dataset | Any",
    *,
    compliance: Any = 0.0,
    sign: int | None = None,
    cycle: int | None = None,
    tabulated: bool = False,
) -> Press:
    """Return stiffness, exponent and energy loss of a curve of force against compression.

    Parameters
    ----------
    data : xarray.Dataset or (compression, force)
        `compression` in m and `force` in N, in the order of recording. A record has one or more
        cycles of loading and, if recorded, unloading; slack before the contact and a hold at the
        peak may occur. Points without a number are left out.
    compliance : float or UFloat, optional
        Of the machine, in m/N; the compression of the machine is subtracted.
    sign : {1, -1}, optional
        Of the force in the record while the ball is pressed. By default that of the larger forces.
    cycle : int, optional
        Which cycle, from 0; negative from the last. By default the last one that has a loading and
        an unloading, as the first cycles of a ball differ from later ones.
    tabulated : bool, optional
        Whether the contact of `Press.parts` is the table of the curve, a `Tabulated` law, in place
        of the fitted one.

    Returns
    -------
    Press

    Raises
    ------
    InvalidType
        If `data` is neither of these.
    InvalidValue
        If there are fewer than 6 points, values are constant, the force does not exceed its noise,
        or there is no such cycle.

    Notes
    -----
    The loading is fitted by ``F = k c**p``, where c counts from a contact that is fitted too. The
    zero of the force is the mean of the slack, or a straight line in time where there is slack
    before and after; without slack it is taken as recorded. The unloading is fitted by
    ``F = P (c/C)**n`` from the peak C on; `Hysteretic` has this form. The works are sums over the
    points themselves, and so is the loss. Then ``e² = 1 - loss`` and ``n = (p + 1)/e² - 1``
    (R. Cross, Am. J. Phys. 75, 1009, 2007, section V).

    The errors follow from the residuals. These are correlated from point to point where the press
    drifts, the sensor is filtered, or the law does not quite fit; errors that assume independence
    would be far too small. The residuals are modelled as the sum of white and AR(1) noise, both of
    unknown size, and the errors and correlations of all numbers follow from that.

    A press is slow. In a bounce a ball is stiffer, and it may lose more or less energy.

    Examples
    --------
    >>> import numpy as np
    >>> import xarray as xr
    >>> c = 5e-3 * (1.0 - abs(np.linspace(-1.2, 1.2, 401)))  # m, in and out
    >>> share = np.clip(c / 5e-3, 0.0, None)
    >>> force = 40.0 * np.where(np.arange(401) <= 200, share**1.3, share**2.78)  # N
    >>> force += np.random.default_rng(1).normal(0.0, 0.1, 401)
    >>> found = press(xr.Dataset({"force": ("point", force), "compression": ("point", c)}))
    >>> print(f"exponent {found.exponent:.1uS}, restitution {found.restitution:.1uS}")
    exponent 1.299(3), restitution 0.7800(6)
    >>> found.parts()["contact"]["law"]
    'Hysteretic'
    """
    if sign not in (None, 1, -1):
        raise InvalidValue(f"sign must be 1, -1 or None, got {shown(sign)}")
    if not isinstance(tabulated, bool):
        raise InvalidType(f"tabulated must be True or False, got {shown(tabulated)}")
    soft = measured("compliance", compliance, "m/N", non_negative)
    at = float(soft.nominal_value)
    found = replace(_press(record_of(data, at, sign), cycle), tabulated=tabulated)
    if soft.std_dev == 0.0:
        return found
    moved = _press(record_of(data, at + float(soft.std_dev), sign), found.cycle)
    unit = (soft - at) / soft.std_dev
    changes = {
        name: value + (getattr(moved, name).nominal_value - value.nominal_value) * unit
        for name, value in vars(found).items()
        if hasattr(value, "std_dev") and getattr(moved, name) is not None
    }
    return replace(found, **changes)


def _press(record: Record, number: int | None) -> Press:
    found = cycles(record)
    chosen = _chosen(found, number)
    if len(found[chosen].loading):
        results = {
            k: result_of(record, member) for k, member in enumerate(found) if len(member.loading)
        }
    else:
        results = {chosen: _unloading_only(record, found[chosen])}
    results = {k: replace(one, cycle=k, cycles=len(found)) for k, one in results.items()}
    result = results.pop(chosen)
    result = replace(result, others=tuple(results.values()))
    notes = result.notes or sentences(result, len(found[chosen].held))
    return replace(result, notes=(*record.notes, *notes))


def _chosen(found: list[Cycle], number: int | None) -> int:
    """Return the place of the cycle that was asked for, or of the best one."""
    if number is not None:
        place = whole("cycle", number, -len(found), len(found) - 1)
        if not len(found[place].loading) and not len(found[place].unloading):
            raise InvalidValue(f"cycle must be one with enough points, got {number}")
        return place % len(found)
    # a cycle with both branches is preferred to a loading alone, that to an unloading alone
    worth = [2 * bool(len(cycle.loading)) + bool(len(cycle.unloading)) for cycle in found]
    if max(worth) > 0:
        return len(worth) - 1 - worth[::-1].index(max(worth))
    raise InvalidValue("a press curve must have a loading or an unloading of 6 points, got none")


def _unloading_only(record: Record, cycle: Cycle) -> Press:
    """Return the peak, the returned work and the exponent n of an unloading without a loading."""
    # Read backwards it is a loading, whose exponent is n.
    back = replace(cycle, loading=cycle.unloading[::-1], unloading=cycle.loading, sampled=False)
    mirror = result_of(record, back)
    note = "There is no loading curve: only the peak, the energy returned and n can be determined."
    same = ("secant_stiffness", "peak_compression", "peak_force", "contact", "zero", "record")
    return Press(
        **{name: getattr(mirror, name) for name in same},
        work_out=mirror.work_in,
        unloading_exponent=mirror.exponent,
        unloading=mirror.loading,
        notes=(note,),
    )
