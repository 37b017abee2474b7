"""The options of a measurement, each one once, for every face.

`OPTIONS` feeds the signature of `analyse`, the command line, the page's form, and the table in
`docs/measure.md`. An option is in effect where the analysis of a kind has a keyword of its name.
"""

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Any, Literal, TypeAlias

from stackbounce.errors import InvalidType, nearest, shown
from stackbounce.measure.kinds import KINDS, TYPED
from stackbounce.model.laws import LAWS

__all__ = ["OPTIONS", "Option", "check_options", "options_for", "taken_by"]

Form: TypeAlias = Literal[
    "number", "measured", "lengths", "flag", "points", "law", "file", "columns", "text"
]
_UNIT_NAMES = {
    "": "NUMBER",
    "kg": "MASS",
    "m": "LENGTH",
    "s": "TIME",
    "m/s": "SPEED",
    "m/s**2": "ACCELERATION",
}
_FORM_NAMES = {"lengths": "LENGTHS", "points": "POINT"}
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
    label : str
        In the page's form and the documentation.
    says : str
        What it tells, for help.
    example : str
        A value, or what the form shows where none is chosen.
    unit : str
        The SI unit of a number.
    metavar : str
        What the command line calls its value; by default as its unit or form says.
    panel : str
        The group of options that it belongs to.
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
    label: str
    says: str
    example: str = ""
    unit: str = ""
    metavar: str = ""
    panel: str = ""
    default: str | bool | None = None
    to: Literal["read", "analyse", "numbers"] = "analyse"
    flag: str = ""
    rare: bool = False
    choices: Callable[[], Iterable[str]] | None = None

    @property
    def on_command_line(self) -> str:
        """Its name on the command line."""
        return self.flag or f"--{self.name.replace('_', '-')}"

    @property
    def value_name(self) -> str:
        """What the command line calls its value."""
        own = _UNIT_NAMES[self.unit] if self.form in ("number", "measured") else ""
        return self.metavar or own or _FORM_NAMES.get(self.form, self.name.upper())

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


_TABLE: dict[str, tuple[Option, ...]] = {
    _BALL: (
        Option(
            "mass",
            "measured",
            "Ball's mass",
            "Such as 57g, or with its error '57.0 ± 0.5 g', as all numbers of ball and drop.",
            example="57 ± 0.5 g",
            unit="kg",
        ),
        Option("diameter", "measured", "Diameter", "Such as 66mm.", example="66 mm", unit="m"),
        Option(
            "contact_time",
            "measured",
            "Contact time",
            "On the floor, where no file tells it: '5.0 ± 0.1 ms'.",
            example="5.0 ± 0.1 ms",
            unit="s",
            rare=True,
        ),
        Option(
            "restitution",
            "measured",
            "Restitution",
            "On the floor, where no file tells it: '0.75 ± 0.02'.",
            example="0.75 ± 0.02",
            rare=True,
        ),
        Option(
            "law",
            "law",
            "Contact law",
            f"Give the constants of this contact law, and save it: {_listed(map(_typed, LAWS))}; "
            "with an exponent as in 'power-law exponent=1.3'. A force waveform's touches and "
            "releases are then those of this law, with smaller errors.",
            example="none in particular",
            choices=lambda: LAWS,
        ),
        Option(
            "exponent",
            "number",
            "Exponent of the law",
            "Of the law's loading curve, where the law leaves it open: 1.3.",
            example="1.3",
            rare=True,
        ),
    ),
    "": (
        Option(
            "height",
            "measured",
            "Drop height",
            "Height fallen from rest, such as 0.63m.",
            example="1.00 ± 0.01 m",
            unit="m",
        ),
        Option(
            "speed",
            "measured",
            "Impact speed",
            "Impact speed, such as 3.53m/s.",
            example="3.5 m/s",
            unit="m/s",
        ),
    ),
    _DROP: (
        Option(
            "heights",
            "lengths",
            "Heights",
            "Instead of a file: the drop's and those of the bounces, '1.00, 0.62, 0.39 m'.",
            example="1.00, 0.62, 0.39 m",
            unit="m",
            to="numbers",
        ),
        Option(
            "height_error",
            "number",
            "Error of heights",
            "Of each height of --heights or of a table, such as 5mm.",
            example="5 mm",
            unit="m",
            rare=True,
        ),
        Option(
            "repeated",
            "flag",
            "Heights of one bounce, again and again",
            "The heights after the first are of one bounce, from drop after drop.",
            default=False,
            rare=True,
        ),
        Option(
            "measured_to",
            "points",
            "Heights are those of the ball's",
            "Point of the ball that heights are those of, or that a track follows: bottom, "
            "centre or top; bottom,top if the drop's and the bounces' differ.",
            example="bottom",
            default="bottom",
            choices=lambda: ("bottom", "centre", "top", "bottom,top", "top,bottom"),
        ),
        Option(
            "floor",
            "number",
            "Level of the floor",
            "Level of the floor in a track, such as 0m: for balls that stay on it for long.",
            example="0 m",
            unit="m",
            rare=True,
        ),
        Option(
            "alone",
            "file",
            "Force under the lower ball alone",
            "The floor's force under the lower ball alone, from the same height: tells the "
            "gap of the stack that FILE is of.",
            rare=True,
        ),
        Option(
            "time_constant",
            "number",
            "Sensor's time constant",
            "Of a piezo sensor's droop, such as 0.1s: undoes it.",
            example="0.1 s",
            unit="s",
            rare=True,
        ),
        Option(
            "gravity",
            "number",
            "Gravity",
            "Where it was measured, such as 9.81m/s^2.",
            example="9.81 m/s^2",
            unit="m/s**2",
            rare=True,
        ),
    ),
    _FILE: (
        Option(
            "holds",
            "text",
            "It holds",
            f"What it holds, where it is unsure: {_listed(KINDS)}.",
            example="as recognised",
            metavar="KIND",
            to="read",
            choices=lambda: KINDS,
        ),
        Option(
            "names",
            "columns",
            "Columns",
            "What a column is, by its name or its number from 1: 2=force; once per column.",
            example="1=time, 2=force",
            metavar="COLUMN=MEANING",
            to="read",
            flag="--column",
        ),
        Option(
            "units",
            "columns",
            "Units of columns",
            "Unit of a column: x=cm; once per column.",
            example="x=cm, y=cm",
            metavar="COLUMN=UNIT",
            to="read",
            flag="--unit",
        ),
        Option(
            "table",
            "text",
            "Table",
            "Which table of a zip.",
            example="Energy",
            metavar="NAME",
            to="read",
            rare=True,
        ),
        Option(
            "run", "text", "Run", "Which of several runs in it.", example="2", to="read", rare=True
        ),
        Option(
            "decimal",
            "text",
            "Decimal mark",
            "Decimal mark, . or , where 1,234 could be either.",
            example="as recognised",
            to="read",
            rare=True,
            choices=lambda: (".", ","),
        ),
    ),
}

OPTIONS: tuple[Option, ...] = tuple(
    replace(one, panel=panel) for panel, group in _TABLE.items() for one in group
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
