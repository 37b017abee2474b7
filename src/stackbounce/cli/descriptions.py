"""How balls, contacts, laws and drops are called in tables."""

from stackbounce.cli.scenario import DEFAULT_HEIGHT, Scenario
from stackbounce.cli.tables import number
from stackbounce.model.drop import Drop
from stackbounce.model.laws import ContactLaw


def label(name: str | None, i: int) -> str:
    """Return the name of ball `i` in tables: printable, and at most 16 characters.

    Examples
    --------
    >>> label(None, 1), label("B1", 0)
    ('ball 1', 'B1')
    """
    text = "".join(c if c.isprintable() else "?" for c in name or f"ball {i}")
    return text if len(text) <= 16 else text[:15] + "…"


def incidence(scenario: Scenario) -> str:
    """Return the names of the balls, and their height or speed."""
    drop = scenario.drop
    names = " + ".join(label(ball.name, i) for i, ball in enumerate(drop.balls))
    if drop.velocities is not None:
        text = "coming in at " + ", ".join(number(v) for v in drop.velocities) + " m/s"
    elif drop.height is not None:
        text = f"from {drop.height:.6g} m, at {number(drop.reference_speed)} m/s"
    else:
        text = f"at {number(drop.reference_speed)} m/s"
    if scenario.speed_source == "default":
        text += f" ({DEFAULT_HEIGHT:g} m unless --height or --speed is given)"
    return f"{names} {text}"


def meeting(drop: Drop, contact: int) -> str:
    """Return the two sides of a contact: the floor or the ball below, and the ball above."""
    upper = label(drop.balls[contact].name, contact)
    below = "floor" if contact == 0 else label(drop.balls[contact - 1].name, contact - 1)
    return f"{below} – {upper}"


def law_text(law: ContactLaw | None) -> str:
    """Return a contact law in words.

    Examples
    --------
    >>> from stackbounce.model import Spring
    >>> law_text(Spring(2500))
    'Spring, stiffness 2500 N/m'
    """
    return "none" if law is None else law.described()
