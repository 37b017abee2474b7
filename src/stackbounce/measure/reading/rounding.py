"""To what steps the numbers of a column were rounded, told from their digits."""

from dataclasses import dataclass
from decimal import Decimal

import numpy as np

from stackbounce.measure.quantities import Array

__all__ = ["Rounding", "rounding_of"]

_TOLD = 2000  # numbers whose digits are counted: nearly none of them may end in zeros
_SINGLE = 8  # digits that a float of 32 bits does not have, but that programs write of it
_NEAR = 5.1e-9  # how far a number of nine digits may be off the float that it was written of


@dataclass(frozen=True)
class Rounding:
    """How numbers were rounded: to decimals, to digits, or to a float of 32 bits.

    Parameters
    ----------
    decimals : int
        The most that a number has behind the decimal point; negative where all are whole tens.
    digits : int
        The most that a number has.
    single : bool
        Whether all are floats of 32 bits.
    """

    decimals: int
    digits: int
    single: bool

    def steps(self, values: Array) -> Array:
        """Return the distance of neighbouring numbers that could be written, at each value.

        Examples
        --------
        >>> Rounding(4, 6, False).steps(np.array([0.5, 12.5, 123.5])).tolist()
        [0.0001, 0.0001, 0.001]
        """
        size = np.maximum(np.abs(values), 1e-300)
        written = 10.0 ** (np.floor(np.log10(size) * (1.0 + 1e-15)) + 1 - self.digits)
        written = np.maximum(written, 10.0 ** float(-self.decimals))
        if self.single:
            binary = np.spacing(np.abs(values).astype(np.float32)).astype(np.float64)
            written += binary
        return np.asarray(written)


def rounding_of(values: Array) -> Rounding:
    """Return how finite numbers were rounded.

    Examples
    --------
    >>> rounding_of(np.array([0.0, 0.0226757, 453.492]))
    Rounding(decimals=7, digits=6, single=False)
    >>> rounding_of(np.array([0.1, 0.7], dtype=np.float32).astype(float)).single
    True
    """
    some = values[:: max(1, len(values) // _TOLD)]
    decimals, digits = -300, 1
    for value in some.tolist():
        if value:
            _, figures, exponent = Decimal(repr(value)).normalize().as_tuple()
            decimals = max(decimals, -int(exponent))
            digits = max(digits, len(figures))
    near = some.astype(np.float32).astype(np.float64)
    single = digits > _SINGLE and bool(np.all(np.abs(some - near) <= _NEAR * np.abs(some)))
    return Rounding(decimals, digits, single)
