"""All contact laws, by name."""

from typing import TypeAlias

from stackbounce.errors import InvalidValue, nearest, shown
from stackbounce.model.laws.elastic import Hertz, PowerLaw, Spring
from stackbounce.model.laws.hysteretic import Hysteretic
from stackbounce.model.laws.lossy import Dashpot, HuntCrossley, Viscoelastic
from stackbounce.model.laws.rigid import Rigid

__all__ = ["LAWS", "ContactLaw", "law_named"]

ContactLaw: TypeAlias = (
    Rigid | Spring | Hertz | PowerLaw | Dashpot | Viscoelastic | HuntCrossley | Hysteretic
)
LAWS: dict[str, type[ContactLaw]] = {
    law.__name__: law
    for law in (Rigid, Spring, Hertz, PowerLaw, Dashpot, Viscoelastic, HuntCrossley, Hysteretic)
}


def law_named(name: object) -> type[ContactLaw]:
    """Return the law of a name, such as ``"Spring"``; case does not matter.

    Parameters
    ----------
    name : str
        A key of `LAWS`.

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
    >>> law_named("spring").__name__
    'Spring'
    """
    for known, law in LAWS.items():
        if isinstance(name, str) and name.casefold() == known.casefold():
            return law
    raise InvalidValue(f"law must be a contact law, got {shown(name)}; {nearest(name, LAWS)}")
