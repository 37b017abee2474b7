"""The paper's cases for the explorer: every drop that it computes or measures, by name."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

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
    for group, made in _GROUPS.items():
        for name, title, says, make in made:
            yield Case(name, group, title, says, _sized(bench, make(bench)))


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


_Made = tuple[str, str, str, Callable[[Bench], Drop]]
_GROUPS: dict[str, tuple[_Made, ...]] = {
    "Separate collisions": (
        (
            "textbook",
            "The textbook: a lower ball 1000 times as heavy",
            "Nothing lost, the upper ball leaves at 3 times its speed, for 9 times the height.",
            _textbook("models.lossless", 1000.0),
        ),
        (
            "separate",
            "Basketball and tennis ball, nothing lost",
            "The textbook's 1.9 times the speed; Figure 9 has balls that stay in contact.",
            _textbook("models.lossless"),
        ),
        (
            "separate-lossy",
            "The same with a restitution of 0.9",
            "A tenth of the speed lost at each collision leaves 1.62 times.",
            _textbook("stack.restitution"),
        ),
    ),
    "Two masses on springs": (
        (
            "equal",
            "Equal masses, equal springs",
            "Simultaneous contacts: the upper ball leaves at 1.19 times its speed, not at 1.",
            _section_two(1.0),
        ),
        (
            "figure-4a",
            "Figure 4(a): lower ball three times as heavy",
            "On equal springs the balls are in contact for nearly as long as the floor is pressed.",
            _section_two(3.0),
        ),
        (
            "figure-4b",
            "Figure 4(b): the floor's contact 20 times as stiff",
            "A stiff floor contact ends early: the collisions are nearly separate.",
            _section_two(3.0, 20.0),
        ),
        (
            "figure-5",
            "Figure 5: two impacts on the floor",
            "The lower ball comes back to the floor after the two have parted.",
            _figure_5,
        ),
    ),
    "Basketball and tennis ball": (
        (
            "figure-8",
            "Figure 8: dropped from 30 cm",
            "The forces begin together if the balls touch.",
            stacks.spring_record,
        ),
        (
            "figure-8-gap",
            "Figure 8 with a gap of 2 mm",
            "Two millimetres of air delay the force between the balls by 7 ms.",
            lambda b: stacks.spring_record(b, b("stack.gap")),
        ),
        (
            "figure-8-hollow",
            "Figure 8 with a hollow ball",
            "A ball that is stiff until it buckles: the floor's force rises at once.",
            stacks.hollow_record,
        ),
        (
            "figure-8-hollow-gap",
            "Figure 8 with a hollow ball and a gap of 2 mm",
            "The early force stops the basketball early: the balls touch after 5 ms, not 7.",
            lambda b: stacks.hollow_record(b, b("stack.gap")),
        ),
        (
            "figure-9",
            "Figure 9: the paper's fit",
            "Springs of 2.5 and 1 kN/m give both measured speeds.",
            stacks.better_fit,
        ),
        (
            "figure-9-other",
            "The fit that the text rejects",
            "Other springs throw the tennis ball up nearly as fast, the basketball slower.",
            stacks.other_fit,
        ),
        (
            "measured-basketball-tennis",
            "Dropped from 71 cm, as it was measured",
            "With heights, delay and duration to compare: fit cross2007/basketball-tennis.",
            _measured("basketball-tennis"),
        ),
    ),
    "Superballs": (
        (
            "figure-13",
            "Figure 13: B2 on B1",
            "A gap of 1 mm and a lossy floor contact fit the measured speeds.",
            _on_b1(stacks.small_fit),
        ),
        (
            "B3-on-B1",
            "B3 on B1, section V's fit",
            "The lightest ball, 2.4 mm above, leaves at more than twice its speed.",
            _on_b1(stacks.smallest_fit),
        ),
        (
            "B1-on-B2",
            "B1 on B2, the heavy ball on top",
            "It leaves at little more than the speed that it came with.",
            lambda b: stacks.reversed_pair(b, 0.0),
        ),
        (
            "B1-on-B3-early",
            "B1 on B3, meeting after 2 ms",
            "The light ball below is pressed to the floor three times.",
            stacks.early_pair,
        ),
        (
            "B1-on-B3-late",
            "B1 on B3, meeting after 7 ms",
            "The light ball below bounces to and fro: the two meet five times.",
            stacks.late_pair,
        ),
        (
            "B1-on-B1",
            "B1 on B1, 12 ms on the floor",
            "Two nearly equal balls, apart enough for the measured duration.",
            stacks.late_twins,
        ),
        (
            "B1-on-B1-parted",
            "B1 on B1, meeting as the lower one leaves the floor",
            "Entirely separate collisions: the balls all but exchange their speeds.",
            stacks.parted_twins,
        ),
    ),
}
