"""The analysis of a press curve."""

from dataclasses import replace
from typing import Any

from stackbounce.errors import InvalidValue, instance
from stackbounce.library_types import Dataset
from stackbounce.measure.kinds.press.cycle import result_of
from stackbounce.measure.kinds.press.record import cycles, record_of
from stackbounce.measure.kinds.press.result import Press
from stackbounce.measure.setup import Setup

_CLEAR = 3.0  # standard errors


def analyse(data: Any, setup: Setup) -> Press:
    """Return the contact that a press curve tells."""
    return press(data, tabulated=setup.tabulated)


def press(data: Dataset | Any, *, tabulated: bool = False) -> Press:
    """Return stiffness, exponent and energy loss of a curve of force against compression.

    Parameters
    ----------
    data : xarray.Dataset or (compression, force)
        `compression` in m and `force` in N, in the order of recording. A record has one or more
        cycles of loading and, if recorded, unloading; slack before the contact and a hold at the
        peak may occur. Points without a number are left out. The last cycle with a loading and an
        unloading is analysed, as the first cycles of a ball differ from later ones.
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
        If there are fewer than 6 points of loading, values are constant, or the force does not
        exceed its noise.

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
    would be far too small. The errors and correlations of all numbers follow from the size of the
    residuals and their autocorrelation.

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
    exponent 1.300(3), restitution 0.7797(5)
    >>> found.parts()["contact"]["law"]
    'Hysteretic'
    """
    instance("tabulated", tabulated, bool)
    record = record_of(data)
    found = cycles(record)
    pressed = [k for k, cycle in enumerate(found) if len(cycle.loading)]
    if not pressed:
        raise InvalidValue("a press curve must have a loading of 6 points, got none")
    # a cycle with both branches is preferred to a loading alone
    chosen = max(pressed, key=lambda k: (len(found[k].unloading) > 0, k))
    result = result_of(record, found[chosen])
    which = f"{chosen + 1} of {len(found)}" if len(found) > 1 else None
    return replace(result, cycle=which, notes=(*record.notes, *_notes(result)), tabulated=tabulated)


def _notes(found: Press) -> list[str]:
    """Return the notes on a cycle, a sentence each."""
    notes = []
    if found.zero.nominal_value == 0.0 and found.zero.std_dev == 0.0:
        notes.append(
            "There are too few points before the contact: the zero of the force was assumed to be "
            "right, and the contact follows from the curve."
        )
    if found.exponent.nominal_value < 1.0 - _CLEAR * found.exponent.std_dev:
        notes.append(
            "The ball gets softer as it is pressed (exponent below 1), which no power law of this "
            "package does: the straight line stands for it, or the table of its points."
        )
    laws = {"loading": "one power law", "unloading": "the power law that Hysteretic unloads by"}
    for name, law in laws.items():
        curve = getattr(found, name)
        if curve is not None and not curve.fits:
            notes.append(
                f"The {name} is not well described by {law}: it is off by "
                f"{100.0 * curve.misfit:.2g} % of the peak force."
            )
    if found.loss is None:
        notes.append("There is no unloading: what is lost cannot be known.")
    elif found.loss.nominal_value < -_CLEAR * found.loss.std_dev:
        notes.append(
            "More work comes back than went in: the branches are swapped, or the machine drifts."
        )
    return notes
