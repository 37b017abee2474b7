"""The error that an uncertain drag adds to all that was found with it."""

from collections.abc import Callable
from dataclasses import fields, is_dataclass, replace
from typing import Any, TypeVar

from stackbounce.measure.drag import Drag
from stackbounce.measure.quantities import nominal

__all__ = ["with_error_of_drag"]

Found = TypeVar("Found")

_LEAST_DRAG = 1e-3  # of the drag, taken where its error is nearly all of it


def with_error_of_drag(found: Found, found_with: Callable[[Drag], Found], drag: Drag) -> Found:
    """Return what was found with the error of the drag in each of its numbers with an error.

    The analysis is repeated with a drag that is larger, and smaller, by its error. Half the
    difference is the error of each number, and all of these errors are of one variable.

    Parameters
    ----------
    found : dataclass
        With the drag, but without its error. Numbers with errors may be in tuples and dataclasses.
    found_with : callable
        Finds the same with another drag.
    drag : Drag
        With its error.

    Returns
    -------
    dataclass

    Examples
    --------
    >>> from uncertainties import ufloat
    >>> from stackbounce.measure.kinds.bounces.analysis import bounces
    >>> times = [0.0, 0.45, 0.84, 1.18]
    >>> for coefficient in 0.5, ufloat(0.5, 0.05):
    ...     found = bounces(times, time_error=1e-4, drag=Drag(2.7e-3, 0.040, coefficient))
    ...     print(f"{found.mean:.1uS}")
    0.8928(2)
    0.893(2)
    """
    rate = drag.rate
    error = rate.std_dev / rate.nominal_value
    if not error > 0.0:
        return found
    least = max(1.0 - error, _LEAST_DRAG)
    low, high = found_with(drag.exact(least)), found_with(drag.exact(1.0 + error))
    off = (rate / rate.nominal_value - 1.0) / (1.0 + error - least)  # 0, with an error
    moved: Found = _moved(found, low, high, off=off)
    return moved


def _moved(value: Any, less: Any, more: Any, *, off: Any) -> Any:
    """Return a value with the error that makes it as the other two."""
    if less is None or more is None:
        return value
    if hasattr(value, "nominal_value"):
        return value + (nominal(more) - nominal(less)) * off
    if type(value) is tuple:
        rows = list(zip(value, less, more, strict=False))
        return (*(_moved(*row, off=off) for row in rows), *value[len(rows) :])
    if is_dataclass(value) and not isinstance(value, type | Drag):
        names = [field.name for field in fields(value)]
        every = {name: [getattr(one, name) for one in (value, less, more)] for name in names}
        return replace(value, **{name: _moved(*row, off=off) for name, row in every.items()})
    return value
