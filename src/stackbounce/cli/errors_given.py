"""Numbers of a drop with errors on the command line: ``--height '63 ± 1 cm'``, ``--error``."""

import re
import shlex
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from stackbounce.errors import InvalidValue, shown

if TYPE_CHECKING:
    from stackbounce.model import Drop

_PATHS = {"height": "height", "speed": "impact_speed", "gravity": "gravity"}
_RIGHT = "PATH=ERROR, such as balls.1.mass=1g"


def split_errors(given: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, str]]:
    """Return the options of a drop without errors, and the texts that have some, by path.

    Parameters
    ----------
    given : mapping
        The options of `stackbounce.cli.options.DROP`.

    Examples
    --------
    >>> split_errors({"height": "63 ± 1 cm", "gap": ["2mm"]})
    ({'height': '63 cm', 'gap': ['2mm']}, {'height': '63 ± 1 cm'})
    """
    plain, written = dict(given), dict[str, str]()
    for option, path in _PATHS.items():
        if given.get(option) is not None:
            plain[option] = _split(given[option], path, written)
    if given.get("gap"):
        plain["gap"] = [_split(text, f"gaps.{i}", written) for i, text in enumerate(given["gap"])]
    if given.get("contact"):
        plain["contact"] = [
            _split_contact(text, f"contacts.{i}", written)
            for i, text in enumerate(given["contact"])
        ]
    return plain, written


def read_errors(
    drop: "Drop", written: Mapping[str, str], errors: Sequence[str] | None
) -> dict[str, Any]:
    """Return the numbers of a drop with errors, by path.

    Parameters
    ----------
    drop : Drop
        With the numbers without errors.
    written : mapping
        As `split_errors` returns them.
    errors : sequence of str or None
        The texts of ``--error``.

    Raises
    ------
    InvalidValue
        If a text cannot be read, or a number has two errors.
    """
    from stackbounce.prediction.inputs import add_value

    found: dict[str, Any] = dict(written)
    for text in errors or ():
        path, equals, error = (part.strip() for part in text.partition("="))
        if not equals or not error:
            raise InvalidValue(f"--error must be {_RIGHT}, got {shown(text)}")
        if path in found:
            raise InvalidValue(f"--error {path}: only one error can be given, got two")
        found[path] = add_value(drop, path, error, f"--error {path}")
    return found


def _split(text: str, path: str, written: dict[str, str]) -> str:
    """Return a quantity without its error; a text that has one is noted by its path."""
    from stackbounce.prediction.scenario import split_error

    return split_error(text, path, written)


def _split_contact(text: str, path: str, written: dict[str, str]) -> str:
    """Return the text of a contact law without the errors of its numbers."""
    try:
        words = shlex.split(re.sub(r"\s*(±|\+/-)\s*", "±", text))
    except ValueError:
        return text
    plain = []
    for word in words:
        key, equals, value = word.partition("=")
        plain.append(key + equals + _split(value, f"{path}.{key}", written))
    return shlex.join(plain) if any(name.startswith(f"{path}.") for name in written) else text
