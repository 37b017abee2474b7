"""The paper's cases and lines for the explorer: its drops, and curves over a number of a drop.

Cases are all drops that it computes or measures; their words stand in ``cases.toml``. Lines are
those of Figures 2, 4 and 6: a drop, the number of it that varies, and between which ends.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any
from urllib.parse import urlencode

from stackbounce.cross2007 import datasets, stacks
from stackbounce.cross2007.bench import PAPER, Bench
from stackbounce.cross2007.drops import rigid_pair, spring_pair
from stackbounce.files import shipped_table
from stackbounce.model import Drop


@dataclass(frozen=True)
class Case:
    """A drop of the paper.

    Parameters
    ----------
    name : str
        An identifier, such as ``figure-9``.
    group : str
        The heading of its group.
    title : str
        The title on screen.
    says : str
        One sentence on what the case shows.
    drop : Drop
        The drop.

    Examples
    --------
    >>> next(list_cases()).name
    'textbook'
    """

    name: str
    group: str
    title: str
    says: str
    drop: Drop


def list_cases() -> Iterator[Case]:
    """Yield the cases in the paper's order.

    Examples
    --------
    >>> [case.name for case in list_cases() if case.group == "Basketball and tennis ball"]
    ['figure-8', 'figure-8-gap', 'figure-8-hollow', 'figure-8-hollow-gap', 'figure-9', \
'figure-9-other', 'measured-basketball-tennis']
    """
    bench = Bench(PAPER)
    for name, words in shipped_table(__package__, "cases.toml").items():
        yield Case(name, **words, drop=_sized(bench, _DROPS[name](bench)))


def _sized(bench: Bench, drop: Drop) -> Drop:
    """Return a drop with the paper's names and diameters, if the masses are those of its balls."""
    known = {bench(f"{name}.mass"): name for name in ("basketball", "tennis", "B1", "B2", "B3")}
    known[stacks.heavier_b1(bench)] = "B1"
    names = [known.get(ball.mass) for ball in drop.balls]
    if None in names:
        return drop
    twins = len(set(names)) < len(names)
    balls = [
        replace(ball, name=f"{name} {where}" if twins else name, diameter=bench(f"{name}.diameter"))
        for ball, name, where in zip(drop.balls, names, ("below", "above"), strict=True)
    ]
    return replace(drop, balls=balls)


def _textbook(b: Bench, restitution: str, ratio: float | None = None) -> Drop:
    """Return separate collisions of two balls, by default the paper's."""
    lower, upper = stacks.stack_masses(b)
    masses = (lower if ratio is None else ratio * upper), upper
    return rigid_pair(masses, b(restitution), speed=b("stack.impact_speed"))


_DROPS: dict[str, Callable[[Bench], Drop]] = {
    "textbook": lambda b: _textbook(b, "models.lossless", 1000.0),
    "separate": lambda b: _textbook(b, "models.lossless"),
    "separate-lossy": lambda b: _textbook(b, "stack.restitution"),
    "equal": lambda b: stacks.section_two(b, 1.0, 1.0),
    "figure-4a": lambda b: stacks.section_two(b, 3.0, 1.0),
    "figure-4b": lambda b: stacks.section_two(b, 3.0, 20.0),
    "figure-5": stacks.figure_5,
    "figure-8": stacks.spring_record,
    "figure-8-gap": lambda b: stacks.spring_record(b, b("stack.gap")),
    "figure-8-hollow": stacks.hollow_record,
    "figure-8-hollow-gap": lambda b: stacks.hollow_record(b, b("stack.gap")),
    "figure-9": stacks.better_fit,
    "figure-9-other": stacks.other_fit,
    "measured-basketball-tennis": lambda _: datasets.load_dataset("basketball-tennis").drop,
    "figure-13": lambda b: stacks.small_fit(b, stacks.heavier_b1(b)),
    "B3-on-B1": lambda b: stacks.smallest_fit(b, stacks.heavier_b1(b)),
    "B1-on-B2": lambda b: stacks.reversed_pair(b, 0.0),
    "B1-on-B3-early": stacks.early_pair,
    "B1-on-B3-late": stacks.late_pair,
    "B1-on-B1": stacks.late_twins,
    "B1-on-B1-parted": stacks.parted_twins,
}


@dataclass(frozen=True)
class Range:
    """The horizontal axis of a figure.

    Parameters
    ----------
    path : str
        What varies: ``mass_ratio`` or ``stiffness_ratio``, lower over upper.
    low, high : float
        Its ends.
    log : bool
        Whether it is logarithmic.
    """

    path: str
    low: float
    high: float
    log: bool = False


AFTER_FIRST = Range("mass_ratio", 0.02, 10.0)
"""That of Figs. 2(a) and 4, which begin at 0."""

AFTER_SECOND = Range("mass_ratio", 0.02, 1.0)
"""That of Fig. 2(b)."""

STIFFNESS = Range("stiffness_ratio", 0.1, 100.0, log=True)
"""That of Fig. 6."""


@dataclass(frozen=True)
class Line:
    """A curve of the paper: the rebound of a drop over one of its numbers.

    Parameters
    ----------
    name : str
        An identifier, such as ``figure-4a``.
    title : str
        The title on screen.
    says : str
        One or two sentences on what it shows.
    drop : Drop
        The drop, with a value of the number that varies.
    across : Range
        The number that varies.
    measured : tuple of (float, float)
        The measured rebound ratio of each ball with its error; empty where there are none.

    Examples
    --------
    >>> next(list_lines()).name
    'figure-2a'
    """

    name: str
    title: str
    says: str
    drop: Drop
    across: Range
    measured: tuple[tuple[float, float], ...] = ()


def list_lines() -> Iterator[Line]:
    """Yield the lines in the paper's order.

    Examples
    --------
    >>> [line.name for line in list_lines() if line.measured]
    ['figure-6-tennis', 'figure-6-B2', 'figure-6-B3']
    """
    bench = Bench(PAPER)
    yield from _separate(bench)
    yield from _on_springs(bench)
    _, middle, small = pair_mass_ratios(bench)
    yield _over_stiffness(bench, "basketball", "tennis", stacks.better_fit(bench))
    yield _over_stiffness(bench, "B1", "B2", _superballs(bench, "fig13", middle, "B2"))
    yield _over_stiffness(bench, "B1", "B3", _superballs(bench, "B3_fit", small, "B3"))


def pair_mass_ratios(b: Bench) -> tuple[float, ...]:
    """Return the mass ratios m1/m2 of Fig. 6.

    Examples
    --------
    >>> [round(ratio, 2) for ratio in pair_mass_ratios(Bench(PAPER))]
    [2.63, 4.23, 12.3]
    """
    lower, upper = stacks.stack_masses(b)
    return lower / upper, b("B2_on_B1.mass_ratio"), b("B3_on_B1.mass_ratio")


def _separate(b: Bench) -> Iterator[Line]:
    """Yield the lines of Fig. 2: separate collisions with two restitutions."""
    figures = (("a", "first", 3.0, AFTER_FIRST), ("b", "second", 0.6, AFTER_SECOND))
    for part, count, ratio, across in figures:
        says = (
            "Speeds after the last collision. To the right of the last place where the lower ball "
            f"stops, that is the {count} one of the two balls, which Figure 2({part}) shows."
        )
        for key, ending in (("models.lossless", ""), ("models.restitution", "-lossy")):
            upper, e = b("fig5.upper_mass"), b(key)
            drop = rigid_pair((ratio * upper, upper), e, speed=b("models.speed"))
            title = f"Figure 2({part}): separate, e = {e:g}"
            yield Line(f"figure-2{part}{ending}", title, says, drop, across)


def _on_springs(b: Bench) -> Iterator[Line]:
    """Yield the lines of Fig. 4: equal springs, and a stiff lower one."""
    equal = b("models.stiffness_ratio")
    stiff = b("fig5.floor_stiffness") / b("fig5.ball_stiffness")
    for part, ratio, says in (
        ("a", equal, "Balls that stay in contact share the energy in another way."),
        ("b", stiff, "A stiff floor contact ends early: nearly separate collisions."),
    ):
        drop = stacks.section_two(b, 3.0, ratio)
        title = f"Figure 4({part}): springs, k₁/k₂ = {ratio:g}"
        yield Line(f"figure-4{part}", title, says, drop, AFTER_FIRST)


def _over_stiffness(b: Bench, lower: str, upper: str, drop: Drop) -> Line:
    """Return a line of Fig. 6, with what was measured of its pair."""
    balls = [
        replace(ball, name=name, diameter=b(f"{name}.diameter"))
        for ball, name in zip(drop.balls, (lower, upper), strict=True)
    ]
    measured = [f"{upper}_on_{lower}.{ball}" for ball in ("lower", "upper")]
    return Line(
        f"figure-6-{upper}",
        f"Figure 6: {upper} on {lower}",
        f"Mass ratio {balls[0].mass / balls[1].mass:.3g}, no loss in the springs. Bands show the "
        "measured speeds: the paper asks at which stiffness ratio the curves meet them.",
        replace(drop, balls=balls),
        STIFFNESS,
        tuple((b(key), b.data[key].spread) for key in measured),
    )


def _superballs(b: Bench, fit: str, ratio: float, upper: str) -> Drop:
    """Return two superballs that touch, on the springs of a fit of section V, without loss."""
    masses = ratio * b(f"{upper}.mass"), b(f"{upper}.mass")
    stiffnesses = b(f"{fit}.floor_stiffness"), b(f"{fit}.ball_stiffness")
    return spring_pair(masses, stiffnesses, speed=stacks.superball_speed(b))


def explorer_address(drop: Drop, settings: Mapping[str, Any]) -> str:
    """Return the end of a drop's address in the explorer, with paths and values as it writes them.

    Parameters
    ----------
    drop : Drop
        What it shows.
    settings : mapping
        What its address says besides, by path or as dicts; the view is ``play`` by default.

    Examples
    --------
    >>> from stackbounce import Ball, Drop, Spring
    >>> drop = Drop([Ball(0.1)], [Spring(1e3)], impact_speed=1.0)
    >>> explorer_address(drop, {"loop": 1})[:35]
    '#view=play&impact_speed=1.0&gravity'
    """
    state = {"view": "play", **drop.to_mapping(), **settings}
    return f"#{urlencode(list(_flatten('', state)))}"


def _flatten(path: str, value: Any) -> Iterator[tuple[str, str]]:
    if isinstance(value, dict | list | tuple):
        members = value.items() if isinstance(value, dict) else enumerate(value)
        for key, member in members:
            yield from _flatten(f"{path}.{key}" if path else str(key), member)
    elif value is not None:
        yield path, str(value).lower() if isinstance(value, bool) else str(value)
