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
from stackbounce.cross2007.drops import rigid_pair
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
