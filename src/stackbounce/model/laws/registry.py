"""The registry of contact laws: each class adds itself by the decorator `register`."""

from typing import TypeVar

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


def register(law: type[_Law]) -> type[_Law]:
    """Add a law's class to `LAWS`, or to `UNLISTED` if it is not `listed`; used as a decorator.

    Raises
    ------
    TypeError
        If the class lacks `formula`, `source` or `form`, or another law has its name.
    """
    missing = [name for name in ("formula", "source", "form") if not hasattr(law, name)]
    if missing:
        raise TypeError(f"{law.__name__} must set {', '.join(missing)}")
    other = (LAWS | UNLISTED).get(law.__name__, law)
    if (other.__module__, other.__qualname__) != (law.__module__, law.__qualname__):
        raise TypeError(f"{law.__name__} is the name of a law in {other.__module__} already")
    law.says = (law.__doc__ or "").partition("\n")[0]
    (LAWS if law.listed else UNLISTED)[law.__name__] = law
    return law


def law_named(name: object) -> type[ContactLaw]:
    """Return the law of a name, such as ``"Spring"`` or ``"hunt-crossley"``.

    Parameters
    ----------
    name : str
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
    word = name.casefold().translate(_JOINED) if isinstance(name, str) else ""
    for known, law in (LAWS | UNLISTED).items():
        if word == known.casefold():
            return law
    raise InvalidValue(f"law must be a contact law, got {shown(name)}; {nearest(name, LAWS)}")
