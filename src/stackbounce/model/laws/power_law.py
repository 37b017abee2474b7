"""A power law without loss."""

from dataclasses import dataclass
from typing import Annotated

from stackbounce.model.laws.elastic import ElasticLaw
from stackbounce.model.laws.law import EXPONENT, stiffness_in
from stackbounce.model.laws.registry import register


@register
@dataclass(frozen=True)
class PowerLaw(ElasticLaw):
    """A spring without loss whose force grows as a power of the compression.

    ``F = k c**p`` while the compression c is above 0, else 0. The contact ends when force and
    compression are back at zero; it stores ``k c**(p + 1)/(p + 1)``.

    Parameters
    ----------
    stiffness : float
        k, in N/m**exponent, above 0.
    exponent : float
        p, from 1, a linear spring, to 1e6.

    Raises
    ------
    InvalidValue
        If `stiffness` is not positive and finite, or `exponent` is out of its range.
    InvalidType
        If one of them is no number.

    Notes
    -----
    Source: P. Patricio, "The Hertz contact in chain elastic collisions", Am. J. Phys. 72, 1488
    (2004).

    Examples
    --------
    >>> PowerLaw(1e7, exponent=1.3)
    PowerLaw(stiffness=10000000.0, exponent=1.3)
    """

    formula = "F = stiffness c**exponent"
    source = (
        'P. Patricio, "The Hertz contact in chain elastic collisions", Am. J. Phys. 72, 1488 (2004)'
    )

    stiffness: Annotated[float, stiffness_in("N/m**exponent")]
    exponent: Annotated[float, EXPONENT]
