"""The audit's checks of section III: the tennis ball on the basketball."""

from collections.abc import Callable
from math import pi, sqrt

from stackbounce.cross2007 import stacks
from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.checks import Compute
from stackbounce.cross2007.drops import (
    after_meeting,
    fallen_speed,
    force_above,
    rigid_pair,
    risen_height,
    spring_pair,
)
from stackbounce.model.drop import STANDARD_GRAVITY, Drop
from stackbounce.run.result import Result


def _kinetic(mass: float, speed: float) -> float:
    return 0.5 * mass * speed**2


def _energy_stacked(b: Bench) -> float:
    upper = _kinetic(b("tennis.mass"), b("stack.upper_speed"))
    return upper + _kinetic(b("basketball.mass"), b("stack.lower_speed"))


def _energy_side(b: Bench) -> float:
    lower = b("basketball.mass") * STANDARD_GRAVITY * b("basketball.rebound_height")
    return lower + b("tennis.mass") * STANDARD_GRAVITY * b("tennis.rebound_height")


def _bottom(b: Bench) -> float:
    """How far the bottom of the basketball gives way on the floor."""
    return b("static.basketball") / 2


def _top(b: Bench) -> float:
    """How far the top of the basketball gives way under the tennis ball."""
    return b("static.both") - b("static.basketball") / 2 - b("static.tennis")


def _impulse(b: Bench) -> float:
    """Return the floor's impulse in the drop of Fig. 8, with Table II's rebound ratios."""
    lower, upper = stacks.stack_masses(b)
    speed = fallen_speed(b("fig8.drop_height"))
    kept = lower * b("tennis_on_basketball.lower") + upper * b("tennis_on_basketball.upper")
    return speed * (lower + upper + kept)


def _apart(b: Bench, restitution: float) -> Result:
    """Tennis ball on basketball as separate collisions."""
    return b.simulate(
        rigid_pair(stacks.stack_masses(b), restitution, speed=b("stack.impact_speed"))
    )


def _static_duration(b: Bench, compression: float) -> float:
    """The impact's duration with the static force over a compression in m as floor stiffness."""
    floor = b("static.force") / compression
    stiffnesses = floor, floor / b("static.stiffness_ratio")
    drop = spring_pair(stacks.stack_masses(b), stiffnesses, speed=b("stack.impact_speed"))
    return float(b.simulate(drop).last_release[0])


def _begins(b: Bench, share: float) -> float:
    """When the ball-ball force of Fig. 9 exceeds a share of its peak, in s."""
    return force_above(b.simulate(stacks.better_fit(b)), 1, share)[0]


COMPUTED: dict[str, Compute] = {
    "III.impact_speed": lambda b: fallen_speed(b("stack.drop_height")),
    "III.upper_speed": lambda b: fallen_speed(b("stack.upper_height")),
    "III.lower_speed": lambda b: fallen_speed(b("stack.lower_height")),
    "III.speed_ratio": lambda b: b("stack.upper_speed") / b("stack.impact_speed"),
    "III.energy_in": lambda b: _kinetic(
        b("basketball.mass") + b("tennis.mass"), b("stack.impact_speed")
    ),
    "III.energy_stacked": _energy_stacked,
    "III.energy_side": _energy_side,
    "III.mass_ratio": lambda b: b("basketball.mass") / b("tennis.mass"),
    "III.excess": lambda b: b("static.both") - b("static.basketball") - b("static.tennis"),
    "III.bottom": _bottom,
    "III.top": _top,
    "III.static_ratio": lambda b: (_top(b) + b("static.tennis")) / _bottom(b),
    "III.static_stiffness": lambda b: b("static.force") / b("static.tennis"),
    "III.dynamic_stiffness": lambda b: b("tennis.mass") * (pi / b("tennis.contact_time")) ** 2,
    "III.duration": lambda b: b.simulate(stacks.better_fit(b)).last_release[0],
    "III.quiet": lambda b: b.simulate(stacks.spring_record(b, b("stack.gap"))).first_touch[1],
    "III.lossless_lower": lambda b: _apart(b, b("stack.lossless")).rebound_speeds[0],
    "III.lossless_upper": lambda b: _apart(b, b("stack.lossless")).rebound_speeds[1],
    "III.lossy_lower": lambda b: _apart(b, b("stack.restitution")).rebound_speeds[0],
    "III.lossy_upper": lambda b: _apart(b, b("stack.restitution")).rebound_speeds[1],
    "III.separation": lambda b: b("stack.impact_speed") * b("stack.duration"),
    "III.static_duration": lambda b: _static_duration(b, b("static.basketball")),
    "III.fig9_lower": lambda b: b.simulate(stacks.better_fit(b)).rebound_speeds[0],
    "III.fig9_upper": lambda b: b.simulate(stacks.better_fit(b)).rebound_speeds[1],
    "III.loss_factor": lambda b: (
        b("stack.upper_speed") / b.simulate(stacks.better_fit(b)).rebound_speeds[1]
    ),
    "III.fig9_delay": lambda b: _begins(b, 0.03),
    "III.other_duration": lambda b: b.simulate(stacks.other_fit(b)).last_release[0],
    "III.other_speed": lambda b: b.simulate(stacks.other_fit(b)).rebound_speeds[0],
    "III.other_height": lambda b: risen_height(b.simulate(stacks.other_fit(b)).rebound_speeds[0]),
    "III.other_release": lambda b: b.simulate(stacks.other_fit(b)).last_release[1],
}


def _ends(fit: Callable[[Bench], Drop]) -> tuple[Compute, ...]:
    """Return readings with the end where the floor force falls to a share of its peak."""
    return (
        lambda b: force_above(b.simulate(fit(b)), 0, 0.05)[1],
        lambda b: force_above(b.simulate(fit(b)), 0, 0.1)[1],
    )


READINGS: dict[str, tuple[Compute, ...]] = {
    "III.impact_speed": (
        lambda b: fallen_speed(b("stack.drop_height") - b("basketball.diameter") / 2),
    ),
    "III.energy_stacked": (lambda b: _kinetic(b("tennis.mass"), b("stack.upper_speed")),),
    "III.static_ratio": (
        lambda b: _top(b) / _bottom(b),
        lambda b: (_top(b) + b("static.tennis") / 2) / _bottom(b),
    ),
    "III.duration": _ends(stacks.better_fit),
    "III.quiet": (
        lambda b: b.simulate(stacks.hollow_record(b, b("stack.gap"))).first_touch[1],
        lambda b: sqrt(
            2.0 * b("stack.gap") * b("basketball.mass") * b("stack.duration") / _impulse(b)
        ),
    ),
    "III.lossy_lower": (lambda b: abs(after_meeting(_apart(b, b("stack.restitution")), 1)[0]),),
    "III.static_duration": (lambda b: _static_duration(b, _bottom(b)),),
    "III.fig9_delay": (
        lambda b: _begins(b, 0.02),
        lambda b: _begins(b, 0.026),
        lambda b: _begins(b, 0.045),
        lambda b: _begins(b, 0.05),
    ),
    "III.other_duration": _ends(stacks.other_fit),
}
