"""The base of the lossless laws: the force is a power of the compression, loading and unloading."""

from typing import TYPE_CHECKING, Self

from stackbounce.model.collision import elastic
from stackbounce.model.laws.law import ContactLaw, Flank, Flanks, Given

if TYPE_CHECKING:
    from stackbounce.model.laws.hysteretic import Hysteretic

_STEEPEST_FLANK = 2.5  # the largest exponent that a force record of an unknown power law may have


class ElasticLaw(ContactLaw):
    """A law ``F = k c**p`` without loss; a class sets `exponent` or has it as a field."""

    form = "POWER"
    rate_free = True

    def duration_at(self, mass: float, speed: float) -> float:
        """Return the contact time in units of C/v."""
        return elastic.duration(self.exponent)

    @classmethod
    def calibrated(cls, given: Given) -> Self:
        """Return the law that has a measured contact time."""
        p = given["exponent"]
        numbers = {"stiffness": elastic.measured_stiffness(given, elastic.duration(p))}
        if cls.fixed_exponent() is None:
            numbers["exponent"] = p
        return cls(**numbers)

    @classmethod
    def flanks(cls, exponent: float | None, law: ContactLaw | None = None) -> Flanks:
        """Return the flanks: the same power of the time at touch and release."""
        either = Flank(exponent or 1.0, exponent or _STEEPEST_FLANK, exact=True)
        return either, either

    def as_hysteretic(self) -> "Hysteretic":
        """Return the law as a `Hysteretic` one that loses nothing."""
        from stackbounce.model.laws.hysteretic import Hysteretic

        return Hysteretic(self.stiffness, exponent=self.exponent, restitution=1.0)
