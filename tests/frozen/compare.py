"""Differences between what was and what is.

Some analyses are not the same to the last bit from run to run: `uncertainties` adds up covariances
in the order of a set of objects, that is of their places in memory. So values are compared in units
of their errors where these are larger. With all bits compared, restitutions from sound differ.
"""

import math
import re
import struct
from collections.abc import Iterator
from typing import Any, NamedTuple

RELATIVE = 1e-9  # a change of a number that counts
ABSOLUTE = 1e-14  # and below which none does: what should be 0 is round-off
_NUMBER = re.compile(r"[-+−]?\d+(?:[.,]\d+)?(?:e[-+]?\d+)?")
_CUT = 60  # characters of a text that are shown
_MISSING = object()


class Difference(NamedTuple):
    """A value that is not what it was."""

    path: str
    before: str
    now: str
    how: str  # by how much, or what of it

    def __str__(self) -> str:
        return f"{self.path}: {self.before} → {self.now} ({self.how})"


def differences(before: dict[str, Any], now: dict[str, Any], exact: bool) -> list[Difference]:
    """Return where two flat tables differ.

    Parameters
    ----------
    before, now : dict of str to Any
        As `values.flat` gives them.
    exact : bool
        Whether numbers must agree in all bits, rather than to `RELATIVE`.

    Returns
    -------
    list of Difference
        In the order of the paths, those that are new last.
    """
    return list(_differences(before, now, exact))


def _differences(before: dict[str, Any], now: dict[str, Any], exact: bool) -> Iterator[Difference]:
    for path in [*before, *(path for path in now if path not in before)]:
        old, new = before.get(path, _MISSING), now.get(path, _MISSING)
        if old is _MISSING:
            yield Difference(path, "nothing", _short(new), "new")
        elif new is _MISSING:
            yield Difference(path, _short(old), "nothing", "gone")
        elif isinstance(old, dict) and isinstance(new, dict):
            yield from _arrays(path, old, new, exact)
        elif isinstance(old, str) and isinstance(new, str):
            if old != new:
                yield _texts(path, old, new)
        elif _is_number(old) and _is_number(new):
            if not same(old, new, exact, _size(path, before)):
                yield Difference(path, repr(old), repr(new), _relative(old, new))
        elif type(old) is not type(new) or old != new:
            yield Difference(path, _short(old), _short(new), "another kind of value")


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _size(path: str, table: dict[str, Any]) -> float:
    """Return the error that stands beside a value: digits far below it are round-off."""
    owner, _, name = path.rpartition("/")
    error = table.get(f"{owner}/error") if name == "value" else None
    return float(error) if isinstance(error, int | float) and math.isfinite(error) else 0.0


def same(old: float, new: float, exact: bool, size: float = 0.0) -> bool:
    """Return whether two numbers are the same, `size` being that of the numbers around them."""
    if exact:
        return type(old) is type(new) and (old == new if isinstance(old, int) else _bits(old, new))
    if math.isnan(old) or math.isnan(new) or math.isinf(old) or math.isinf(new):
        return old == new or (math.isnan(old) and math.isnan(new))
    return abs(old - new) <= max(RELATIVE * max(abs(old), abs(new), size), ABSOLUTE)


def _bits(old: float, new: float) -> bool:
    return struct.pack("<d", old) == struct.pack("<d", new)


def _relative(old: float, new: float) -> str:
    largest = max(abs(old), abs(new))
    return f"relative {abs(new - old) / largest:.2g}" if 0.0 < largest < math.inf else "not finite"


def _arrays(
    path: str, old: dict[str, Any], new: dict[str, Any], exact: bool
) -> Iterator[Difference]:
    """Yield at most one difference of two long arrays.

    Sums may differ by what one of the numbers may differ by: they tell a change of a single one.
    """
    alike = "bits" if exact else "digits"
    if old[alike] == new[alike]:
        return
    if exact:
        told = "low high sum mixed"
        row = next((name for name in told.split() if old[name] != new[name]), "bits")
    else:
        size = max(abs(old["low"]), abs(old["high"]))
        told = "count missing low high sum mixed"
        row = next((one for one in told.split() if not same(old[one], new[one], False, size)), "")
    if row == "bits":
        yield Difference(path, old["bits"], new["bits"], f"bits of {old['count']} numbers")
    elif row:
        how = f"{row} of {old['count']} numbers, {_relative(old[row], new[row])}"
        yield Difference(path, repr(old[row]), repr(new[row]), how)


def _texts(path: str, old: str, new: str) -> Difference:
    """Return how two texts differ, by their first lines that do."""
    lines = [text.splitlines() for text in (old, new)]
    alike = 0
    while alike < min(map(len, lines)) and lines[0][alike] == lines[1][alike]:
        alike += 1
    first = [one[alike] if alike < len(one) else "the end" for one in lines]
    start = 0
    while start < min(map(len, first)) and first[0][start] == first[1][start]:
        start += 1
    start = max(0, start - _CUT // 3)
    shown = [_short(one[start:]) for one in first]
    words = _NUMBER.sub("0", old) != _NUMBER.sub("0", new)
    counts = _NUMBER.findall(old) != _NUMBER.findall(new)
    what = " and ".join(["words"] * words + ["numbers"] * counts) or "blanks"
    return Difference(path, shown[0], shown[1], f"{what}, line {alike + 1}")


def _short(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= _CUT else f"{text[:_CUT]}…"
