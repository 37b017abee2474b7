"""The base class of contact laws: the interface that the package uses, and its defaults."""

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from numbers import Real
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NamedTuple, Self, TypeVar

from stackbounce.engine import codes
from stackbounce.errors import InvalidValue, between, positive
from stackbounce.model.collision import elastic
from stackbounce.model.collision.roots import rising_root
from stackbounce.shown import Shown, Table, call_of
from stackbounce.units import WORDS, Unit, in_unit, units_of

STEEPEST = 1e6
"""The largest exponent of a loading or unloading curve; above it the curve is almost a step."""

Given = Mapping[str, float]
"""The measured quantities of a collision, by the names of the arguments of `calibrate`."""

EngineNumbers = tuple[int, Any, Any, Any, Any]
"""A contact as the engine takes it, see `stackbounce.engine.forces`."""

_MEASURED = ("mass", "impact_speed", "contact_time", "exponent")
_LOSSLESS = 1.0 - 1e-11  # a smaller loss is not told from round-off in a simulation
_FAR = 1e6  # times the largest one of its slider: the largest loss that a calibration tries
_LEAST = 1e-3  # times the same: where the search begins if the slider begins at 0
_NOTHING: Mapping[str, Any] = MappingProxyType({})


@dataclass(frozen=True)
class Quantity(Unit):
    """A parameter of a contact law: its unit, its validation, and its slider in the web explorer.

    Parameters
    ----------
    symbol : str
        The SI unit, as of `Unit`.
    check : callable
        A function of the name and the value that returns the value as a float, and raises if it is
        out of range.
    slider : tuple of float
        The initial value, the smallest and the largest value of the slider.
    """

    check: Callable[[str, object], float] = field(default=positive, repr=False)
    slider: tuple[float, float, float] = field(default=(1.0, 0.0, 1.0), repr=False)


def stiffness_in(unit: str) -> Quantity:
    """Return the `Quantity` of a stiffness.

    Parameters
    ----------
    unit : str
        ``N/m``, or such as ``N/m**1.5`` of a power law.

    Examples
    --------
    >>> stiffness_in("N/m**2").symbol
    'N/m**2'
    """
    return number_in(unit, positive, (5e3, 1e2, 1e6) if unit == "N/m" else (2e5, 1e3, 1e10))


def number_in(
    unit: str, check: Callable[..., float], slider: tuple[float, float, float]
) -> Quantity:
    """Return the `Quantity` of a number whose unit is in the messages of its check.

    Examples
    --------
    >>> number_in("s", positive, (1e-3, 1e-6, 1.0)).check("relaxation_time", -1.0)
    Traceback (most recent call last):
        ...
    stackbounce.errors.InvalidValue: relaxation_time must be a positive number of seconds, got -1.0
    """
    of = next((word for word, symbol in WORDS.items() if symbol == unit), unit)
    return Quantity(unit, lambda name, value: check(name, value, of), slider)


EXPONENT = Quantity("", lambda name, value: between(name, value, 1.0, STEEPEST), (1.5, 1.0, 4.0))
"""The `Quantity` of the exponent of a loading curve."""

RESTITUTION = Quantity("", lambda name, value: between(name, value, 1e-5, 1.0), (0.8, 0.05, 1.0))
"""The `Quantity` of the restitution of a curve of pieces.

Its unloading is too steep for the digits of a compression where it returns less.
"""


class Flank(NamedTuple):
    """The shape of a flank, the rise or the fall of the force with time, under a contact law.

    `kind` names the leading term, one of those in `stackbounce.measure.kinds.waveform.shapes`. Its
    free parameter, such as the exponent of a power, lies between `least` and `most`. `exact` is
    True if corrections to the leading term are small: for a power law without rate-dependent loss.
    """

    least: float
    most: float
    kind: Literal["power", "jump", "root", "fade"] = "power"
    exact: bool = False


_Law = TypeVar("_Law", bound="ContactLaw")


class ContactLaw(Shown):
    """The base class of all contact laws: the attributes and methods that the package uses.

    A law is decorated with `stackbounce.model.laws.registry.register`, which makes it a frozen
    dataclass; the hint of each parameter holds a `Quantity`. The class must set `formula`, `source`
    and `form`. It overrides the defaults that do not apply to it.
    """

    says: ClassVar[str]
    """A description of the law in one line, for users: the first line of its docstring."""
    formula: ClassVar[str]
    """The formula of the force in terms of the compression c and its rate c', as plain text."""
    source: ClassVar[str]
    """Where it was published."""
    form: ClassVar[int]
    """The code of the form of the force, see `stackbounce.engine.forces`."""
    third_number: ClassVar[str] = ""
    """The field that is the third of the engine's numbers, such as the damping."""
    fourth_number: ClassVar[str] = ""
    """The field that is the fourth one, such as a relaxation time."""
    listed: ClassVar[bool] = True
    """Whether menus and tables offer the law."""
    rigid: ClassVar[bool] = False
    """Whether collisions are instantaneous."""
    pulls: ClassVar[bool] = False
    """Whether the contact pulls as well and never opens, as inside a ball."""
    exact: ClassVar[bool] = False
    """Whether the motion is solved in closed form, so that a run is fast."""
    rate_free: ClassVar[bool] = False
    """Whether the force depends on the compression and its history alone, not on its rate."""
    loss: ClassVar[str] = ""
    """The field that describes the energy loss; empty for a lossless law."""
    loss_fields: ClassVar[tuple[str, ...]] = ()
    """The fields of which any one can set the energy loss, where there are more than `loss`."""
    derived: str = ""
    """The name of the field that is computed from another one; empty for most laws."""
    loss_depends_on: ClassVar[tuple[str, ...]] = ()
    """What the restitution depends on besides the law: ``mass``, ``impact_speed``."""
    least_restitution: ClassVar[float] = 0.0
    """The smallest restitution that `calibrate` can give the law if no more is known of it."""
    needs: ClassVar[tuple[str, ...] | None] = None
    """The arguments that `calibrate` needs, where they do not follow from loss and exponent."""
    usual_exponent: ClassVar[float | None] = None
    """The default exponent in `calibrate`, for a law with a free exponent."""
    usual_models: ClassVar[Mapping[str, Mapping[str, float]]] = {}
    """The models with this law in `standard_models`: name -> extra arguments of `calibrate`.

    Rigid laws are there in any case.
    """

    usual_flanks: ClassVar[tuple[Flank, Flank] | None] = None
    """The shapes of the flanks of a force record, at touch and release, if always these."""
    page_code: ClassVar[Mapping[str, str]] = {}
    """What the page cannot do by default, in JavaScript: ``numbers``, those of the engine after the
    form as `engine_numbers` gives them; ``others``, the fields that `calibrated` derives from what
    was measured and from stiffness and loss."""

    if TYPE_CHECKING:  # fields differ from law to law

        def __getattr__(self, name: str) -> Any: ...

    def __repr__(self) -> str:
        return call_of(self, self.derived)

    def __post_init__(self) -> None:
        for name, number in self.quantities().items():
            object.__setattr__(self, name, number.check(name, self.in_si(name)))

    def in_si(self, name: str) -> Any:
        """Return a parameter as it was given, but a float in SI units for one with a unit."""
        value = getattr(self, name)
        if type(value) is float or isinstance(value, Real):
            return value
        unit = self.quantities()[name].symbol
        if "**exponent" in unit:
            exponent = EXPONENT.check("exponent", self.in_si("exponent"))
            unit = unit.replace("**exponent", "" if exponent == 1.0 else f"**{exponent!r}")
        return in_unit(value, unit, name)

    # its numbers

    @classmethod
    def quantities(cls) -> Mapping[str, Quantity]:
        """Return the `Quantity` of each parameter of the law, by field."""
        kind: Any = cls
        return _quantities(kind)

    @classmethod
    def fixed_exponent(cls) -> float | None:
        """Return the exponent of the loading curve if the class fixes it; None if it is a field."""
        own = None if "exponent" in cls.quantities() else getattr(cls, "exponent", None)
        return None if own is None else float(own)

    @classmethod
    def default_exponent(cls) -> float | None:
        """Return the default exponent of the loading curve; None if there is none."""
        fixed = cls.fixed_exponent()
        return cls.usual_exponent if fixed is None else fixed

    def units(self) -> dict[str, str]:
        """Return the SI unit of each parameter, such as ``N/m**1.5`` for an exponent of 1.5."""
        exponent = getattr(self, "exponent", 1.0)
        power = "" if exponent == 1.0 else f"**{exponent:g}"
        found = self.quantities().items()
        return {name: one.symbol.replace("**exponent", power) for name, one in found}

    def replaced(self, changes: Mapping[str, Any]) -> Self:
        """Return a copy of the law with changed fields; a derived field is computed again."""
        return replace(self, **changes)  # type: ignore[type-var]

    def of_collision(self, number: int) -> Self:
        """Return the law for one of several runs, whose draws are independent of each other."""
        return self

    def to_mapping(self) -> dict[str, Any]:
        """Return the law as plain values, with its name as ``law``, as scenario files have it."""
        law: Any = self
        given = {field.name: getattr(self, field.name) for field in fields(law) if field.init}
        return {"law": type(self).__name__} | given

    def described(self) -> str:
        """Return a description of the law for users: its name, and its parameters with units.

        Examples
        --------
        >>> from stackbounce.model import HuntCrossley
        >>> HuntCrossley(3e6, 1.5, dissipation=0.15).described()
        'HuntCrossley, stiffness 3e+06 N/m^1.5, exponent 1.5, dissipation 0.15 s/m'
        """
        return ", ".join([type(self).__name__, *map(" ".join, self._described_numbers())])

    def _described_numbers(self) -> list[tuple[str, str]]:
        """Return the name of each number in words, and the number with its unit."""
        found = []
        for name in self._described_fields():
            digits = ".4g" if name == "restitution" else ".6g"
            unit = self.units()[name].replace("**", "^")
            found.append((name.replace("_", " "), f"{getattr(self, name):{digits}} {unit}".strip()))
        return found

    def _tables(self) -> Sequence[Table]:
        numbers = self._described_numbers()
        return (Table(type(self).__name__ if numbers else self.described(), ("", ""), numbers),)

    @property
    def remarks(self) -> Sequence[str]:
        """The formula of the law, for a notebook."""
        return (self.formula,)

    def _described_fields(self) -> list[str]:
        return list(self.quantities())

    # what the engine is given

    def engine_numbers(self, varied: Mapping[str, Any] = _NOTHING) -> EngineNumbers:
        """Return the engine's description of a contact.

        That is the form of its force and four numbers, whose meaning depends on the form. By
        default they are the stiffness, the exponent, and the fields `third_number` and
        `fourth_number`.

        Parameters
        ----------
        varied : mapping of str to ndarray, optional
            Fields that vary, with one value for each of many drops.
        """
        names = ("stiffness", "exponent", self.third_number, self.fourth_number)
        own = zip(names, (1.0, 1.0, 0.0, 0.0), strict=True)
        numbers = [varied.get(name, getattr(self, name, usual)) for name, usual in own]
        first, second, third, fourth = numbers
        return self.form, first, second, third, fourth

    def values(self, varied: Mapping[str, Any]) -> list[Any]:
        """Return the values of all parameters, of which some vary, see `engine_numbers`."""
        return [varied.get(name, getattr(self, name)) for name in self.quantities()]

    def pieces(self) -> list[float]:
        """Return the pieces of the curves of a law that is a table, see `engine.pieces`."""
        return []

    # one collision

    @property
    def contact_time_depends_on(self) -> tuple[str, ...]:
        """What the contact time depends on besides the law: ``mass``, ``impact_speed``."""
        return ("mass", "impact_speed") if self._needs_speed(self.exponent) else ("mass",)

    def restitution_at(self, mass: float, speed: float) -> float:
        """Return the restitution of a mass in kg at a speed in m/s.

        It is 1 without a loss, and a field of the law if it depends on nothing else; of any other
        law it is found by a simulation, by default.
        """
        if self._is_elastic():
            return 1.0
        if self.loss == "restitution" and not self.loss_depends_on:
            return float(self.restitution)
        return min(1.0, self._bounce(mass, speed)[0])  # it may be above 1 by round-off

    def contact_time_at(self, mass: float, speed: float) -> float:
        """Return the contact time in s of a mass in kg at a speed in m/s."""
        unit = elastic.peak_compression(self.stiffness, self.exponent, mass, speed) / speed
        return unit * self.duration_at(mass, speed)

    def duration_at(self, mass: float, speed: float) -> float:
        """Return the contact time in units of C/v, see `elastic`; with a loss from a simulation."""
        if self._is_elastic():
            return elastic.duration(self.exponent)
        time = self._bounce(mass, speed)[1]
        return time / elastic.peak_compression(self.stiffness, self.exponent, mass, speed) * speed

    def _is_elastic(self) -> bool:
        """Return whether nothing is lost, and the force is a power of the compression."""
        return not (self.loss and (self.loss == "restitution" or getattr(self, self.loss) > 0.0))

    def _bounce(self, mass: float, speed: float) -> tuple[float, float]:
        """Return restitution and contact time in s by a simulation."""
        from stackbounce.engine.one_ball import bounce

        return bounce(self.engine_numbers(), mass, speed, self.pieces())

    @classmethod
    def calibration_needs(cls, exponent: float | None = None) -> list[str]:
        """Return the names of the arguments that `calibrate` needs for this law."""
        if cls.needs is not None:
            return list(cls.needs)
        usual = cls.default_exponent()
        p = usual if exponent is None else exponent
        loss = ["restitution"] if cls.loss else []
        shape = ["exponent"] if usual is None else []
        speed = ["impact_speed"] if cls._needs_speed(1.0 if p is None else p) else []
        return ["mass", "contact_time", *loss, *shape, *speed]

    @classmethod
    def _needs_speed(cls, exponent: float) -> bool:
        return "impact_speed" in cls.loss_depends_on or exponent != 1.0

    @classmethod
    def calibrated(cls, given: Given) -> Self:
        """Return the law that reproduces measured quantities; ``given`` holds all that are needed.

        By default the stiffness is searched for that gives the contact time, and within that search
        the loss that gives the restitution, by simulations of the collision. Other fields are those
        of `assumed`, or have the value in `given`, their default, or the initial value of their
        slider.

        Raises
        ------
        ArithmeticError
            If a number is out of range.
        InvalidValue
            If the law cannot be calibrated.
        """
        numbers = {
            name: given.get(name, getattr(cls, name, number.slider[0]))
            for name, number in cls.quantities().items()
        }
        if "stiffness" not in numbers:
            raise InvalidValue(
                f"law_class must be a law that can be calibrated, got {cls.__name__}"
            )
        return _found(cls, numbers, given)

    @classmethod
    def assumed(cls, given: Given, numbers: Mapping[str, float]) -> dict[str, float]:
        """Return the fields that `calibrated` derives from what was measured and other fields."""
        return {}

    @property
    def linger(self) -> float:
        """The time in s between the end of the force and c = 0, if the balls separate steadily."""
        return 0.0

    # force records

    @classmethod
    def flanks(
        cls, exponent: float | None, law: "ContactLaw | None" = None
    ) -> tuple[Flank, Flank] | None:
        """Return the possible shapes of the flanks of a force record; None if nothing is known.

        Parameters
        ----------
        exponent : float or None
            The exponent of the loading curve, if it is known.
        law : ContactLaw, optional
            The law with its parameters, if they are known.
        """
        return cls.usual_flanks

    # two contacts in series

    def series_constants(self) -> dict[str, Any]:
        """Return what two laws in series must have in common, by name: all but the stiffness."""
        names = [name for name in self.quantities() if name != "stiffness"]
        return {name: getattr(self, name) for name in ("exponent", *names)}

    def series_changes(self, stiffness: float, share: float) -> dict[str, float]:
        """Return the fields of two laws in series that differ from those of this law.

        Parameters
        ----------
        stiffness : float
            The stiffness of both in series.
        share : float
            The fraction of the compression that this law takes.
        """
        return {"stiffness": stiffness}

    def as_hysteretic(self) -> "ContactLaw | None":
        """Return the `Hysteretic` law with the same force; None if there is none."""
        return None


@functools.cache
def _quantities(kind: Any) -> Mapping[str, Quantity]:
    return {name: one for name, one in units_of(kind).items() if isinstance(one, Quantity)}


def _found(cls: type[_Law], numbers: dict[str, float], given: Given) -> _Law:
    """Return the law with those numbers but for the stiffness and the loss, which are found."""
    mass, speed, lasts, p = (given[name] for name in _MEASURED)
    stiffness = elastic.measured_stiffness(given, elastic.duration(p))
    if not cls.loss:
        return cls(**numbers | {"stiffness": stiffness})

    def lasting(loss: dict[str, float]) -> _Law:
        """Return the law with a loss that has the contact time."""
        nonlocal stiffness

        def made(k: float) -> _Law:
            chosen = numbers | loss | {"stiffness": k}
            return cls(**chosen | cls.assumed(given, chosen))

        def short(k: float) -> float:  # linear in k for a power law
            return float((lasts / made(k).contact_time_at(mass, speed)) ** (p + 1.0)) - 1.0

        stiffness = rising_root(short, stiffness)  # near which the next one is
        return made(stiffness)

    if cls.loss == "restitution":
        return lasting({})
    kept = given["restitution"]
    if kept > _LOSSLESS:
        return lasting({cls.loss: 0.0})

    _, least, most = cls.quantities()[cls.loss].slider

    def excess(loss: float) -> float:
        if loss > _FAR * most:  # the run may not end
            raise ArithmeticError
        return math.log(kept / lasting({cls.loss: loss}).restitution_at(mass, speed))

    return lasting({cls.loss: rising_root(excess, least or _LEAST * most)})


def contact_numbers(law: ContactLaw | None, varied: Mapping[str, Any] = _NOTHING) -> EngineNumbers:
    """Return a contact as the engine takes it, see `ContactLaw.engine_numbers`; None is no floor.

    Examples
    --------
    >>> from stackbounce.model import Hertz
    >>> contact_numbers(Hertz(2e9)), contact_numbers(None)
    ((1, 2000000000.0, 1.5, 0.0, 0.0), (0, 1.0, 1.0, 0.0, 0.0))
    """
    return (codes.ABSENT, 1.0, 1.0, 0.0, 0.0) if law is None else law.engine_numbers(varied)
