"""Hints: options that a message recommends, which each user interface says in its own words."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

from stackbounce.errors import StackbounceError

__all__ = ["Hint", "Said", "Words", "about", "in_python", "in_words", "joined", "said"]


@dataclass(frozen=True)
class Hint:
    """Options of a measurement with the values that a message recommends.

    Parameters
    ----------
    options : mapping
        Values by the names that the options have in Python. A value is a text, a mapping of
        columns to texts, or None where only the option's name is to be said.
    file : str
        The file's name, where the whole call is to be said.
    """

    options: Mapping[str, Any]
    file: str = ""


Words: TypeAlias = Callable[[Hint], str]
"""What an interface makes of a hint."""


def in_python(hint: Hint) -> str:
    """Return a hint as it is written in Python.

    Examples
    --------
    >>> in_python(Hint({"names": {1: "time"}})), in_python(Hint({"holds": None}))
    ("names={1: 'time'}", 'holds')
    """
    told = ", ".join(
        name if value is None else f"{name}={value!r}" for name, value in hint.options.items()
    )
    return f"read({hint.file!r}, {told})" if hint.file else told


class Said(str):
    """A message with hints in it: a text in Python's words that can be said in others.

    Examples
    --------
    >>> Said("taken as m; ", Hint({"units": {"x": "cm"}}), " tells another")
    "taken as m; units={'x': 'cm'} tells another"
    """

    parts: "tuple[str | Hint, ...]"

    def __new__(cls, *parts: "str | Hint") -> "Said":
        """Join texts and hints."""
        flat: list[str | Hint] = []
        for part in parts:
            flat.extend(part.parts if isinstance(part, Said) else [part])
        text = "".join(in_python(one) if isinstance(one, Hint) else one for one in flat)
        made = super().__new__(cls, text)
        made.parts = tuple(flat)
        return made


def joined(between: str, texts: Iterable[str]) -> Said:
    """Join messages; their hints are kept."""
    parts: list[str | Hint] = []
    for text in texts:
        parts += [between, text] if parts else [text]
    return Said(*parts)


def said(error: StackbounceError) -> str:
    """Return an error's message, with its hints if it has any."""
    message = error.args[0] if error.args else ""
    return message if isinstance(message, Said) else str(error)


def about(name: str, error: StackbounceError, words: Words | None = None) -> StackbounceError:
    """Return an error with a file's name before its message, and perhaps in an interface's words.

    Examples
    --------
    >>> from stackbounce.errors import InvalidValue
    >>> str(about("a.csv", InvalidValue("it is empty")))
    'a.csv: it is empty'
    """
    text = said(error)
    parts = text.parts if isinstance(text, Said) else (text,)
    named = (
        replace(one, file=name) if isinstance(one, Hint) and one.file else one for one in parts
    )
    whole = Said(f"{name}: ", *named)
    return type(error)(whole if words is None else in_words(whole, words))


def in_words(text: str, words: Words) -> str:
    """Return a message in the words of an interface.

    Examples
    --------
    >>> text = Said("see ", Hint({"run": None}))
    >>> in_words(text, lambda hint: " ".join(f"--{name}" for name in hint.options))
    'see --run'
    """
    if not isinstance(text, Said):
        return text
    return "".join(words(one) if isinstance(one, Hint) else one for one in text.parts)
