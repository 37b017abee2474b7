"""The options of a measurement, defined once for all user interfaces.

They are listed in ``options.toml``. `OPTIONS` feeds the command line, the page's form, and the
table in `docs/measure.md`. An option is in effect for the kinds that name it in their `options`.
"""

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Literal, TypeAlias

from stackbounce.errors import finite, fraction, non_negative, positive
from stackbounce.files import shipped_table
from stackbounce.measure.kinds import KINDS
from stackbounce.model.laws import LAWS
from stackbounce.units import examples

Form: TypeAlias = Literal[
    "number", "measured", "lengths", "flag", "points", "law", "columns", "text"
]
_PANELS = {
    "ball": "What is known of the ball",
    "start": "",
    "drop": "What is known of the drop",
    "file": "What the file does not state",
}
_CHECKS = {check.__name__: check for check in (finite, fraction, non_negative, positive)}


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
        several lengths, a flag, points of the ball, a contact law, columns, a text.
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
    choices : iterable of str, optional
        What there is to choose from.
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
    choices: Iterable[str] | None = None
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
        return self.metavar or self.name.upper()


def _listed(names: Iterable[str]) -> str:
    """Return names as they are typed on the command line."""
    return ", ".join(f"'{name}'" if " " in name else name for name in names)


def _typed(law: str) -> str:
    """Return a law's name as it is typed: ``hunt-crossley``."""
    return re.sub(r"(?<=[a-z])(?=[A-Z])", "-", law).lower()


def _read_options() -> Iterator[Option]:
    """Yield the options, those of each panel together."""
    groups = shipped_table(__package__, "options.toml")
    laws, kinds = _listed(map(_typed, LAWS)), _listed(KINDS)
    for group, options in groups.items():
        for name, option in options.items():
            option["says"] = option["says"].format(laws=laws, kinds=kinds)
            choices = option.pop("choices", None)
            option["choices"] = {"{laws}": LAWS, "{kinds}": KINDS}.get(str(choices), choices)
            check = _CHECKS[option.pop("check", "positive")]
            yield Option(name, **option, panel=_PANELS[group], check=check)


OPTIONS: tuple[Option, ...] = tuple(_read_options())
"""All options; the command line lists them in this order."""


def options_for(*to: str) -> dict[str, Option]:
    """Return the options of the reader, of the analyses or of numbers, by their names."""
    return {option.name: option for option in OPTIONS if option.to in to}
