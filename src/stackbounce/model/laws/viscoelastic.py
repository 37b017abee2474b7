"""The contact of viscoelastic spheres; runs of one ball give its restitution and its contact time.

Both have one dimensionless parameter. In units of ``L = (m v**2/k)**(2/5)`` and L/v the motion is
``x'' = -(x**1.5 + v*² sqrt(x) x')`` with ``v*² = 1.5 A (k/m)**(2/5) v**(1/5)``.

Source: P. Müller and T. Pöschel, Phys. Rev. E 84, 021302 (2011). As here, their contact ends when
the force is back at zero.
"""

from typing import Annotated, ClassVar

from stackbounce.engine import codes
from stackbounce.errors import non_negative
from stackbounce.model.laws.law import ContactLaw, Flank, number_in, stiffness_in
from stackbounce.model.laws.registry import register


@register
class Viscoelastic(ContactLaw):
    """The contact of two viscoelastic spheres, or of one and a flat floor.

    ``F = max(0, k (c**1.5 + 1.5 A sqrt(c) ċ))`` while the compression c is above 0, else 0. The
    contact ends when the force is back at zero, which is before the compression is. Until then,
    ``k c**2.5/2.5`` counts as stored energy.

    Parameters
    ----------
    stiffness : float
        k, in N/m**1.5, above 0, as of `Hertz`.
    dissipative_time : float
        A, in s, 0 or above: a constant of the material.

    Raises
    ------
    InvalidValue
        If `stiffness` is not positive and finite, or `dissipative_time` is negative or not finite.
    InvalidType
        If one of them is no number.

    Notes
    -----
    Source: G. Kuwabara and K. Kono, Jpn. J. Appl. Phys. 26, 1230 (1987); N. V. Brilliantov,
    F. Spahn, J.-M. Hertzsch and T. Pöschel, Phys. Rev. E 53, 5382 (1996). Valid where the speed is
    well below that of sound.

    Examples
    --------
    >>> Viscoelastic(3e6, dissipative_time=1e-4)
    Viscoelastic(stiffness=3000000.0, dissipative_time=0.0001)
    """

    formula = "F = max(0, stiffness (c**1.5 + 1.5 dissipative_time c**0.5 c'))"
    source = (
        "G. Kuwabara and K. Kono, Jpn. J. Appl. Phys. 26, 1230 (1987); N. V. Brilliantov, "
        "F. Spahn, J.-M. Hertzsch and T. Pöschel, Phys. Rev. E 53, 5382 (1996)"
    )
    form = codes.VISCOELASTIC
    third_number = "dissipative_time"
    loss = "dissipative_time"
    loss_depends_on = ("mass", "impact_speed")
    usual_flanks = Flank(0.01, 0.3, "root"), Flank(0.01, 0.3, "fade")
    usual_models: ClassVar = {"Viscoelastic": {}}

    exponent: ClassVar[float] = 1.5
    stiffness: Annotated[float, stiffness_in("N/m**1.5")]
    dissipative_time: Annotated[float, number_in("s", non_negative, (3e-4, 1e-6, 1e-2))]

    @property
    def linger(self) -> float:
        """The time in s for which c stays above 0 after the force ends at ``c = -1.5 A ċ``."""
        return 1.5 * self.dissipative_time
