"""A law from measured points: monotone splines of second order, loading and unloading.

Between two points (x, y) and (x + h, y + h d), where the slopes are s and t, the spline has two
parabolas that meet in the middle with the slope ``2 d - (s + t)/2``; one is enough if that lies on
the line between s and t. It has no wiggles: the slope at a point is the harmonic mean of the slopes
of the two chords that meet there, which is at most twice the smaller, so that no slope is negative.

Source: L. L. Schumaker, SIAM J. Numer. Anal. 20, 853 (1983); F. N. Fritsch and J. Butland, SIAM J.
Sci. Stat. Comput. 5, 300 (1984).
"""

import functools
import itertools
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, ClassVar, Self

from stackbounce.engine import codes
from stackbounce.errors import InvalidValue, finite, listed
from stackbounce.model.laws.law import RESTITUTION, ContactLaw, EngineNumbers, Flank, Given
from stackbounce.model.laws.registry import register
from stackbounce.units import Unit, checked

MOST_POINTS = 16
"""The largest number of points of a curve, with the one at 0: two pieces for each interval."""

_ONE_PARABOLA = 1e-9  # of the slope: two parabolas are one
_STEEPEST_FLANK = 6.0
_NARROWEST = 1e-3  # of a compression: the smallest step to it
_PARTS = 50  # of a piece, at whose ends its steepness is looked at
_SAFELY = 1.02  # times the largest of these: surely no less than the largest of all

Piece = tuple[float, float, float, float]
"""Where a piece begins, and a, b, s of ``a + b d + s d**2``, d being the distance from there."""


@register
class Tabulated(ContactLaw):
    """A law from measured points, such as those of a press curve: force over compression.

    Loading follows a smooth curve through the points that rises everywhere, and goes on straight
    beyond the last one. Unloading follows

    - the points of `unloading`, measured from the last of `compression`. From any peak C it is the
      loading curve times the measured share of unloading over loading, which is a function of
      ``c/C``: straight between the points and on towards 0, at least 0, and made to rise, by
      lowering it, where it does not;
    - or the loading curve times ``1 - g + g (c/C)**m``, where g is such that the fraction
      ``restitution**2`` of the work is returned. The exponent m is that for which g would be 1 if
      the curve were everywhere as steep as where it is steepest;
    - or, if neither is given, the loading curve: no energy is lost.

    Compressed again before it has opened, the contact follows the rule of `Hysteretic`. Neither
    force nor loss depend on the rate.

    Parameters
    ----------
    compression : sequence of float
        In m, from 0 on, rising by at least 0.1 % from point to point; 2 to 16 points.
    force : sequence of float
        In N, from 0 on, rising: the force at each compression in loading.
    unloading : sequence of float, optional
        In N: the force at each compression in unloading from the last one. It begins with 0, never
        falls, is at most the force in loading, and ends with it.
    restitution : float, optional
        e, from 1e-5 to 1, where the unloading curve is not known.

    Raises
    ------
    InvalidValue
        If the points do not rise, their numbers differ, or both `unloading` and `restitution` are
        given.
    InvalidType
        If something is no number.

    Notes
    -----
    Source: the points are the user's; the splines are those of `stackbounce.model.laws.tabulated`.

    Examples
    --------
    >>> law = Tabulated([0.0, 1e-3, 2e-3], [0.0, 20.0, 60.0], unloading=[0.0, 10.0, 60.0])
    >>> round(law.restitution_at(0.1, 1.0), 3), round(law.restitution_at(0.1, 0.1), 3)
    (0.842, 0.821)
    """

    formula = "F = the monotone spline through the points"
    source = "L. L. Schumaker, SIAM J. Numer. Anal. 20, 853 (1983)"
    form = codes.TABULATED
    listed = False
    rate_free = True
    loss = "restitution"
    loss_depends_on = ("mass", "impact_speed")
    needs = ()  # `calibrated` says what makes a table
    usual_flanks = Flank(1.0, _STEEPEST_FLANK), Flank(1.0, _STEEPEST_FLANK)

    exponent: ClassVar[float] = 1.0
    compression: Annotated[Sequence[float], Unit("m")]
    force: Annotated[Sequence[float], Unit("N")]
    unloading: Annotated[Sequence[float], Unit("N")] | None = None
    restitution: float | None = None

    def __post_init__(self) -> None:
        lengths = _points("compression", self.compression, "m")
        forces = _points("force", self.force, "N", lengths)
        object.__setattr__(self, "compression", lengths)
        object.__setattr__(self, "force", forces)
        if self.unloading is not None:
            back = _points("unloading", self.unloading, "N", lengths, level=True)
            if back[-1] != forces[-1]:
                raise InvalidValue(
                    f"unloading must end with the last force, {forces[-1]!r}, got {back[-1]!r}"
                )
            above = [i for i, (one, two) in enumerate(zip(back, forces, strict=True)) if one > two]
            if above:
                raise InvalidValue(
                    f"unloading.{above[0]} must be at most force.{above[0]}, "
                    f"{forces[above[0]]!r}, got {back[above[0]]!r}"
                )
            object.__setattr__(self, "unloading", back)
        if self.restitution is not None:
            if self.unloading is not None:
                raise InvalidValue("unloading and restitution must not both be given, got both")
            e = checked(RESTITUTION.check, "restitution", self.restitution)
            object.__setattr__(self, "restitution", e)

    def to_mapping(self) -> dict[str, Any]:
        """Return the law as plain values, with lists of points."""
        return {
            name: list(value) if isinstance(value, tuple) else value
            for name, value in super().to_mapping().items()
            if value is not None
        }

    def described(self) -> str:
        """Return a description of the law for users."""
        words = [
            f"Tabulated, {len(self.compression)} points",
            f"up to {1e3 * self.compression[-1]:.4g} mm and {self.force[-1]:.4g} N",
        ]
        if self.restitution is not None:
            words.append(f"restitution {self.restitution:.4g}")
        return ", ".join(words)

    def engine_numbers(self, varied: Mapping[str, Any] = {}) -> EngineNumbers:
        """Return the law's numbers: those of its pieces and its loss, see `engine.forces`."""
        loading, shares = self._curves()
        kept = 1.0 if self.restitution is None else self.restitution**2
        loss = _steepness(loading) * (1.0 / kept - 1.0)  # m
        if self.unloading is not None:
            kept, loss = 0.0, float(len(shares))
        return self.form, 1.0, kept, float(len(loading)), loss

    def pieces(self) -> list[float]:
        """Return the numbers of the loading pieces, then of those of the share in unloading."""
        return [number for curve in self._curves() for piece in curve for number in piece]

    def _curves(self) -> tuple[list[Piece], list[Piece]]:
        back = None if self.unloading is None else tuple(self.unloading)
        return _curves(tuple(self.compression), tuple(self.force), back)

    def series_constants(self) -> dict[str, Any]:
        """Raise an error: two tables in series are no table at the same points."""
        raise InvalidValue(
            "law_a and law_b must be laws with a formula, got Tabulated: give the table of both "
            "together, as a press measures it with one ball on the other"
        )

    def contact_time_at(self, mass: float, speed: float) -> float:
        """Return the contact time in s of a mass in kg at a speed in m/s, by a simulation."""
        return self._bounce(mass, speed)[1]

    @classmethod
    def calibrated(cls, given: Given) -> Self:
        """Raise an error: a contact time and a restitution are no table."""
        raise InvalidValue(
            "law_class must be a law with a formula, got Tabulated: press(...).as_law() makes one "
            "of a press curve"
        )


def _points(
    name: str,
    values: object,
    unit: str,
    like: Sequence[float] | None = None,
    *,
    level: bool = False,
) -> tuple[float, ...]:
    """Return the points of a curve from 0 on; raise if they do not rise."""
    given = listed(name, values, MOST_POINTS)  # of more, `press(...).as_law()` makes a law
    points = tuple(checked(finite, f"{name}.{i}", value, unit) for i, value in enumerate(given))
    if len(points) < 2:
        raise InvalidValue(f"{name} must have from 2 to {MOST_POINTS} points, got {len(points)}")
    if like is not None and len(points) != len(like):
        raise InvalidValue(
            f"{name} must have {len(like)} points, as compression, got {len(points)}"
        )
    if points[0] != 0.0:
        raise InvalidValue(f"{name}.0 must be 0, where the ball is just touched, got {points[0]!r}")
    for i, (one, two) in enumerate(itertools.pairwise(points)):
        if two < one or (two == one and not level):
            words = "at least" if level else "above"
            raise InvalidValue(f"{name}.{i + 1} must be {words} {name}.{i}, {one!r}, got {two!r}")
        if like is None and two - one < _NARROWEST * two:
            raise InvalidValue(
                f"{name}.{i + 1} must be at least 0.1 % above {name}.{i}, {one!r}, got {two!r}"
            )
    return points


@functools.lru_cache(maxsize=64)
def _curves(
    lengths: tuple[float, ...], forces: tuple[float, ...], back: tuple[float, ...] | None
) -> tuple[list[Piece], list[Piece]]:
    """Return the pieces of loading in m and N, and of the share in unloading over c/C."""
    loading = monotone_spline(lengths, forces)
    return loading, [] if back is None else _shares(lengths, forces, back)


def _shares(x: Sequence[float], forces: Sequence[float], back: Sequence[float]) -> list[Piece]:
    """Return the straight pieces of unloading over loading, which rises to 1, over c/C."""
    at = [place / x[-1] for place in x[1:]]
    share = [out / force for out, force in zip(back[1:], forces[1:], strict=True)]
    rising = list(itertools.accumulate(reversed(share), min))[::-1]
    steps = zip(itertools.pairwise(at), itertools.pairwise(rising), strict=True)
    slopes = [(high - low) / (end - begin) for (begin, end), (low, high) in steps]
    foot = max(0.0, rising[0] - slopes[0] * at[0]) if slopes else 1.0
    first = (0.0, foot, (rising[0] - foot) / at[0], 0.0)
    others = zip(at, rising, slopes, strict=False)
    return [first, *((begin, low, slope, 0.0) for begin, low, slope in others)]


def _steepness(pieces: list[Piece]) -> float:
    """Return an upper bound of c F/W, of the compression, the force and the work of loading."""
    most, work = 0.0, 0.0
    ends = [piece[0] for piece in pieces[1:]] + [2.0 * pieces[-1][0]]
    for (begin, height, slope, square), end in zip(pieces, ends, strict=True):
        before = work
        for k in range(1, _PARTS + 1):
            y = (end - begin) * k / _PARTS
            work = before + y * (height + y * (0.5 * slope + y * square / 3.0))
            most = max(most, (begin + y) * (height + y * (slope + y * square)) / work)
    return _SAFELY * most


def monotone_spline(x: Sequence[float], y: Sequence[float]) -> list[Piece]:
    """Return the pieces of a monotone spline of second order through points, and straight beyond.

    Parameters
    ----------
    x, y : sequence of float
        The points; x rises, and y never falls.

    Returns
    -------
    list of tuple of float
        For each piece, where it begins, and a, b, s of ``a + b d + s d**2``, d from there.

    Examples
    --------
    >>> monotone_spline([0.0, 1.0, 2.0], [0.0, 1.0, 2.0])
    [(0.0, 0.0, 1.0, 0.0), (1.0, 1.0, 1.0, 0.0), (2.0, 2.0, 1.0, 0.0)]
    """
    chords = [(y[i + 1] - y[i]) / (x[i + 1] - x[i]) for i in range(len(x) - 1)]
    slopes = _slopes(x, chords)
    pieces: list[Piece] = []
    for i, chord in enumerate(chords):
        low, high, width = slopes[i], slopes[i + 1], x[i + 1] - x[i]
        if abs(low + high - 2.0 * chord) <= _ONE_PARABOLA * chord:
            pieces.append((x[i], y[i], low, 0.5 * (high - low) / width))
            continue
        middle = 2.0 * chord - 0.5 * (low + high)
        half = 0.5 * width
        height = y[i] + 0.5 * (low + middle) * half
        pieces.append((x[i], y[i], low, 0.5 * (middle - low) / half))
        pieces.append((x[i] + half, height, middle, 0.5 * (high - middle) / half))
    pieces.append((x[-1], y[-1], slopes[-1] if slopes[-1] > 0.0 else chords[-1], 0.0))
    return pieces


def _slopes(x: Sequence[float], chords: Sequence[float]) -> list[float]:
    """Return the slopes at the points: weighted harmonic means; of a parabola at the ends."""
    inner = []
    for i in range(1, len(chords)):
        left, right = chords[i - 1], chords[i]
        if left <= 0.0 or right <= 0.0:
            inner.append(0.0)
            continue
        near, far = x[i] - x[i - 1], x[i + 1] - x[i]
        share = (near + 2.0 * far) / (3.0 * (near + far))
        mean = left * right / (share * right + (1.0 - share) * left)
        inner.append(min(mean, 2.0 * left, 2.0 * right))
    if not inner:
        return [chords[0], chords[0]]
    first = min(max(2.0 * chords[0] - inner[0], 0.0), 2.0 * chords[0])
    last = min(max(2.0 * chords[-1] - inner[-1], 0.0), 2.0 * chords[-1])
    return [first, *inner, last]
