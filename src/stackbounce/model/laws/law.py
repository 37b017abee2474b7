"""What the rest of the package asks of a contact law, with the usual answers."""

import functools
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from types import MappingProxyType
from typing import (
    TYPE_CHECKING,
    Any,
    ClassVar,
    Literal,
    NamedTuple,
    Self,
    TypeAlias,
    get_type_hints,
)

from stackbounce.engine import codes
from stackbounce.errors import InvalidValue, between, positive
from stackbounce.model.collision import elastic
from stackbounce.units import Unit, unit_of

__all__ = [
    "EXPONENT",
    "STEEPEST",
    "ContactLaw",
    "Flank",
    "Flanks",
    "Given",
    "Quantity",
    "contact_numbers",
    "form_code",
    "stiffness_in",
]

STEEPEST = 1e6
"""The largest exponent of a loading or unloading curve; beyond it a curve is a step."""

Given: TypeAlias = Mapping[str, float]
"""What was measured of a collision, by the names of the arguments of `calibrate`."""

_NOTHING: Mapping[str, Any] = MappingProxyType({})


@dataclass(frozen=True)
class Quantity(Unit):
    """The unit of a law's number, how the number is checked, and its slider on the page.

    Parameters
    ----------
    symbol : str
        The SI unit, as of `Unit`.
    check : callable
        From the name and the value to the value as a float; raises if it is out of range.
    slider : tuple of float
        The value that the page begins with, and the ends of its range.
    """

    check: Callable[[str, object], float] = positive
    slider: tuple[float, float, float] = (1.0, 0.0, 1.0)


def stiffness_in(unit: str) -> Quantity:
    """Return the description of a stiffness in N/m, or in N/m to another exponent."""
    slider = (5e3, 1e2, 1e6) if unit == "N/m" else (2e5, 1e3, 1e10)
    return Quantity(unit, lambda name, value: positive(name, value, unit), slider)


EXPONENT = Quantity("", lambda name, value: between(name, value, 1.0, STEEPEST), (1.5, 1.0, 4.0))
"""The description of the exponent of a loading curve."""


class Flank(NamedTuple):
    """What the rise or the fall of a contact's force over time can be.

    `kind` is a lead of `stackbounce.measure.kinds.waveform.shapes`; its unknown lies between
    `least` and `most`. `exact` tells that the law leaves little else: a power law without a loss
    by the rate.
    """

    least: float
    most: float
    kind: Literal["power", "jump", "root", "fade"] = "power"
    exact: bool = False


Flanks: TypeAlias = tuple[Flank, Flank]
"""Touch and release."""


class ContactLaw:
    """The base of all contact laws: a law answers here whatever the package asks of it.

    A law is a frozen dataclass whose numbers are annotated with a `Quantity`. It sets `says`,
    `formula`, `source` and `form`, overrides what differs from the answers below, and registers
    itself by `stackbounce.model.laws.registry.register`.
    """

    says: ClassVar[str]
    """What the law is, in one line for people."""
    formula: ClassVar[str]
    """The force at a compression c with the rate c', as plain text."""
    source: ClassVar[str]
    """Where it was published."""
    form: ClassVar[str]
    """The name of the form of the force, see `stackbounce.engine.forces`."""
    law_parameter: ClassVar[str] = ""
    """The field that is the last of the engine's numbers of a contact."""
    rigid: ClassVar[bool] = False
    """Whether a collision takes no time."""
    exact: ClassVar[bool] = False
    """Whether the motion is solved in closed form, so that a run is fast."""
    rate_free: ClassVar[bool] = False
    """Whether the force depends on the compression and its history alone, not on its rate."""
    loss: ClassVar[str] = ""
    """The field that tells the loss of energy; empty for a law without loss."""
    loss_depends_on: ClassVar[tuple[str, ...]] = ()
    """What the restitution depends on besides the law: ``mass``, ``speed`` or both."""
    usual_exponent: ClassVar[float | None] = None
    """The exponent that `calibrate` takes by default where the law leaves it open."""
    usual_models: ClassVar[Mapping[str, Mapping[str, float]]] = {}
    """The models of this law in `standard_models`: name -> what else `calibrate` is given."""

    if TYPE_CHECKING:  # fields differ from law to law

        def __getattr__(self, name: str) -> Any: ...

    def __post_init__(self) -> None:
        for name, number in self.quantities().items():
            object.__setattr__(self, name, number.check(name, getattr(self, name)))

    # its numbers

    @classmethod
    def quantities(cls) -> Mapping[str, Quantity]:
        """Return the law's numbers by the names of their fields."""
        kind: Any = cls
        return _quantities(kind)

    @classmethod
    def fixed_exponent(cls) -> float | None:
        """Return the exponent of the loading curve if it is the same for all laws of the class."""
        own = None if "exponent" in cls.quantities() else getattr(cls, "exponent", None)
        return None if own is None else float(own)

    @classmethod
    def default_exponent(cls) -> float | None:
        """Return the exponent of the loading curve unless another one is given."""
        fixed = cls.fixed_exponent()
        return cls.usual_exponent if fixed is None else fixed

    def units(self) -> dict[str, str]:
        """Return the SI units of the law's numbers, with the value of the exponent in them."""
        exponent = getattr(self, "exponent", 1.0)
        power = "" if exponent == 1.0 else f"**{exponent:g}"
        found = self.quantities().items()
        return {name: one.symbol.replace("**exponent", power) for name, one in found}

    def derived_field(self) -> str:
        """Return the field that follows from another one; empty for most laws."""
        return ""

    def replaced(self, changes: Mapping[str, Any]) -> Self:
        """Return the law with other numbers; a field that follows from a changed one follows."""
        law: Any = self
        return replace(law, **changes)  # type: ignore[no-any-return]

    def to_mapping(self) -> dict[str, Any]:
        """Return the law as plain values, with its name as ``law``, as scenario files have it."""
        law: Any = self
        given = {one.name: getattr(self, one.name) for one in fields(law) if one.init}
        return {"law": type(self).__name__} | given

    def described(self) -> str:
        """Return the law in words: its name and its numbers.

        Examples
        --------
        >>> from stackbounce.model import HuntCrossley
        >>> HuntCrossley(3e6, 1.5, dissipation=0.15).described()
        'HuntCrossley, stiffness 3e+06 N/m^1.5, exponent 1.5, dissipation 0.15 s/m'
        """
        words = [type(self).__name__]
        for name in self._described_fields():
            digits = ".4g" if name == "restitution" else ".6g"
            unit = self.units()[name].replace("**", "^")
            words.append(f"{name.replace('_', ' ')} {getattr(self, name):{digits}} {unit}".strip())
        return ", ".join(words)

    def _described_fields(self) -> list[str]:
        return list(self.quantities())

    # what the engine is given

    def engine_numbers(self, varied: Mapping[str, Any] = _NOTHING) -> tuple[int, Any, Any, Any]:
        """Return what the engine knows of a contact: form, stiffness, exponent and one more number.

        Parameters
        ----------
        varied : mapping of str to ndarray, optional
            Fields that have other values, one for each of many drops.
        """
        known = {"stiffness": 1.0, "exponent": 1.0, "": 0.0}
        numbers = [
            varied.get(name, getattr(self, name, known.get(name)))
            for name in ("stiffness", "exponent", self.law_parameter)
        ]
        return form_code(self.form), numbers[0], numbers[1], numbers[2]

    # one collision

    @property
    def contact_time_depends_on(self) -> tuple[str, ...]:
        """What the contact time depends on besides the law: ``mass``, ``speed`` or both."""
        return ("mass", "speed") if self._needs_speed(self.exponent) else ("mass",)

    def restitution_at(self, mass: float, speed: float) -> float:
        """Return the restitution of a mass in kg at a speed in m/s; by a run unless overridden."""
        from stackbounce.engine.one_ball import bounce

        return bounce(self.engine_numbers(), mass, speed)[0]

    def contact_time_at(self, mass: float, speed: float) -> float:
        """Return the contact time in s of a mass in kg at a speed in m/s."""
        unit = elastic.peak_compression(self.stiffness, self.exponent, mass, speed) / speed
        return unit * self.duration_at(mass, speed)

    def duration_at(self, mass: float, speed: float) -> float:
        """Return the contact time in units of C/v, see `elastic`; by a run unless overridden."""
        from stackbounce.engine.one_ball import bounce

        time = bounce(self.engine_numbers(), mass, speed)[1]
        return time / elastic.peak_compression(self.stiffness, self.exponent, mass, speed) * speed

    @classmethod
    def calibration_needs(cls, exponent: float | None = None) -> list[str]:
        """Return what `calibrate` must be given, by the names of its arguments."""
        usual = cls.default_exponent()
        p = usual if exponent is None else exponent
        loss = ["restitution"] if cls.loss else []
        shape = ["exponent"] if usual is None else []
        speed = ["impact_speed"] if cls._needs_speed(1.0 if p is None else p) else []
        return ["mass", "contact_time", *loss, *shape, *speed]

    @classmethod
    def _needs_speed(cls, exponent: float) -> bool:
        return "speed" in cls.loss_depends_on or exponent != 1.0

    @classmethod
    def calibrated(cls, given: Given) -> Self:
        """Return the law that has what was measured; all that is needed is given.

        Raises
        ------
        ArithmeticError
            If a number is out of range.
        InvalidValue
            If the law cannot be calibrated.
        """
        raise InvalidValue(f"law_class must be a law that can be calibrated, got {cls.__name__}")

    @property
    def linger(self) -> float:
        """For how many s balls that fly apart at a steady rate stay compressed without a force."""
        return 0.0

    # force records

    @classmethod
    def flanks(cls, exponent: float | None, law: "ContactLaw | None" = None) -> Flanks | None:
        """Return what touch and release of a force record can be; None if nothing is known.

        Parameters
        ----------
        exponent : float or None
            Of the loading curve, if it is known.
        law : ContactLaw, optional
            The law itself, if it is known.
        """
        return None

    # two contacts in series

    def series_constants(self) -> dict[str, Any]:
        """Return what two laws must have in common so that both in series are of their class."""
        return {"exponent": self.exponent}

    def series_changes(self, stiffness: float, share: float) -> dict[str, float]:
        """Return those numbers of two laws in series that differ from this one's.

        Parameters
        ----------
        stiffness : float
            Of both in series.
        share : float
            The part of the compression that this law takes.
        """
        return {"stiffness": stiffness}

    def as_hysteretic(self) -> "ContactLaw | None":
        """Return the law as a `Hysteretic` one with the same force; None where there is none."""
        return None


@functools.cache
def _quantities(kind: type[ContactLaw]) -> Mapping[str, Quantity]:
    hints = get_type_hints(kind, include_extras=True)
    found = {name: unit_of(hint) for name, hint in hints.items()}
    return {name: one for name, one in found.items() if isinstance(one, Quantity)}


def form_code(name: str) -> int:
    """Return the engine's code of a form of force."""
    from stackbounce.engine import forces

    return int(getattr(forces, name))


def contact_numbers(
    law: ContactLaw | None, varied: Mapping[str, Any] = _NOTHING
) -> tuple[int, Any, Any, Any]:
    """Return what the engine knows of a contact, see `ContactLaw.engine_numbers`; None: no floor.

    Examples
    --------
    >>> from stackbounce.model import Hertz
    >>> contact_numbers(Hertz(2e9)), contact_numbers(None)
    ((1, 2000000000.0, 1.5, 0.0), (0, 1.0, 1.0, 0.0))
    """
    return (codes.ABSENT, 1.0, 1.0, 0.0) if law is None else law.engine_numbers(varied)
