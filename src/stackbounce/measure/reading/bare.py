"""Columns without names -> what their numbers look like: samples of a scope, points of a track."""

import numpy as np

from stackbounce.measure.messages import Message, OptionHint
from stackbounce.measure.quantities import Array
from stackbounce.measure.reading.headings import heading
from stackbounce.measure.reading.roles import Column, column

_LEAST_ROWS = 5  # that tell times
_MANY_ROWS = 20  # that tell frames, or samples of a scope
_UNEVEN = 0.1  # of a step, by which rounding may move times
_LONGEST_SAMPLE = 1e-3  # s, the step of an oscilloscope or sensor
_LONGEST_FRAME = 0.2  # s, the step of a video
NOT_NAMED = Message(
    "no header names the columns: name them, as in ", OptionHint({"names": {1: "time", 2: "force"}})
)


def guess(rows: Array) -> tuple[tuple[Column, ...], str]:
    """Return what columns look like by their first rows, (rows, columns), and why.

    Counted rows with two more columns are frames with x and y in an image. Evenly rising numbers
    are times: with steps up to 1 ms beside the voltage of one channel, with longer ones beside x
    and y. Anything else stays without a meaning.

    Examples
    --------
    >>> found, _ = guess(np.stack([np.arange(30), np.ones(30), np.arange(30) ** 2], axis=1))
    >>> [column.role for column in found]
    ['frame', 'x', 'y']
    """
    width = rows.shape[1]
    known = rows[np.isfinite(rows).all(axis=1)]
    step = _step(known[:, 0]) if len(known) >= _LEAST_ROWS and width > 1 else 0.0
    many = len(known) >= _MANY_ROWS
    if many and step == 1.0 and width == 3 and (known[:, 0] == np.round(known[:, 0])).all():
        return _named(("frame", "x", "y"), "the first counts frames, so that x and y follow")
    said = f"the first rises in steps of {step:.4g}, so that it is taken as time in s"
    if many and 0.0 < step <= _LONGEST_SAMPLE and width == 2:
        return _named(("time", "voltage"), f"{said}, the other as the voltage of a scope")
    if _LONGEST_SAMPLE < step <= _LONGEST_FRAME and width == 3:
        return _named(("time", "x", "y"), f"{said}, the others as x and y")
    if 0.0 < step <= _LONGEST_SAMPLE:
        return _named(("time", *[""] * (width - 1)), said)
    return tuple(column(k, heading("")) for k in range(width)), NOT_NAMED


def _named(roles: tuple[str, ...], said: str) -> tuple[tuple[Column, ...], str]:
    units = {"time": "s", "voltage": "V"}
    columns = tuple(
        column(k, heading("", units.get(role, "")), role) for k, role in enumerate(roles)
    )
    said = f"no header names the columns: {said}; if that is wrong, "
    return columns, Message(said, OptionHint({"names": None}), " tells what they are")


def _step(numbers: Array) -> float:
    """Return the step of evenly rising numbers, within their rounding; 0 of any others."""
    step = float(numbers[-1] - numbers[0]) / (len(numbers) - 1)
    even = numbers[0] + step * np.arange(len(numbers))
    rising = step > 0.0 and bool((np.diff(numbers) > 0.0).all())
    return step if rising and float(np.abs(numbers - even).max()) < _UNEVEN * step else 0.0
