"""What was measured of one drop: numbers with errors, counts and force records."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from stackbounce.errors import InvalidType, InvalidValue, all_real, shown, whole
from stackbounce.fitting.quantities import find_quantity, read_with_error
from stackbounce.fitting.waveforms import Waveform, read_waveform
from stackbounce.model import Drop
from stackbounce.run.quantities import QUANTITIES


@dataclass(frozen=True)
class Datum:
    """A number that was measured.

    Parameters
    ----------
    name : str
        Such as ``rebound_ratios.1``.
    quantity : str
        A key of `stackbounce.run.quantities.QUANTITIES`.
    index : int
        The number of its ball or contact.
    value, error : float
        In SI units; the error is one standard deviation, above 0.

    Examples
    --------
    >>> Datum("rebound_ratios.1", "rebound_ratios", 1, 1.64, 0.02).value
    1.64
    """

    name: str
    quantity: str
    index: int
    value: float
    error: float

    @property
    def unit(self) -> str:
        """The SI unit."""
        return QUANTITIES[self.quantity].unit


@dataclass(frozen=True)
class Count:
    """The number of contact intervals that were observed: compared with the fit, not fitted.

    Examples
    --------
    >>> Count("collisions.1", 1, 3).seen
    3
    """

    name: str
    index: int
    seen: int


@dataclass(frozen=True)
class Measured:
    """What was measured of one drop.

    Examples
    --------
    >>> Measured((), (), ()).data
    ()
    """

    data: tuple[Datum, ...]
    counts: tuple[Count, ...]
    waveforms: tuple[Waveform, ...]


def read_measured(drop: Drop, given: object, path: str = "") -> Measured:
    """Check what was measured of a drop and return it.

    Parameters
    ----------
    drop : Drop
        What was dropped.
    given : mapping
        By name: the quantities of `QUANTITIES`, and ``force``. A name stands for one ball or
        contact, ``rebound_ratios.1``, with one number; or for all, with a list that has None where
        nothing was measured. A number is a text with its error, ``"1.64 ± 0.02"``, a pair of the
        two, or a UFloat. A force record is given as for `read_waveform`.
    path : str, optional
        A prefix of the names in messages.

    Returns
    -------
    Measured

    Raises
    ------
    InvalidValue
        If a name is unknown, or a number has no error above 0.
    InvalidType
        If something has the wrong type.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], height=1.0)
    >>> read_measured(drop, {"rebound_ratios": ["0.78 ± 0.02"]}).data[0].error
    0.02
    """
    if not isinstance(given, Mapping) or not given:
        raise InvalidType(
            f"{path.rstrip('.') or 'data'} must map names to what was measured, such as "
            f"{{'rebound_ratios.1': '1.64 ± 0.02'}}, got {shown(given)}"
        )
    data: list[Datum] = []
    counts: list[Count] = []
    waveforms: list[Waveform] = []
    for name, value in _one_by_one(drop, given, path):
        shown_as = path + name
        if name.startswith("force."):
            waveforms.append(read_waveform(drop, name, value, shown_as))
            continue
        base, index = find_quantity(drop, name, shown_as)
        if base == "collisions":
            counts.append(Count(name, index, whole(shown_as, value)))
        else:
            known = QUANTITIES[base]
            right = f"a number with its error, such as '{known.example}'"
            pair = read_with_error(value, known.unit, shown_as, right)
            data.append(Datum(name, base, index, *pair))
    every: list[Datum | Count | Waveform] = [*data, *counts, *waveforms]
    names = [entry.name for entry in every]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise InvalidValue(f"{path}{twice} is given twice")
    return Measured(tuple(data), tuple(counts), tuple(waveforms))


def _one_by_one(drop: Drop, given: Mapping[Any, Any], path: str) -> list[tuple[str, Any]]:
    """Return the names of single numbers with their values."""
    found: list[tuple[str, Any]] = []
    for name, value in given.items():
        if not isinstance(name, str):
            raise InvalidType(f"{path or 'data '}must have names for keys, got {shown(name)}")
        if isinstance(value, np.ndarray):
            value = all_real(path + name, value).tolist()
        known = QUANTITIES.get(name)
        if known is None or not known.part:
            found.append((name, value))
            continue
        count = len(drop.balls)
        if not isinstance(value, Sequence) or isinstance(value, str) or len(value) != count:
            raise InvalidValue(
                f"{path}{name} must be a list of {count}, one for each {known.part}, with None "
                f"where nothing was measured, or be of one {known.part} ({name}.0), "
                f"got {shown(value)}"
            )
        found += [(f"{name}.{i}", part) for i, part in enumerate(value) if part not in (None, "")]
    return found
