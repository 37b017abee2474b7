"""Choices of the analysis: each changes the inputs of every model, and nothing else."""

from dataclasses import replace
from typing import Any, NamedTuple

from stackbounce.cross2007 import PAPER
from stackbounce.fitting import FitProblem
from stackbounce.model import STANDARD_GRAVITY
from studies.table2 import inputs
from studies.table2.catalogue import AS_HEIGHTS, NAMES, THEORIES
from studies.table2.readings import READINGS
from studies.table2.theories import Theory, make_rigid_model

_LOOSE = 1e-3  # s: the least error of a delay, if delays are known less well
_ROLLING = "B1_on_B1"
_HEIGHT = (inputs.HEIGHT, 1e-2)  # m: "about 20 cm" (Sec. IV)


class Choice(NamedTuple):
    """One way to analyse the same paper; the defaults are those of the base.

    `late` takes the delay of 7 ms for B1 on B3 instead of 2 ms. `loose` gives each delay an error
    of at least 1 ms. `rolling` keeps the two balls B1, which rolled on each other. `gravity` acts
    during the impact. `table_errors` fits Table I's restitutions and contact times within their
    errors, `height_error` the drop height within 1 cm. `reading` is a key of `READINGS`, for all
    models that take restitutions from Table I; None leaves each model its own.

    Examples
    --------
    >>> LATE.data()["B1_on_B3"]["first_touch.1"]
    (0.007, 0.0005)
    >>> sorted(set(BASE.data()) - set(ALL_LATE.data()))
    ['B1_on_B1']
    """

    name: str
    late: bool = False
    loose: bool = False
    rolling: bool = True
    gravity: bool = False
    table_errors: bool = False
    height_error: bool = False
    reading: str | None = None

    def data(self) -> dict[str, dict[str, Any]]:
        """Return the measurements of each pair, as `stackbounce.fit` takes them."""
        found = {}
        for key, own in (inputs.delay_late() if self.late else inputs.MEASURED).items():
            value, error = own[inputs.DELAY]
            delay = (value, max(error, _LOOSE) if self.loose else error)
            if self.rolling or key != _ROLLING:
                found[key] = {**own, inputs.DELAY: delay}
        return found

    def theory(self, theory: Theory) -> Theory:
        """Return a theory with the changed inputs."""
        if self.reading is not None:
            read = READINGS[self.reading]
            known = {name: read.get(name, value) for name, value in theory.known.items()}
            theory = replace(theory, known=known)
        errors = known_errors(theory) if self.table_errors else {}
        return replace(theory, priors={**errors, **self._falls()}, gravity=self._gravity())

    def model(self, name: str) -> FitProblem:
        """Return a model of the catalogue with the changed inputs."""
        pairs = tuple(self.data())
        if name in NAMES:
            return make_rigid_model(
                *NAMES[name], pairs=pairs, priors=self._falls(), gravity=self._gravity()
            )
        return self.theory(THEORIES[name]).model(pairs)

    def same(self, other: "Choice", name: str) -> bool:
        """Return whether a model has the same inputs with another choice."""
        if self.data() != other.data():
            return False
        if name in NAMES:
            return (self._falls(), self.gravity) == (other._falls(), other.gravity)
        return self.theory(THEORIES[name]) == other.theory(THEORIES[name])

    def _falls(self) -> dict[str, tuple[float, float]]:
        return {"height": _HEIGHT} if self.height_error else {}

    def _gravity(self) -> float:
        return STANDARD_GRAVITY if self.gravity else 0.0


def known_errors(theory: Theory) -> dict[str, tuple[float, float]]:
    """Return what a theory takes from Table I, with its errors: restitutions and contact times.

    Examples
    --------
    >>> errors = known_errors(THEORIES["S"])
    >>> [round(number, 3) for number in errors["e_B1"]], errors["longer_B1"]
    ([0.883, 0.011], (0.0, 0.0001))
    """
    found = {}
    usual = {"e_B3": theory.known["e_B2"]} if "e_B2" in theory.known else {}
    for name, value in {**usual, **theory.known}.items():
        if name in AS_HEIGHTS:
            spread = PAPER["B1.restitution"].spread
            is_root = value == AS_HEIGHTS[name]
            found[name] = (value, 0.5 * spread / value if is_root else spread)
    for ball in inputs.PRINTED:
        found[f"longer_{ball}"] = (0.0, PAPER[f"{ball}.contact_time"].spread)
    return found


BASE = Choice("base: B1 on B3 at 2 ms")
LATE = Choice("B1 on B3 at 7 ms", late=True)
FALLING = Choice("with gravity", gravity=True)
FALLING_LATE = Choice("with gravity, 7 ms", late=True, gravity=True)
ALL_EARLY = Choice(
    "all at once, 2 ms",
    loose=True,
    rolling=False,
    gravity=True,
    table_errors=True,
    height_error=True,
)
ALL_LATE = ALL_EARLY._replace(name="all at once, 7 ms", late=True)

CHOICES: tuple[Choice, ...] = (
    BASE,
    LATE,
    Choice("without the rolling pair", rolling=False),
    FALLING,
    FALLING_LATE,
    FALLING._replace(name="with gravity, without the rolling pair", rolling=False),
    Choice("Table I ± its errors", table_errors=True),
    Choice("drop height ± 1 cm", height_error=True),
    Choice("delays ± 1 ms", loose=True),
    *(Choice(f"Table I: {name}", reading=name) for name in READINGS),
    ALL_EARLY,
    ALL_LATE,
)
"""The columns of the table: the base, each choice alone, gravity with the two that decide most, and
the careful ones together."""
