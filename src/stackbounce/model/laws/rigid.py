"""A contact that takes no time."""

from dataclasses import dataclass
from typing import Annotated

from stackbounce.errors import fraction
from stackbounce.units import Unit

__all__ = ["Rigid"]


@dataclass(frozen=True)
class Rigid:
    """An instantaneous collision with Newton's restitution.

    The two part at the restitution times the speed at which they met,
    ``v_upper' - v_lower' = -e (v_upper - v_lower)``, and momentum is conserved; at the floor
    ``v' = -e v``.

    Parameters
    ----------
    restitution : float
        The ratio e of the relative speeds after and before, from 0 to 1.

    Raises
    ------
    InvalidValue
        If `restitution` lies outside 0 to 1.
    InvalidType
        If it is no number.

    Notes
    -----
    Source: R. Cross, Am. J. Phys. 75, 1009 (2007), eqs 1 to 4.

    Examples
    --------
    >>> Rigid(0.9)
    Rigid(restitution=0.9)
    """

    restitution: Annotated[float, Unit()]

    def __post_init__(self) -> None:
        object.__setattr__(self, "restitution", fraction("restitution", self.restitution))
