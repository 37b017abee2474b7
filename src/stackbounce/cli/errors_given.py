"""Numbers of a drop with errors on the command line: ``--height '63 ± 1 cm'``, ``--error``."""

import re
import shlex
from collections.abc import Mapping, Sequence
from typing import Any

from stackbounce.errors import InvalidValue, shown
from stackbounce.model import Drop
from stackbounce.prediction import prediction
from stackbounce.prediction.inputs import add_value

_PATHS = {"height": "height", "speed": "impact_speed", "gravity": "gravity", "gap": "gaps"}
_RIGHT = "PATH=ERROR, such as balls.1.mass=1g"


def split_errors(given: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, str]]:
    """Return the options of a drop without errors, and the texts that have some, by path.

    Parameters
    ----------
    given : mapping
        The options of `stackbounce.cli.options.DROP`.

    Examples
    --------
    >>> plain, written = split_errors({"height": "63 ± 1 cm", "gap": ["2mm"]})
    >>> plain["height"], plain["gap"], written
    ('63 cm', ['2mm'], {'height': '63 ± 1 cm'})
    """
    numbers = {path: given.get(option) for option, path in _PATHS.items()}
    plain, written = prediction.split_errors(numbers)
    texts = enumerate(given.get("contact") or ())
    contacts = [_split_contact(text, f"contacts.{i}", written) for i, text in texts]
    return {option: plain[path] for option, path in _PATHS.items()} | {"contact": contacts}, written


def read_errors(
    drop: Drop, written: Mapping[str, str], errors: Sequence[str] | None
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
    found: dict[str, Any] = dict(written)
    for text in errors or ():
        path, equals, error = (part.strip() for part in text.partition("="))
        if not equals or not error:
            raise InvalidValue(f"--error must be {_RIGHT}, got {shown(text)}")
        if path in found:
            raise InvalidValue(f"--error {path}: only one error can be given, got two")
        found[path] = add_value(drop, path, error, f"--error {path}")
    return found


def _split_contact(text: str, path: str, written: dict[str, str]) -> str:
    """Return the text of a contact law without the errors of its numbers."""
    try:
        words = shlex.split(re.sub(r"\s*(±|\+/-)\s*", "±", text))
    except ValueError:
        return text
    plain = []
    for word in words:
        key, equals, value = word.partition("=")
        plain.append(key + equals + prediction.split_error(value, f"{path}.{key}", written))
    return shlex.join(plain) if any(name.startswith(f"{path}.") for name in written) else text
