"""The paper's cases for the explorer: every drop that it computes or measures, by name.

Their words stand in ``cases.toml``.
"""

import tomllib
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from importlib.resources import files

from stackbounce.cross2007 import datasets, stacks
from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.data import PAPER
from stackbounce.cross2007.drops import rigid_pair, spring_pair
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
    cases = tomllib.loads((files(__package__) / "cases.toml").read_text("utf-8"))
    for name, words in cases.items():
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
        replace(
            ball,
            name=f"{name} {where}" if twins else name,
            diameter=bench(f"{name}.diameter"),
        )
        for ball, name, where in zip(drop.balls, names, ("below", "above"), strict=True)
    ]
    return replace(drop, balls=balls)


def _section_two(ratio: float, stiffness: float = 1.0) -> Callable[[Bench], Drop]:
    """Return a function that makes section II's drop with a mass ratio and a stiffness ratio."""
    return lambda b: stacks.section_two(b, ratio, stiffness)


def _textbook(restitution: str, ratio: float | None = None) -> Callable[[Bench], Drop]:
    """Return a function that makes separate collisions of two balls, by default the paper's."""

    def make(b: Bench) -> Drop:
        lower, upper = stacks.stack_masses(b)
        masses = (lower if ratio is None else ratio * upper), upper
        return rigid_pair(masses, b(restitution), speed=b("stack.impact_speed"))

    return make


def _figure_5(b: Bench) -> Drop:
    masses = b("fig5.lower_mass"), b("fig5.upper_mass")
    stiffnesses = b("fig5.floor_stiffness"), b("fig5.ball_stiffness")
    return spring_pair(masses, stiffnesses, speed=b("models.speed"))


def _measured(name: str) -> Callable[[Bench], Drop]:
    return lambda _: datasets.load_dataset(name).drop


def _on_b1(make: Callable[[Bench, float], Drop]) -> Callable[[Bench], Drop]:
    return lambda b: make(b, stacks.heavier_b1(b))


_DROPS: dict[str, Callable[[Bench], Drop]] = {
    "textbook": _textbook("models.lossless", 1000.0),
    "separate": _textbook("models.lossless"),
    "separate-lossy": _textbook("stack.restitution"),
    "equal": _section_two(1.0),
    "figure-4a": _section_two(3.0),
    "figure-4b": _section_two(3.0, 20.0),
    "figure-5": _figure_5,
    "figure-8": stacks.spring_record,
    "figure-8-gap": lambda b: stacks.spring_record(b, b("stack.gap")),
    "figure-8-hollow": stacks.hollow_record,
    "figure-8-hollow-gap": lambda b: stacks.hollow_record(b, b("stack.gap")),
    "figure-9": stacks.better_fit,
    "figure-9-other": stacks.other_fit,
    "measured-basketball-tennis": _measured("basketball-tennis"),
    "figure-13": _on_b1(stacks.small_fit),
    "B3-on-B1": _on_b1(stacks.smallest_fit),
    "B1-on-B2": lambda b: stacks.reversed_pair(b, 0.0),
    "B1-on-B3-early": stacks.early_pair,
    "B1-on-B3-late": stacks.late_pair,
    "B1-on-B1": stacks.late_twins,
    "B1-on-B1-parted": stacks.parted_twins,
}
