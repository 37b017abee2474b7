"""A stack as a small drawing for a notebook, and the names of its balls."""

from collections import Counter
from collections.abc import Sequence
from html import escape
from itertools import pairwise

from stackbounce.model.ball import Ball

_MOST = 12  # balls that are drawn
_HIGH = 70.0  # pixels of all radii
_LEAST = 7.0  # pixels of a radius: a line of text fits beside each ball
_GAP = 6.0  # pixels
_LETTER = 8.0  # pixels
_LONG = 16  # characters of a name, at most
_LOOK = 'stroke="currentColor" fill="currentColor" font-family="sans-serif" font-size="12"'


def names_of(balls: Sequence[Ball]) -> list[str]:
    """Return the names of balls in tables: printable, short, and with its number if one repeats.

    Examples
    --------
    >>> names_of([Ball(0.6), Ball(0.057, name="tennis"), Ball(0.058, name="tennis")])
    ['ball 0', 'tennis (1)', 'tennis (2)']
    """
    given = [ball.name or f"ball {i}" for i, ball in enumerate(balls)]
    names = ["".join(c if c.isprintable() else "?" for c in name) for name in given]
    names = [name if len(name) <= _LONG else name[: _LONG - 1] + "…" for name in names]
    many = Counter(names)
    return [f"{name} ({i})" if many[name] > 1 else name for i, name in enumerate(names)]


def draw_stack(balls: Sequence[Ball], gaps: Sequence[float], *, floor: bool) -> str:
    """Return a stack as SVG, in the color of the text around it; empty if it is too high.

    Parameters
    ----------
    balls : sequence of Ball
        The lowest first. They are to scale, by their diameters, or if one has none, by the cube
        roots of their masses.
    gaps : sequence of float
        In m. All have the same height in the drawing.
    floor : bool
        Whether there is a floor.

    Examples
    --------
    >>> draw_stack([Ball(0.6), Ball(0.057, name="tennis")], [0.0], floor=True)[:62]
    '<svg role="img" aria-label="tennis on ball 0 on the floor" wid'
    """
    if len(balls) > _MOST:
        return ""
    sizes = [ball.diameter or 0.0 for ball in balls]
    if not all(sizes):
        sizes = [ball.mass ** (1.0 / 3.0) for ball in balls]
    radii = [max(_LEAST, _HIGH * size / sum(sizes)) for size in sizes]
    names = names_of(balls)
    middle, top, parts = max(radii) + 2.0, 0.0, []
    for name, radius, gap in zip(names, radii, (0.0, *gaps), strict=True):
        top += radius + _GAP * (gap > 0.0)
        circle = f'<circle cx="{middle:.1f}" cy="{-top:.1f}" r="{radius:.1f}" fill-opacity="0.12"/>'
        place = f'x="{2.0 * middle + 6.0:.1f}" y="{4.0 - top:.1f}" stroke="none"'
        parts.append(f"{circle}<text {place}>{escape(name)}</text>")
        top += radius
    wide, high = 2.0 * middle + 6.0 + _LETTER * max(map(len, names)), top + 4.0
    line = f'<path d="M0 1H{2.0 * middle:.1f}"/>' if floor else ""
    said = escape(" on ".join([*reversed(names), *["the floor"] * floor]))
    box = f"0 {2.0 - high:.1f} {wide:.1f} {high:.1f}"
    size = f'width="{wide:.0f}" height="{high:.0f}" viewBox="{box}"'
    drawn = f"<title>{said}</title><g {_LOOK}>{''.join(parts)}{line}</g>"
    return f'<svg role="img" aria-label="{said}" {size}>{drawn}</svg>'


def meetings(balls: Sequence[Ball]) -> list[str]:
    """Return the two sides of each contact: the floor or the ball below, and the ball above.

    Examples
    --------
    >>> meetings([Ball(0.6), Ball(0.057, name="tennis")])
    ['floor – ball 0', 'ball 0 – tennis']
    """
    return [f"{below} – {above}" for below, above in pairwise(["floor", *names_of(balls)])]
