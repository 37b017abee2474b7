"""The registry of contact laws: each class adds itself by the decorator `register`."""

from dataclasses import dataclass, field
from typing import TypeVar, dataclass_transform

from stackbounce.errors import InvalidValue, nearest, shown
from stackbounce.model.laws.law import ContactLaw

_Law = TypeVar("_Law", bound=ContactLaw)

LAWS: dict[str, type[ContactLaw]] = {}
"""The classes of all laws by their names, in the order of tables and menus."""

UNLISTED: dict[str, type[ContactLaw]] = {}
"""The classes of laws that files and programs give, and menus do not: tables, and bonds."""


def usual_laws() -> list[str]:
    """Return the names of the laws that `standard_models` compares."""
    return [name for name, law in LAWS.items() if law.rigid or law.usual_models]


_JOINED = str.maketrans("", "", "-_")


@dataclass_transform(frozen_default=True, field_specifiers=(field,))
def register(law: type[_Law]) -> type[_Law]:
    """Let all of stackbounce know a contact law of your own; used as a decorator.

    The class may stand in a file or in a cell of a notebook, which may be run again. It becomes a
    frozen dataclass, if it is none, and is added to `LAWS`, or to `UNLISTED` if it is not `listed`.
    Its `form` is one of the forms of force that the engine has, see `stackbounce.engine.codes`:

    ================= ================================================== ====================
    form              force at the compression c and its rate c'         `third_number`, z
    ================= ================================================== ====================
    ``POWER``         stiffness c**exponent                              none
    ``HYSTERETIC``    the same, with the exponent z on the way back      unloading exponent
    ``HUNT_CROSSLEY`` max(0, stiffness c**exponent (1 + z c'))           dissipation
    ``DASHPOT``       max(0, stiffness c + z c')                         damping
    ``VISCOELASTIC``  max(0, stiffness (c**1.5 + 1.5 z c**0.5 c'))       dissipative time
    ``RELAXING``      max(0, stiffness (c + z (c - u))), u' = (c - u)/w  relaxation strength
    ================= ================================================== ====================

    A law whose parameters are other ones than these numbers returns them by `engine_numbers`.

    Parameters
    ----------
    law : type
        A subclass of `ContactLaw`. Each parameter has a unit, in the annotation. `loss` names the
        parameter that takes energy, and `loss_depends_on` says of what else the loss depends.

    Returns
    -------
    type
        The class.

    Raises
    ------
    TypeError
        If the class lacks `formula`, `source` or `form`, or another law has its name.

    Examples
    --------
    >>> from typing import Annotated
    >>> import stackbounce as sb
    >>> @sb.laws.register
    ... class FoamCone(sb.laws.ContactLaw):
    ...     "A cone of foam that is pressed on a flat floor."
    ...
    ...     formula = "F = max(0, stiffness c**2 (1 + dissipation c'))"
    ...     source = "of my own"
    ...     form = sb.laws.codes.HUNT_CROSSLEY
    ...     exponent = 2.0
    ...     third_number = loss = "dissipation"
    ...     loss_depends_on = ("impact_speed",)
    ...     stiffness: Annotated[float, sb.laws.stiffness_in("N/m**2")]
    ...     dissipation: Annotated[float, sb.laws.Quantity("s/m")]
    >>> drop = sb.Drop([sb.Ball(0.05)], [FoamCone(1e6, dissipation=0.1)], impact_speed=3.0)
    >>> sb.simulate(drop).rebound_ratios.round(3)
    array([0.833])
    >>> del sb.laws.LAWS["FoamCone"]  # in a notebook it would stay
    """
    missing = [name for name in ("formula", "source", "form") if not hasattr(law, name)]
    if missing:
        raise TypeError(f"{law.__name__} must set {', '.join(missing)}")
    if "__dataclass_fields__" not in vars(law):
        law = dataclass(frozen=True, repr=False)(law)
    other = (LAWS | UNLISTED).get(law.__name__, law)
    if (other.__module__, other.__qualname__) != (law.__module__, law.__qualname__):
        raise TypeError(f"{law.__name__} is the name of a law in {other.__module__} already")
    law.says = (law.__doc__ or "").partition("\n")[0]
    (LAWS if law.listed else UNLISTED)[law.__name__] = law
    return law


def law_named(name: object) -> type[ContactLaw]:
    """Return the law of a name, such as ``"Spring"`` or ``"hunt-crossley"``, or a class as it is.

    Parameters
    ----------
    name : str or type
        A key of `LAWS` or `UNLISTED`; case, hyphens and underscores do not matter.

    Returns
    -------
    type
        The law's class.

    Raises
    ------
    InvalidValue
        If no law has this name; the message suggests the nearest and lists all.

    Examples
    --------
    >>> law_named("spring").__name__, law_named("hunt-crossley").__name__
    ('Spring', 'HuntCrossley')
    """
    if isinstance(name, type) and issubclass(name, ContactLaw):
        return name
    word = name.casefold().translate(_JOINED) if isinstance(name, str) else ""
    for known, law in (LAWS | UNLISTED).items():
        if word == known.casefold():
            return law
    raise InvalidValue(f"law must be a contact law, got {shown(name)}; {nearest(name, LAWS)}")
