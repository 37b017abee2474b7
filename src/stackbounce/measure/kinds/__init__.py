"""The kinds of measurement, and a folder for each with its analysis and its result."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from stackbounce.files import shipped_table
from stackbounce.measure.kind import Kind

if TYPE_CHECKING:
    from stackbounce.measure.reading.roles import Column

__all__ = ["KINDS", "TYPED", "Kind", "kind_named"]


def _is_press_curve(columns: "Sequence[Column]") -> bool:
    """Return whether the columns have a force and a compression, or one length.

    Beside times, a length that is a position is none: that is a motion detector's.
    """
    roles = {column.role for column in columns}
    others = ("force", "x", "y") if "time" in roles else ("force",)
    lengths = [column for column in columns if column.unit == "m" and column.role not in others]
    return "force" in roles and ("compression" in roles or len(lengths) == 1)


def _read_kinds(group: str) -> Iterator[Kind]:
    """Return the kinds of a group of kinds.toml."""
    recognised = {"press curve": _is_press_curve}
    for name, about in shipped_table(__package__, "kinds.toml")[group].items():
        module = f"{__name__}.{about.pop('module')}"
        yield Kind(name, module=module, recognised=recognised.get(name), **about)


KINDS: dict[str, Kind] = {kind.name: kind for kind in _read_kinds("file")}
"""What a file can hold; the first one that a file's columns fit is what it holds."""

TYPED: tuple[Kind, ...] = (KINDS["table"], *_read_kinds("numbers"))
"""What numbers without a file can tell."""


def kind_named(text: str) -> str | None:
    """Return the name of a kind of files, which may be typed in other ways; None for no kind.

    Examples
    --------
    >>> kind_named("press-curve"), kind_named("Press"), kind_named("sounds")
    ('press curve', 'press curve', None)
    """
    typed = " ".join(text.casefold().replace("-", " ").replace("_", " ").split())
    return next((name for name in KINDS if typed in (name, name.split()[0])), None)
