"""Reads texts such as ``contacts.0.stiffness=1e3:1e6:400:log``: a parameter and its values."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidValue, shown
from stackbounce.model import Drop
from stackbounce.run.paths import number_at
from stackbounce.units import count_written, quantity

_MOST = 10**9
_RIGHT = "PATH=START:STOP:COUNT, with :log for logarithmic spacing, or PATH=VALUE,VALUE,…"


def grid(drop: Drop, texts: Sequence[str]) -> dict[str, NDArray[np.float64]]:
    """Return the values of each parameter that the texts describe, by its path.

    Raises
    ------
    InvalidValue
        If a text cannot be read, or two name the same number.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], height=1.0)
    >>> grid(drop, ["balls.0.mass=1kg:3kg:3", "height=5cm,50cm"])
    {'balls.0.mass': array([1., 2., 3.]), 'height': array([0.05, 0.5 ])}
    """
    found: dict[str, NDArray[np.float64]] = {}
    for text in texts:
        path, values = axis(drop, text)
        if path in found:
            raise InvalidValue(f"--over must name each number once, got {path} twice")
        found[path] = values
    return found


def axis(drop: Drop, text: str) -> tuple[str, NDArray[np.float64]]:
    """Return the path of the parameter that a text describes, and its values in SI units.

    Parameters
    ----------
    drop : Drop
        The drop that has the parameter.
    text : str
        ``PATH=START:STOP:COUNT`` for equal steps, the same with ``:log`` for equal ratios, or
        ``PATH=VALUE,VALUE,…``; values with or without units.

    Returns
    -------
    path : str
    values : ndarray
        (n,)

    Raises
    ------
    InvalidValue
        If the text cannot be read or the drop has no such number.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], height=1.0)
    >>> axis(drop, "contacts.0.stiffness=1kN/m:100kN/m:3:log")
    ('contacts.0.stiffness', array([  1000.,  10000., 100000.]))
    >>> axis(drop, "balls.0.mass=1g:3g:3:lin"), axis(drop, "balls.0.mass=1g,20g")
    (('balls.0.mass', array([0.001, 0.002, 0.003])), ('balls.0.mass', array([0.001, 0.02 ])))
    """
    path, equals, written = text.partition("=")
    if not equals or not written:
        raise InvalidValue(f"--over must be {_RIGHT}, got {shown(text)}")
    path, written = path.strip(), written.strip()
    number = number_at(drop, path)
    parts = written.split(":")
    if len(parts) == 1:
        values = [quantity(text, number.unit, path) for text in written.split(",")]
        return path, np.array(values)
    spacing = parts[3:]
    if len(parts) < 3 or not parts[2].isdecimal() or spacing not in ([], ["log"], ["lin"]):
        raise InvalidValue(f"--over must be {_RIGHT}, got {shown(text)}")
    start, stop = (quantity(text, number.unit, path) for text in parts[:2])
    count = count_written(parts[2])
    if count is None or not 1 <= count <= _MOST:
        many = shown(parts[2]).strip("'")
        raise InvalidValue(f"--over {path} must have from 1 to {_MOST} values, got {many}")
    if spacing != ["log"]:
        return path, np.linspace(start, stop, count)
    if not start * stop > 0.0:
        raise InvalidValue(
            f"--over {path} must run between numbers of one sign for :log, not from or to 0, "
            f"got {written}"
        )
    return path, np.geomspace(start, stop, count)
