"""The numbers that the paper prints, from ``claims.toml``: where, what, and why one differs."""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from types import MappingProxyType
from typing import NamedTuple


class Reading(NamedTuple):
    """Another reading of a claim: what it assumes, and the number to compare with, in digits.

    That number is by default the one of the claim.
    """

    text: str
    number: str = ""


@dataclass(frozen=True)
class Claim:
    """A number that the paper prints.

    Parameters
    ----------
    id : str
        Its name.
    where : str
        Section, figure or table.
    what : str
        What it is.
    printed : str
        As printed, without the unit.
    number : str
        The same in digits, by default `printed`; the tolerance follows from its last one.
    unit : str
        A key of `SCALES`.
    counted : bool
        Whether it is a count, which must be equal.
    reason : str
        The reason for a difference, or a remark on an agreement.
    readings : tuple of Reading
        Other readings of it.
    """

    id: str
    where: str
    what: str
    printed: str
    number: str = ""
    unit: str = ""
    counted: bool = False
    reason: str = ""
    readings: tuple[Reading, ...] = ()

    @property
    def digits(self) -> str:
        """The printed number in digits."""
        return self.number or self.printed


def _read_claims() -> dict[str, Claim]:
    read = tomllib.loads((files(__package__) / "claims.toml").read_text("utf-8"))
    claims = {}
    for name, entry in read["claims"].items():
        reason = entry.pop("reason", "").format(**read["reasons"])
        readings = tuple(Reading(*found) for found in entry.pop("readings", ()))
        claims[name] = Claim(name, reason=reason, readings=readings, **entry)
    return claims


CLAIMS: Mapping[str, Claim] = MappingProxyType(_read_claims())
"""The claims by name, in the order of the paper.

Examples
--------
>>> CLAIMS["II.ten_springs"].printed
'1.13'
"""
