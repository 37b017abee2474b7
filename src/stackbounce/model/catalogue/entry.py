"""An entry of the catalogue: a ball, its bounce on a hard floor, and the sources of its figures."""

from dataclasses import asdict, dataclass, fields
from typing import Annotated, Any

from stackbounce.model.ball import Ball
from stackbounce.model.laws import ContactLaw, Hysteretic, Spring
from stackbounce.units import Unit

MEASURED, RULE, ESTIMATE = KINDS = ("measured", "rule", "estimate")
"""What a figure is: measured, set by the rules of a game, or estimated."""


@dataclass(frozen=True)
class CatalogueBall:
    """A ball of the catalogue with its numbers, and their sources.

    Parameters
    ----------
    ball : Ball
        With its mass, diameter and name.
    restitution : float
        The coefficient of restitution on a hard floor.
    stiffness : float
        The dynamic stiffness in N/m of its bounce on a hard floor.
    static_stiffness : float, optional
        The stiffness in N/m of the whole ball, pressed slowly between two plates.
    contact_time : float, optional
        The contact time on a hard floor, in s.
    sources : tuple of (str, str)
        The name and the source of each of these numbers.
    kinds : tuple of (str, str), optional
        The name of each number that is a ``"rule"``, the middle or the limit of what the rules of a
        game allow, or an ``"estimate"``. All others were measured, or follow from a measurement.
    lossy : bool, optional
        Whether its contacts lose energy as the restitution says.

    Examples
    --------
    >>> from stackbounce.model.catalogue import catalogue_ball
    >>> catalogue_ball("B1").stiffness
    54000.0
    """

    ball: Ball
    restitution: float
    stiffness: Annotated[float, Unit("N/m")]
    static_stiffness: Annotated[float, Unit("N/m")] | None
    contact_time: Annotated[float, Unit("s")] | None
    sources: tuple[tuple[str, str], ...]
    kinds: tuple[tuple[str, str], ...] = ()
    lossy: bool = False

    @property
    def contact(self) -> ContactLaw:
        """The contact law of the ball on a hard floor.

        Examples
        --------
        >>> from stackbounce.model.catalogue import catalogue_ball
        >>> catalogue_ball("B1").contact
        Spring(stiffness=54000.0)
        """
        if self.lossy:
            return Hysteretic(self.stiffness, restitution=self.restitution)
        return Spring(self.stiffness)

    def kind_of(self, figure: str) -> str:
        """Return whether a number is measured, a rule's or an estimate.

        Examples
        --------
        >>> from stackbounce.model.catalogue import catalogue_ball
        >>> catalogue_ball("football").kind_of("mass")
        'rule'
        """
        return dict(self.kinds).get(figure, MEASURED)

    def to_mapping(self) -> dict[str, Any]:
        """Return all numbers of the entry, including the fields of its `Ball`, as a flat dict.

        Examples
        --------
        >>> from stackbounce.model.catalogue import catalogue_ball
        >>> catalogue_ball("B1").to_mapping()["mass"]
        0.101
        """
        figures = {field.name: getattr(self, field.name) for field in fields(self)}
        listed = {"sources": dict(self.sources), "kinds": dict(self.kinds)}
        return asdict(figures.pop("ball")) | figures | listed
