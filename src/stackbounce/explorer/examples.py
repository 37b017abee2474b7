"""Examples with the balls that a class owns: what to drop, and what to see."""

from collections.abc import Iterator, Sequence

from stackbounce.cross2007.cases import Case
from stackbounce.model import Drop
from stackbounce.model.catalogue import stack

_PAIRS = "Two balls a class owns"
_TOWERS = "Three balls and more"
_HEIGHT = 1.0  # m


def list_examples() -> Iterator[Case]:
    """Yield the examples, those of two balls first.

    Examples
    --------
    >>> [case.name for case in list_examples()][:2]
    ['class-touching', 'class-gap']
    """
    tower = ["big basketball", "volleyball", "tennis ball", "ping-pong ball"]
    yield Case(
        "class-touching",
        _PAIRS,
        "Tennis ball on a basketball, touching",
        "The tennis ball goes up at 1.36 times its speed, far from the well-known three times.",
        _dropped(["big basketball", "tennis ball"], 0.0),
    )
    yield Case(
        "class-gap",
        _PAIRS,
        "The same, held 2 cm apart",
        "A gap of 2 cm makes it 1.92 times: most of the floor's push is over when the balls meet.",
        _dropped(["big basketball", "tennis ball"], 0.02),
    )
    yield Case(
        "class-superball",
        _PAIRS,
        "Ping-pong ball on a superball, 5 mm apart",
        "It goes up at 2.16 times its speed; close the gap, and see how little is left.",
        _dropped(["superball", "ping-pong ball"], 0.005),
    )
    yield Case(
        "class-golf",
        _PAIRS,
        "Ping-pong ball on a golf ball, touching",
        "A hard ball below leaves the floor early: 2.14 times, though the two touch.",
        _dropped(["golf ball", "ping-pong ball"], 0.0),
    )
    yield Case(
        "class-three",
        _TOWERS,
        "Basketball, tennis ball and ping-pong ball, 2 cm apart",
        "The ping-pong ball leaves at 3.88 times its speed, for 15 times the height.",
        _dropped([tower[0], *tower[2:]], 0.02),
    )
    yield Case(
        "cannon",
        _TOWERS,
        "The Galilean cannon: four balls, 2 cm apart",
        "Each ball hands its energy up; the last leaves at 4.28 times, for 18 times the height.",
        _dropped(tower, 0.02),
    )
    yield Case(
        "cannon-touching",
        _TOWERS,
        "The cannon with balls that touch",
        "Without gaps all push at the same time, and the last ball leaves at 1.77 times only.",
        _dropped(tower, 0.0),
    )
    yield Case(
        "cradle",
        _TOWERS,
        "Newton's cradle, upright and without a floor",
        "A steel ball strikes four that touch: the last leaves at 0.81 times, the next at 0.28.",
        _cradle(5),
    )


def _dropped(names: Sequence[str], gap: float) -> Drop:
    chosen = stack(names)
    return Drop(chosen.balls, chosen.contacts, [gap] * (len(names) - 1), height=_HEIGHT)


def _cradle(count: int) -> Drop:
    chosen = stack(["steel ball"] * count)
    velocities = [1.0] + [0.0] * (count - 1)
    contacts = [None, *chosen.contacts[1:]]
    return Drop(chosen.balls, contacts, [0.0] * (count - 1), velocities=velocities)
