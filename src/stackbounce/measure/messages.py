"""Messages that recommend options, which each user interface words as its users type them."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

from stackbounce.errors import InvalidValue, StackbounceError


@dataclass(frozen=True)
class OptionHint:
    """Options of a measurement with the values that a message recommends.

    Parameters
    ----------
    options : mapping
        Values by the names that the options have in Python. A value is a text, a mapping of
        columns to texts, or None where only the option's name is wanted.
    file : str
        The file's name, where the whole call is wanted.
    """

    options: Mapping[str, Any]
    file: str = ""


PART = OptionHint({"start": None, "stop": None})
"""The options that choose a part of a record."""

Wording: TypeAlias = Callable[[OptionHint], str]
"""What a user interface makes of a hint."""


def python_wording(hint: OptionHint) -> str:
    """Return a hint as it is written in Python.

    Examples
    --------
    >>> python_wording(OptionHint({"names": {1: "time"}, "run": None}))
    "names={1: 'time'}, run"
    """
    options = ", ".join(
        name if value is None else f"{name}={value!r}" for name, value in hint.options.items()
    )
    return f"read({hint.file!r}, {options})" if hint.file else options


class Message(str):
    """A text with hints in it: as a text it has them in Python's wording.

    Examples
    --------
    >>> text = Message("taken as m; ", OptionHint({"units": {"x": "cm"}}), " tells another")
    >>> text
    "taken as m; units={'x': 'cm'} tells another"
    >>> text.worded(lambda hint: " ".join(f"--{name}" for name in hint.options))
    'taken as m; --units tells another'
    """

    parts: "tuple[str | OptionHint, ...]"

    def __new__(cls, *parts: "str | OptionHint") -> "Message":
        """Join texts, messages and hints."""
        flat: list[str | OptionHint] = []
        for part in parts:
            flat.extend(part.parts if isinstance(part, Message) else [part])
        text = "".join(python_wording(p) if isinstance(p, OptionHint) else p for p in flat)
        message = super().__new__(cls, text)
        message.parts = tuple(flat)
        return message

    @classmethod
    def of(cls, error: StackbounceError) -> "Message":
        """Return the message of an error."""
        return cls(error.args[0] if error.args else "")

    def join(self, texts: Iterable[str]) -> "Message":
        """Join texts, and keep the hints of those that are messages."""
        return Message(*[part for text in texts for part in (self, text)][1:])

    def of_file(self, name: str) -> "Message":
        """Return the message with a file's name before it and in its hints of whole calls."""
        named = (
            replace(part, file=name) if isinstance(part, OptionHint) and part.file else part
            for part in self.parts
        )
        return Message(f"{name}: ", *named)

    def worded(self, wording: Wording) -> str:
        """Return the text in the wording of a user interface."""
        return "".join(wording(p) if isinstance(p, OptionHint) else p for p in self.parts)


def about_option(
    name: str, text: str, kind: type[StackbounceError] = InvalidValue
) -> StackbounceError:
    """Return an error whose message begins with the name of an option.

    Examples
    --------
    >>> about_option("run", " must be one that is there")
    InvalidValue('run must be one that is there')
    """
    return kind(Message(OptionHint({name: None}), text))
