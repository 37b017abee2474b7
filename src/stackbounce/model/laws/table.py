"""All contact laws, by name."""

from typing import TypeAlias

from stackbounce.errors import InvalidValue, nearest, shown
from stackbounce.model.laws.elastic import Hertz, PowerLaw, Spring
from stackbounce.model.laws.hysteretic import Hysteretic
from stackbounce.model.laws.lossy import Dashpot, HuntCrossley, Viscoelastic
from stackbounce.model.laws.rigid import Rigid

__all__ = ["FORMULAS", "LAWS", "ContactLaw", "law_named"]

ContactLaw: TypeAlias = (
    Rigid | Spring | Hertz | PowerLaw | Dashpot | Viscoelastic | HuntCrossley | Hysteretic
)
LAWS: dict[str, type[ContactLaw]] = {
    law.__name__: law
    for law in (Rigid, Spring, Hertz, PowerLaw, Dashpot, Viscoelastic, HuntCrossley, Hysteretic)
}

FORMULAS: dict[type[ContactLaw], str] = {
    Rigid: "v' = -restitution v",
    Spring: "F = stiffness c",
    Hertz: "F = stiffness c**1.5",
    PowerLaw: "F = stiffness c**exponent",
    Dashpot: "F = max(0, stiffness c + damping c')",
    Viscoelastic: "F = max(0, stiffness (c**1.5 + 1.5 dissipative_time c**0.5 c'))",
    HuntCrossley: "F = max(0, stiffness c**exponent (1 + dissipation c'))",
    Hysteretic: "F = stiffness c**exponent; from the peak C on, "
    "F = stiffness C**exponent (c/C)**unloading_exponent",
}
"""The force of each law at a compression c with the rate c', as plain text."""

_JOINED = str.maketrans("", "", "-_")


def law_named(name: object) -> type[ContactLaw]:
    """Return the law of a name, such as ``"Spring"`` or ``"hunt-crossley"``.

    Parameters
    ----------
    name : str
        A key of `LAWS`; case, hyphens and underscores do not matter.

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
    word = name.casefold().translate(_JOINED) if isinstance(name, str) else ""
    for known, law in LAWS.items():
        if word == known.casefold():
            return law
    raise InvalidValue(f"law must be a contact law, got {shown(name)}; {nearest(name, LAWS)}")
