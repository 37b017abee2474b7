"""A linear spring."""

from dataclasses import dataclass
from typing import Annotated, ClassVar

from stackbounce.model.laws.elastic import ElasticLaw
from stackbounce.model.laws.law import stiffness_in
from stackbounce.model.laws.registry import register


@register
@dataclass(frozen=True)
class Spring(ElasticLaw):
    """A linear spring without loss that can be compressed and cannot pull.

    ``F = k c`` while the compression c is above 0, else 0. The contact ends when force and
    compression are back at zero.

    Parameters
    ----------
    stiffness : float
        k, in N/m, above 0.

    Raises
    ------
    InvalidValue
        If `stiffness` is not positive and finite.
    InvalidType
        If it is no number.

    Notes
    -----
    Source: R. Cross, Am. J. Phys. 75, 1009 (2007), eqs 5 and 6.

    Examples
    --------
    >>> Spring(2500)
    Spring(stiffness=2500.0)
    """

    formula = "F = stiffness c"
    source = "R. Cross, Am. J. Phys. 75, 1009 (2007), eqs 5 and 6"
    exact = True
    usual_models: ClassVar = {"Spring": {}}

    exponent: ClassVar[float] = 1.0
    stiffness: Annotated[float, stiffness_in("N/m")]
