"""The options of a measurement, each one once, for every face.

`OPTIONS` feeds the signature of `analyse`, the command line, the page's form, and the table in
`docs/measure.md`. An option is in effect where the analysis of a kind has a keyword of its name.
"""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, TypeAlias

from stackbounce.errors import InvalidType, InvalidValue, nearest, shown
from stackbounce.measure.kinds import KINDS, TYPED
from stackbounce.measure.quantities import quantity_with_error
from stackbounce.model.laws import LAWS, law_named
from stackbounce.units import quantity

__all__ = ["OPTIONS", "Option", "check_options", "options_for", "read_options", "taken_by"]

Form: TypeAlias = Literal[
    "number", "measured", "lengths", "flag", "points", "law", "file", "columns", "text"
]
_BALL, _DROP = "What is known of the ball", "What is known of the drop"
_FILE = "What a file does not say"


@dataclass(frozen=True)
class Option:
    """An option of a measurement.

    Parameters
    ----------
    name : str
        In Python and in a request.
    form : str
        What its value is: a number with a unit, a number that may have an error (``measured``),
        several lengths, a flag, points of the ball, a contact law, a file, columns, a text.
    says : str
        What it tells, for help.
    metavar : str
        What the command line calls its value.
    label, example : str
        In the page's form; without a label it is not offered there.
    panel : str
        The group of options that it belongs to.
    unit : str
        The SI unit of a number.
    default : str or bool, optional
        Where there is one.
    to : {"read", "analyse", "numbers"}
        Whose it is: the reader's, the analyses', or that of numbers without a file.
    flag : str
        On the command line, where it is not the name.
    rare : bool
        Whether the page offers it below the others.
    choices : callable, optional
        Gives what there is to choose from.
    """

    name: str
    form: Form
    says: str
    metavar: str
    label: str
    example: str = ""
    panel: str = ""
    unit: str = ""
    default: str | bool | None = None
    to: Literal["read", "analyse", "numbers"] = "analyse"
    flag: str = ""
    rare: bool = False
    choices: Callable[[], Iterable[str]] | None = None

    @property
    def on_command_line(self) -> str:
        """Its name on the command line."""
        return self.flag or f"--{self.name.replace('_', '-')}"

    def to_mapping(self) -> dict[str, Any]:
        """Return what the page needs to offer it."""
        choices = None if self.choices is None else list(self.choices())
        names = ("name", "form", "label", "example", "says", "rare")
        return {name: getattr(self, name) for name in names} | {"choices": choices}


def _listed(names: Iterable[str]) -> str:
    """Return names as they are typed on the command line."""
    return ", ".join(f"'{name}'" if " " in name else name for name in names)


def _typed(law: str) -> str:
    """Return a law's name as it is typed: ``hunt-crossley``."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", "-", law).lower()


OPTIONS: tuple[Option, ...] = (
    Option(
        "mass",
        "measured",
        "Such as 57g, or with its error '57.0 ± 0.5 g', as all numbers of ball and drop.",
        "MASS",
        "Ball's mass",
        "57 ± 0.5 g",
        _BALL,
        "kg",
    ),
    Option("diameter", "measured", "Such as 66mm.", "LENGTH", "Diameter", "66 mm", _BALL, "m"),
    Option(
        "contact_time",
        "measured",
        "On the floor, where no file tells it: '5.0 ± 0.1 ms'.",
        "TIME",
        "Contact time",
        "5.0 ± 0.1 ms",
        _BALL,
        "s",
        rare=True,
    ),
    Option(
        "restitution",
        "measured",
        "On the floor, where no file tells it: '0.75 ± 0.02'.",
        "NUMBER",
        "Restitution",
        "0.75 ± 0.02",
        _BALL,
        rare=True,
    ),
    Option(
        "law",
        "law",
        f"Give the constants of this contact law, and save it: {_listed(map(_typed, LAWS))}; "
        "with an exponent as in 'power-law exponent=1.3'. A force waveform's touches and "
        "releases are then those of this law, with smaller errors.",
        "LAW",
        "Contact law",
        "none in particular",
        _BALL,
        choices=lambda: LAWS,
    ),
    Option(
        "exponent",
        "number",
        "Of the law's loading curve, where the law leaves it open: 1.3.",
        "NUMBER",
        "Exponent of the law",
        "1.3",
        _BALL,
        rare=True,
    ),
    Option(
        "heights",
        "lengths",
        "Instead of a file: the drop's and those of the bounces, '1.00, 0.62, 0.39 m'.",
        "LENGTHS",
        "",
        "1.00, 0.62, 0.39 m",
        _DROP,
        "m",
        to="numbers",
    ),
    Option(
        "height_error",
        "number",
        "Of each height of --heights or of a table, such as 5mm.",
        "LENGTH",
        "Error of heights",
        "5 mm",
        _DROP,
        "m",
        rare=True,
    ),
    Option(
        "repeated",
        "flag",
        "The heights after the first are of one bounce, from drop after drop.",
        "",
        "Heights of one bounce, again and again",
        panel=_DROP,
        default=False,
        rare=True,
    ),
    Option(
        "measured_to",
        "points",
        "Point of the ball that heights are those of, or that a track follows: bottom, centre "
        "or top; bottom,top if the drop's and the bounces' differ.",
        "POINT",
        "Heights are those of the ball's",
        "bottom",
        _DROP,
        default="bottom",
        choices=lambda: ("bottom", "centre", "top", "bottom,top", "top,bottom"),
    ),
    Option(
        "height",
        "measured",
        "Height fallen from rest, such as 0.63m.",
        "LENGTH",
        "Drop height",
        "1.00 ± 0.01 m",
        unit="m",
    ),
    Option(
        "speed",
        "measured",
        "Impact speed, such as 3.53m/s.",
        "SPEED",
        "Impact speed",
        "3.5 m/s",
        unit="m/s",
    ),
    Option(
        "floor",
        "number",
        "Level of the floor in a track, such as 0m: for balls that stay on it for long.",
        "LENGTH",
        "Level of the floor",
        "0 m",
        _DROP,
        "m",
        rare=True,
    ),
    Option(
        "alone",
        "file",
        "The floor's force under the lower ball alone, from the same height: tells the gap of "
        "the stack that FILE is of.",
        "FILE",
        "Force under the lower ball alone",
        panel=_DROP,
        rare=True,
    ),
    Option(
        "time_constant",
        "number",
        "Of a piezo sensor's droop, such as 0.1s: undoes it.",
        "TIME",
        "Sensor's time constant",
        "0.1 s",
        _DROP,
        "s",
        rare=True,
    ),
    Option(
        "gravity",
        "number",
        "Where it was measured, such as 9.81m/s^2.",
        "ACCELERATION",
        "Gravity",
        "9.81 m/s^2",
        _DROP,
        "m/s**2",
        rare=True,
    ),
    Option(
        "holds",
        "text",
        f"What it holds, where it is unsure: {_listed(KINDS)}.",
        "KIND",
        "It holds",
        "as recognised",
        _FILE,
        to="read",
        choices=lambda: KINDS,
    ),
    Option(
        "names",
        "columns",
        "What a column is, by its name or its number from 1: 2=force; once per column.",
        "COLUMN=MEANING",
        "Columns",
        "1=time, 2=force",
        _FILE,
        to="read",
        flag="--column",
    ),
    Option(
        "units",
        "columns",
        "Unit of a column: x=cm; once per column.",
        "COLUMN=UNIT",
        "Units of columns",
        "x=cm, y=cm",
        _FILE,
        to="read",
        flag="--unit",
    ),
    Option(
        "table",
        "text",
        "Which table of a zip.",
        "NAME",
        "Table",
        "Energy",
        _FILE,
        to="read",
        rare=True,
    ),
    Option(
        "run",
        "text",
        "Which of several runs in it.",
        "RUN",
        "Run",
        "2",
        _FILE,
        to="read",
        rare=True,
    ),
    Option(
        "decimal",
        "text",
        "Decimal mark, . or , where 1,234 could be either.",
        "MARK",
        "Decimal mark",
        "as recognised",
        _FILE,
        to="read",
        rare=True,
        choices=lambda: (".", ","),
    ),
)
"""All options; the command line lists them in this order."""


def options_for(*to: str) -> dict[str, Option]:
    """Return the options of the reader, of the analyses or of numbers, by their names."""
    return {one.name: one for one in OPTIONS if one.to in to}


def taken_by(option: Option) -> list[str]:
    """Return the kinds whose analysis takes an option; the reader's are for every file."""
    kinds = {**KINDS, **{kind.name: kind for kind in TYPED}}
    return [name for name, kind in kinds.items() if option.name in kind.options]


def check_options(given: Iterable[str], to: str) -> None:
    """Refuse options that a function does not take.

    Raises
    ------
    InvalidType
        If one is unknown, or is another function's.
    """
    own = options_for(to)
    for name in given:
        if name not in own:
            misplaced = to == "analyse" and name in options_for("read")
            right = "read takes it" if misplaced else nearest(name, own)
            raise InvalidType(f"{shown(name)} is no option of {to}; {right}")


def read_options(
    given: Mapping[str, Any],
    face: Callable[[Option], str],
    to: Sequence[str] = ("read", "analyse", "numbers"),
) -> dict[str, Any]:
    """Return options with values as `read` and `analyse` take them, those that are given.

    Parameters
    ----------
    given : mapping
        Values by the options' names, texts with units or what they stand for. None and the empty
        text are not given.
    face : callable
        From an option to what messages call it.
    to : sequence of str, optional
        Whose options are offered.

    Raises
    ------
    InvalidType, InvalidValue
        If one is unknown, or its value cannot be read.

    Examples
    --------
    >>> read_options({"height": "1 m", "law": "power-law exponent=1.3"}, lambda one: one.name)
    {'height': 1.0, 'law': <class 'stackbounce.model.laws.elastic.PowerLaw'>, 'exponent': 1.3}
    """
    known = options_for(*to)
    found: dict[str, Any] = {}
    for name, value in given.items():
        if name not in known:
            raise InvalidType(f"{shown(name)} is no option; {nearest(name, known)}")
        if value is None or (isinstance(value, str) and not value):
            continue
        one = known[name]
        if one.form == "law":
            told = _law(value, face(one))
        else:
            told = {name: _READERS[one.form](value, one, face(one))}
        twice = [key for key in told if key in found]
        if twice:
            raise InvalidValue(f"{twice[0]} is given twice, by {face(one)} and on its own")
        found |= told
    return found


def _number(value: Any, option: Option, called: str) -> Any:
    return quantity(value, option.unit, called)


def _measured(value: Any, option: Option, called: str) -> Any:
    read = quantity_with_error if isinstance(value, str) else quantity
    return read(value, option.unit, called)


def _lengths(text: str, option: Option, called: str) -> list[Any]:
    """Return lengths between commas or semicolons; a unit at the end is that of all."""
    words = [word.strip() for word in re.split(r"[,;]", text)]
    unit = re.sub(r"^[-+.\deE±/ ()]+", "", words[-1])
    bare = [not re.search(r"[^-+.\deE±/ ()]", word) for word in words]
    if any(bare) and not (all(bare) or all(bare[:-1])):
        raise InvalidValue(
            f"{called} must have a unit each, or one at the end for all, got {shown(text)}"
        )
    return [
        quantity_with_error(word + unit if is_bare else word, option.unit, f"{called} {k}")
        for k, (word, is_bare) in enumerate(zip(words, bare, strict=True))
    ]


def _flag(value: Any, option: Option, called: str) -> bool:  # noqa: ARG001
    if not isinstance(value, bool):
        raise InvalidType(f"{called} must be true or false, got {shown(value)}")
    return value


def _points(value: Any, option: Option, called: str) -> tuple[str, ...]:  # noqa: ARG001
    """Return the points that the drop's height and the bounces' were measured to."""
    from stackbounce.measure.kinds.heights.analysis import places

    if not isinstance(value, str):
        return places(value)
    words = tuple(word.strip() for word in value.split(","))
    if len(words) > 2:
        raise InvalidValue(f"{called} must be a point or two, got {shown(value)}")
    return places(words * 2 if len(words) == 1 else words)


def _law(value: Any, called: str) -> dict[str, Any]:
    """Return the law's class, and the exponent that may be told with its name."""
    name, *rest = (value.split() or [""]) if isinstance(value, str) else (value,)
    told: dict[str, Any] = {}
    for word in rest:
        key, _, number = word.partition("=")
        if key != "exponent" or not number or told:
            raise InvalidValue(
                f"{called} must be a law, or 'LAW exponent=NUMBER', got {shown(value)}; "
                "restitution and contact time have options of their own"
            )
        told[key] = quantity(number, "", f"{called}: exponent")
    return {"law": law_named(name), **told}


def _columns(value: Any, option: Option, called: str) -> Any:
    """Return a mapping of columns from ``COLUMN=VALUE`` texts, or as it is."""
    if isinstance(value, Mapping):
        return value
    texts = value.split(",") if isinstance(value, str) else value
    found: dict[Any, str] = {}
    for text in texts:
        name, _, told = (part.strip() for part in text.partition("="))
        if not (name and told):
            example = option.example.split(", ")[0]
            raise InvalidValue(
                f"{called} must be {option.metavar}, such as {example}, got {shown(text)}"
            )
        found[int(name) if name.isdecimal() else name] = told
    return found


def _text(value: Any, option: Option, called: str) -> str | int:  # noqa: ARG001
    if not isinstance(value, str | int):
        raise InvalidType(f"{called} must be a text, got {shown(value)}")
    return value


def _file(value: Any, option: Option, called: str) -> Any:  # noqa: ARG001
    """Return a path, or a name and a content: no text, which in a request would be a path too."""
    if not isinstance(value, Path | tuple):
        raise InvalidType(f"{called} must be a file, got {shown(value)}")
    return value


_READERS: dict[str, Callable[[Any, Option, str], Any]] = {
    "number": _number,
    "measured": _measured,
    "lengths": _lengths,
    "flag": _flag,
    "points": _points,
    "columns": _columns,
    "text": _text,
    "file": _file,
}
