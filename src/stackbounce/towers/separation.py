"""The separation limit: the gap above which the collisions of a stack are separate."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidValue, shown, whole
from stackbounce.model import Drop
from stackbounce.run.driver import simulate
from stackbounce.run.options import run_options
from stackbounce.run.result import Status

_TRIES, _WIDER = 10, 4.0  # up to 250 000 times the distance fallen during the touching impact
_STEADY = 1e-6  # relative; durations that do not depend on the gap differ by less
_SAME_PACE = 1e-9  # over 1/v0; collisions that keep their distance in time have the same pace


def replace_gaps(drop: Drop, only: int | None, gap: float) -> Drop:
    """Return a drop with another gap at index `only`, or with the same gap everywhere.

    Examples
    --------
    >>> from stackbounce.model import Ball, Spring
    >>> drop = Drop([Ball(1.0)] * 3, [Spring(1.0)] * 3, [0.1, 0.2], impact_speed=1.0)
    >>> replace_gaps(drop, 1, 0.5).gaps, replace_gaps(drop, None, 0.5).gaps
    ((0.1, 0.5), (0.5, 0.5))
    """
    gaps = [gap if only in (None, i) else own for i, own in enumerate(drop.gaps)]
    return drop.replace(gaps=gaps)


def separation_limit(drop: Drop, only: int | None = None, *, rtol: float = 1e-12) -> float:
    """Return the separation limit in m: above it the outcome does not depend on the gap.

    Parameters
    ----------
    drop : Drop
        Two balls or more on finite contacts, without gravity. Its own gaps are used only if
        `only` is given.
    only : int, optional
        The index of the gap that varies while the others stay as they are. By default all gaps
        vary together, with the same value.
    rtol : float, optional
        As in `simulate`.

    Returns
    -------
    float
        inf if there is none below 250 000 times the distance that the stack falls during the impact
        of touching balls: mostly where separate collisions are infinitely many, because they follow
        each other faster than any contact can open.

    Raises
    ------
    InvalidValue
        If there is only one ball, gravity is not 0, contacts are rigid, no contact ever closes, or
        a number is out of its range.
    InvalidType
        If something has the wrong type.

    Notes
    -----
    Source: R. Cross, Am. J. Phys. 75, 1009 (2007), section II. With a wide gap g the impact
    consists of separate events: single collisions, or groups of them where other gaps are narrow. A
    wider gap only lengthens the flights between the events, so that each contact interval begins at
    ``a + b g`` and keeps its duration. Two runs determine all a and b. This holds down to the gap
    at which one event begins at the moment when another event of the same ball ends; the largest of
    these gaps is returned, and is exact. A contact with a clipped force counts as closed until its
    compression is gone.

    Examples
    --------
    Two equal balls on equal springs. At the separation limit the lower ball leaves the floor, half
    a period after its touch, at the moment when the gap closes:

    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(1.0)] * 2, [sb.Spring(1.0)] * 2, impact_speed=1.0)
    >>> round(sb.separation_limit(drop), 9)
    3.141592654
    """
    run_options(drop, None, rtol, 1)
    _check(drop, only)
    last = simulate(replace_gaps(drop, only, 0.0), rtol=rtol).last_release
    if np.isnan(last).all():
        raise InvalidValue(
            "drop must have contacts that close, got balls that neither meet a floor nor each other"
        )
    gap = float(drop.reference_speed * np.nanmax(last))  # fallen during the impact
    for _ in range(_TRIES):
        narrow, wide = (_intervals(replace_gaps(drop, only, g), rtol) for g in (gap, 2.0 * gap))
        if narrow is not None and wide is not None and _alike(narrow, wide):
            found = _latest_end(drop, narrow, wide, gap)
            if found <= gap:
                return found
        gap *= _WIDER
    return math.inf


def _check(drop: Drop, only: object) -> None:
    if len(drop.balls) < 2:
        raise InvalidValue("balls must be two or more for a gap, got 1")
    if only is not None:
        whole("only", only, 0, len(drop.gaps) - 1)
    if drop.rigid:
        raise InvalidValue(
            "contacts must be finite ones, such as Spring, got Rigid: such collisions are "
            "separate whatever the gap"
        )
    if drop.gravity > 0.0:
        raise InvalidValue(
            f"gravity must be 0, got {shown(drop.gravity)}: with it the outcome changes with every "
            "gap"
        )


def _intervals(drop: Drop, rtol: float) -> NDArray[Any] | None:
    """Return the contact intervals sorted by contact; None if the run does not finish."""
    result = simulate(drop, rtol=rtol)
    if result.status is not Status.FINISHED:
        return None
    rows = result.intervals
    return rows[np.lexsort((rows["start"], rows["contact"]))]


def _alike(one: NDArray[Any], other: NDArray[Any]) -> bool:
    """Return whether two runs have the same collisions with the same durations."""
    if not np.array_equal(one["contact"], other["contact"]):
        return False
    last, again = (rows["end"] - rows["start"] for rows in (one, other))
    return np.allclose(last, again, rtol=_STEADY, atol=0.0)


def _latest_end(drop: Drop, narrow: NDArray[Any], wide: NDArray[Any], gap: float) -> float:
    """Return the largest gap at which one contact interval begins when another ends.

    Only intervals at the same contact or at neighbouring contacts are compared.
    """
    linger = np.array([0.0 if law is None else law.linger for law in drop.contacts])
    contact, start = narrow["contact"], narrow["start"]
    end = narrow["end"] + linger[contact]
    pace = (wide["start"] - start) / gap
    faster = pace[None, :] - pace[:, None]
    near = np.abs(contact[:, None] - contact[None, :]) <= 1
    later = near & (faster > _SAME_PACE / drop.reference_speed)
    if not later.any():
        return 0.0
    first, second = np.nonzero(later)
    meets = gap + (end[first] - start[second]) / faster[first, second]
    return max(0.0, float(meets.max()))
