"""A model to be fitted: drops, what varies in them, what follows."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from stackbounce.model import Drop

__all__ = ["Model"]


@dataclass(frozen=True)
class Model:
    """What `compare` fits: a drop or several, what varies in them, what follows.

    Parameters
    ----------
    drop : Drop, or mapping of str to Drop
        With all that is known, and the contact laws of the model.
    vary, tie : optional
        As `fit` takes them.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(1.0)], [sb.Rigid(0.8)], height=1.0)
    >>> Model(drop, ["contacts.0.restitution"]).tie
    """

    drop: Drop | Mapping[str, Drop]
    vary: Any
    tie: Any = None
