"""Restitutions that depend on the speed and scatter, with many digits, for `rigid` and `falling`.

Each function returns what these take as a restitution: a function of the closing speed. One that
scatters counts its calls, so that it serves for one contact in one run.
"""

from collections.abc import Callable
from itertools import count
from typing import Any, TypeAlias

from mpmath import mp, mpf

from reference.common import DIGITS

Restitution: TypeAlias = Callable[[Any], Any]

MULTIPLIERS = 747796405, 277803737  # of the hash PCG-RXS-M-XS on 32 bits
INCREMENT = 2891336453
SECOND = 2654435769  # what the second word of a draw differs by


def falling_power(e: float, speed: float, exponent: float) -> Restitution:
    """Return e (v/speed)^-exponent, at most 1."""
    return lambda v: min(mpf(1), mpf(e) * (v / mpf(speed)) ** -mpf(exponent))


def loss_power(e: float, speed: float, exponent: float) -> Restitution:
    """Return 1 - (1 - e) (v/speed)^exponent, at least 0."""
    return lambda v: max(mpf(0), 1 - (1 - mpf(e)) * (v / mpf(speed)) ** mpf(exponent))


def scattered(mean: Restitution, scatter: float, seed: float, contact: int) -> Restitution:
    """Return a mean restitution with normal scatter, kept from 0 to 1."""
    hits = count()
    return lambda v: min(
        mpf(1), max(mpf(0), mean(v) + mpf(scatter) * normal(seed, contact, next(hits)))
    )


def normal(seed: float, contact: int, hit: int) -> mpf:
    """Return the draw of a contact's collision, counted from 0."""
    whole, part = divmod(seed, 1.0)
    word = 0
    for key in (int(whole), int(part * 2**32), contact, hit % 2**32):
        word = hashed(word ^ key)
    with mp.workdps(DIGITS):
        first, second = (mpf(hashed(word ^ key)) / 2**32 for key in (0, SECOND))
        return mp.sqrt(-2 * mp.log(first + mpf(2) ** -33)) * mp.cos(2 * mp.pi * second)


def hashed(word: int) -> int:
    """Return the hash of a word of 32 bits; all products are modulo 2^32."""
    state = (word * MULTIPLIERS[0] + INCREMENT) % 2**32
    shift = 4 + (state >> 28)
    mixed = ((state ^ (state >> shift)) * MULTIPLIERS[1]) % 2**32
    return mixed ^ (mixed >> 22)
