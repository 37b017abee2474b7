"""The error that an uncertain drag adds to all that the times of bounces tell."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from stackbounce.measure.drag import Drag
from stackbounce.measure.kinds.bounces.result import Bounces
from stackbounce.measure.quantities import nominal

__all__ = ["with_error_of_drag"]

_LEAST = 1e-3  # of the drag: errors of nearly all of it are taken down to there


def with_error_of_drag(
    found: Bounces, found_with: Callable[[Drag], Bounces], drag: Drag
) -> Bounces:
    """Return what was found with the error of the drag in it.

    The times are analysed with a drag that is larger, and smaller, by its error. Half the
    difference is the error of each number, and all of these errors are of one variable.

    Parameters
    ----------
    found : Bounces
        With the drag, but without its error.
    found_with : callable
        Analyses the times with another drag.
    drag : Drag
        With its error.

    Returns
    -------
    Bounces

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
        return replace(found, drag=drag)
    least = max(1.0 - error, _LEAST)
    low, high = found_with(drag.exact(least)), found_with(drag.exact(1.0 + error))
    off = (rate / rate.nominal_value - 1.0) / (1.0 + error - least)  # 0, with an error

    def moved(value: Any, less: Any, more: Any) -> Any:
        return value + (nominal(more) - nominal(less)) * off

    def all_moved(name: str) -> tuple[Any, ...]:
        every = (getattr(one, name) for one in (found, low, high))
        return tuple(moved(*row) for row in zip(*every, strict=True))

    laws = [
        replace(
            law,
            coefficient=moved(law.coefficient, less.coefficient, more.coefficient),
            slope=moved(law.slope, less.slope, more.slope),
        )
        for law, less, more in zip(found.laws, low.laws, high.laws, strict=False)
    ]
    height = found.drop_height
    if found.inferred and low.inferred and high.inferred:
        height = moved(height, low.drop_height, high.drop_height)
    return replace(
        found,
        impact_speeds=all_moved("impact_speeds"),
        restitutions=all_moved("restitutions"),
        mean=moved(found.mean, low.mean, high.mean),
        laws=tuple(laws),
        drop_height=height,
        drag=drag,
    )
