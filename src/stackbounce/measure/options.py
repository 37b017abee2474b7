"""The options of a measurement, defined once for all user interfaces.

`OPTIONS` feeds the command line, the page's form, and the table in `docs/measure.md`. An option is
in effect for the kinds that name it in their `options`.
"""

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Literal, TypeAlias

from stackbounce.errors import finite, fraction, non_negative, positive
from stackbounce.measure.kinds import KINDS, TYPED
from stackbounce.model.laws import LAWS
from stackbounce.units import examples

Form: TypeAlias = Literal[
    "number", "measured", "lengths", "flag", "points", "law", "file", "columns", "text"
]
_FORM_NAMES = {"lengths": "LENGTHS", "points": "POINT"}
_BALL, _DROP = "What is known of the ball", "What is known of the drop"
_FILE = "What the file does not state"


@dataclass(frozen=True)
class Option:
    """An option of a measurement.

    Parameters
    ----------
    name : str
        In Python and in a request.
    label : str
        In the page's form and the documentation.
    example : str
        A value, or what the form shows where none is chosen.
    says : str
        The help text.
    form : str
        What its value is: a number with a unit, a number that may have an error (``measured``),
        several lengths, a flag, points of the ball, a contact law, a file, columns, a text.
    unit : str
        The SI unit of a number.
    metavar : str
        What the command line calls its value; by default as its unit or form says.
    panel : str
        The group of options that it belongs to.
    default : str or bool, optional
        Where there is one.
    to : {"read", "analyse", "numbers"}
        Which function takes it: the reader, the analyses, or the analysis of typed numbers.
    flag : str
        On the command line, where it is not the name.
    rare : bool
        Whether the page offers it below the others.
    choices : callable, optional
        Gives what there is to choose from.
    check : callable
        Refuses a number that is out of range, whether an analysis takes it or not.
    """

    name: str
    label: str
    example: str
    says: str
    form: Form = "text"
    unit: str = ""
    metavar: str = ""
    panel: str = ""
    default: str | bool | None = None
    to: Literal["read", "analyse", "numbers"] = "analyse"
    flag: str = ""
    rare: bool = False
    choices: Callable[[], Iterable[str]] | None = None
    check: Callable[..., float] = positive

    @property
    def on_command_line(self) -> str:
        """Its name on the command line."""
        return self.flag or f"--{self.name.replace('_', '-')}"

    @property
    def value_name(self) -> str:
        """What the command line calls its value."""
        if self.form in ("number", "measured"):
            return examples()[self.unit][0].split()[-1].upper()  # a mass: MASS
        return self.metavar or _FORM_NAMES.get(self.form, self.name.upper())

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


_number, _measured = partial(Option, form="number"), partial(Option, form="measured")
_read = partial(Option, to="read")

# fmt: off
_TABLE: dict[str, tuple[Option, ...]] = {
    _BALL: (
        _measured("mass", "Ball's mass", "57 ± 0.5 g", unit="kg", says="Such as 57g, or with its "
                  "error '57.0 ± 0.5 g', as all numbers of ball and drop."),
        _measured("diameter", "Diameter", "66 mm", unit="m", says="Such as 66mm."),
        _measured("contact_time", "Contact time", "5.0 ± 0.1 ms", unit="s", rare=True,
                  check=non_negative,
                  says="On the floor, if no file gives it: '5.0 ± 0.1 ms'."),
        _measured("restitution", "Restitution", "0.75 ± 0.02", rare=True, check=fraction,
                  says="On the floor, if no file gives it: '0.75 ± 0.02'."),
        Option("law", "Contact law", "none in particular", form="law", choices=lambda: LAWS,
               says="Give the constants of this contact law, and save it: "
               f"{_listed(map(_typed, LAWS))}. "
               "A force waveform's touches and releases are then those of this law, with smaller "
               "errors."),
        _number("exponent", "Exponent of the law", "1.3", rare=True,
                says="Of the law's loading curve, if the law does not fix it: 1.3."),
    ),
    "": (
        _measured("height", "Drop height", "1.00 ± 0.01 m", unit="m",
                  says="Height fallen from rest, such as 0.63m."),
        _measured("speed", "Impact speed", "3.5 m/s", unit="m/s",
                  says="Impact speed, such as 3.53m/s."),
    ),
    _DROP: (
        Option("heights", "Heights", "1.00, 0.62, 0.39 m", form="lengths", unit="m", to="numbers",
               says="Instead of a file: the drop's and those of the bounces, "
               "'1.00, 0.62, 0.39 m'."),
        _number("height_error", "Error of each height", "5 mm", unit="m", rare=True,
                says="Of each height that is typed or in a table, such as 5mm."),
        Option("repeated", "Heights of the same bounce, repeated", "", form="flag",
               default=False, rare=True,
               says="The heights after the first are all of the first bounce, of several drops."),
        Option("measured_to", "Heights refer to the ball's", "bottom", form="points",
               default="bottom",
               choices=lambda: ("bottom", "centre", "top", "bottom,top", "top,bottom"),
               says="Point of the ball that heights are those of, or that a track follows: bottom, "
               "centre or top; bottom,top if the drop's and the bounces' differ."),
        _number("floor", "Level of the floor", "0 m", unit="m", rare=True, check=finite,
                says="Level of the floor in a track, such as 0m: for balls that stay on it for "
                "long."),
        Option("alone", "Force under the lower ball alone", "", form="file", rare=True,
               says="Force record of the lower ball alone from the same height: it gives the gap "
               "of the stack in the other record."),
        Option("tabulated", "Press curve as a table", "", form="flag", default=False, rare=True,
               says="Save a press curve as the table of its points, in place of a fitted law."),
        _number("time_constant", "Sensor's time constant", "0.1 s", unit="s", rare=True,
                says="Time constant of a piezo sensor, such as 0.1s: its droop is corrected."),
        _number("gravity", "Gravity", "9.81 m/s^2", unit="m/s**2", rare=True,
                says="At the place of the measurement, such as 9.81m/s^2."),
        _measured("drag_coefficient", "Drag coefficient", "0.45 ± 0.05", rare=True,
                  check=non_negative,
                  says="Takes the drag of the air into account, with the ball's mass and diameter: "
                  "'0.45 ± 0.05' for a smooth sphere. Without it there is no air."),
        _measured("air_density", "Density of the air", "1.20 kg/m^3", unit="kg/m**3", rare=True,
                  says="With a drag coefficient, such as 1.1kg/m^3; by default that at 20 °C and "
                  "sea level, 1.204kg/m^3."),
    ),
    _FILE: (
        _read("holds", "Kind of measurement", "as recognised", metavar="KIND",
              choices=lambda: KINDS,
              says=f"Kind of measurement in the file, if not recognised: {_listed(KINDS)}."),
        _read("names", "Columns", "1=time, 2=force", form="columns", metavar="COLUMN=MEANING",
              flag="--column",
              says="What a column is, by its name or its number from 1: 2=force or force=2; once "
              "per column."),
        _read("units", "Units of columns", "x=cm, y=cm", form="columns", metavar="COLUMN=UNIT",
              flag="--unit", says="Unit of a column: x=cm; once per column."),
        _read("table", "Table", "Energy", metavar="NAME", rare=True,
              says="Which table of a zip file, or sheet of a spreadsheet."),
        _read("run", "Run", "2", rare=True, says="Which of several runs in the file."),
        _read("decimal", "Decimal mark", "as recognised", rare=True, choices=lambda: (".", ","),
              says="Decimal mark, . or , where 1,234 could be either."),
        _number("frame_rate", "Frame rate", "240", to="read",
                says="Frames per second of a video, where a table counts frames: 240."),
        _number("scale", "Scale", "0.5 mm", unit="m", to="read",
                says="Length of a pixel, where a table has pixels, such as 0.5mm."),
    ),
}
# fmt: on

OPTIONS: tuple[Option, ...] = tuple(
    replace(option, panel=panel) for panel, group in _TABLE.items() for option in group
)
"""All options; the command line lists them in this order."""


def options_for(*to: str) -> dict[str, Option]:
    """Return the options of the reader, of the analyses or of numbers, by their names."""
    return {option.name: option for option in OPTIONS if option.to in to}


def taken_by(option: Option) -> list[str]:
    """Return the kinds whose analysis takes an option; the reader's are for every file."""
    kinds = {**KINDS, **{kind.name: kind for kind in TYPED}}
    return [name for name, kind in kinds.items() if option.name in kind.options]
