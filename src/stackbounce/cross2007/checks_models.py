"""The audit's checks of sections I and II: the usual explanation and the two models."""

import numpy as np

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.checks import Compute
from stackbounce.cross2007.drops import (
    Two,
    after_meeting,
    bisect,
    force_above,
    rigid_pair,
    spring_pair,
    truncate,
)
from stackbounce.cross2007.stacks import stack_masses
from stackbounce.model.drop import Drop
from stackbounce.run.collision import separate
from stackbounce.run.result import Result


def _lossless(b: Bench, masses: Two) -> Result:
    """Separate collisions of two balls without loss."""
    return b.simulate(rigid_pair(masses, b("textbook.restitution")))


def _usual(b: Bench) -> Result:
    """The usual explanation: a light ball on a much heavier one, no loss."""
    return _lossless(b, (b("textbook.mass_ratio"), 1.0))


def _height_ratio_of_centre(b: Bench) -> float:
    radius = b("tennis.diameter") / 2
    return (b("tennis.rebound_height") - radius) / (b("stack.drop_height") - radius)


def _stopping_ratio(b: Bench, restitution: float, count: int = 1) -> float:
    """The mass ratio at which the ball-ball collision of that number stops the lower ball."""

    def lower(ratio: float) -> float:
        return after_meeting(b.simulate(rigid_pair((ratio, 1.0), restitution)), count)[0]

    return bisect(lower, *((1.0, 10.0) if count == 1 else (0.35, 0.95)))


def _where_it_stops(b: Bench) -> Result:
    """Separate collisions without loss, of which the first ball-ball one stops the lower ball."""
    ratio = _stopping_ratio(b, b("models.lossless"))
    return b.simulate(rigid_pair((ratio, 1.0), b("models.lossless")))


def _energy_share(b: Bench) -> float:
    stopped = _where_it_stops(b)
    ratio = stopped.drop.balls[0].mass
    return float(stopped.rebound_ratios[1] ** 2 / (ratio + 1.0))


def _heavy(b: Bench) -> Result:
    """A lower mass that is much heavier, with loss."""
    return b.simulate(rigid_pair((b("textbook.mass_ratio"), 1.0), b("models.restitution")))


def _more_meetings(b: Bench, restitution: float, count: int) -> float:
    """The mass ratio below which the balls collide at least `count` times."""

    def missing(ratio: float) -> float:
        met = int(b.simulate(rigid_pair((ratio, 1.0), restitution)).collisions[1])
        return count - 0.5 - met

    return bisect(missing, 0.1, 10.0)


def _fig5(b: Bench) -> Result:
    masses = b("fig5.lower_mass"), b("fig5.upper_mass")
    return b.simulate(spring_pair(masses, (b("fig5.floor_stiffness"), b("fig5.ball_stiffness"))))


def _second_start(result: Result) -> float:
    """When the lower mass meets the end stop again, in s."""
    floor = result.intervals[result.intervals["contact"] == 0]
    return float(floor[1]["start"])


def _slowed(b: Bench, share: float) -> float:
    """When the upper mass of Fig. 5 has lost a share of its speed, in s."""
    times = np.linspace(0.0, _fig5(b).intervals[0]["end"], 401)
    velocity = _fig5(b).sample(times)["velocity"].isel(ball=1)
    return float(np.interp(share - 1.0, velocity, times))


def _simplest(b: Bench) -> Drop:
    """Equal masses on equal springs."""
    equal = b("models.equal")
    return spring_pair((equal, 1.0), (equal, 1.0), speed=b("models.speed"))


def _apart(b: Bench) -> Result:
    """Equal masses as separate collisions."""
    return b.simulate(separate(_simplest(b)))


def _ten(b: Bench) -> Drop:
    """Ten times the mass on equal springs."""
    return spring_pair((b("models.mass_ratio"), 1.0), (b("models.stiffness_ratio"), 1.0))


COMPUTED: dict[str, Compute] = {
    "I.relative": lambda b: _usual(b).events[0]["upper_velocity"] + _usual(b).drop.reference_speed,
    "I.speed": lambda b: _usual(b).rebound_ratios[1],
    "I.height": lambda b: _usual(b).rebound_ratios[1] ** 2,
    "I.tennis_height": lambda b: b("tennis.rebound_height") / b("stack.drop_height"),
    "I.gain": lambda b: _usual(b).rebound_ratios[1] ** 2 / b("tennis.height_ratio"),
    "I.actual": lambda b: b("stack.upper_speed") / b("stack.impact_speed"),
    "II.stop": lambda b: _stopping_ratio(b, b("models.lossless")),
    "II.stop_lossy": lambda b: _stopping_ratio(b, b("models.restitution")),
    "II.all_energy": lambda b: _where_it_stops(b).rebound_ratios[1],
    "II.energy_share": _energy_share,
    "II.heavy_upper": lambda b: _heavy(b).rebound_ratios[1],
    "II.heavy_lower": lambda b: _heavy(b).rebound_ratios[0],
    "II.second_stop": lambda b: _stopping_ratio(b, b("models.lossless"), 2),
    "II.second_collision": lambda b: _more_meetings(b, b("models.lossless"), 2),
    "II.third_collision": lambda b: _more_meetings(b, b("models.lossless"), 3),
    "II.fig5_mass_ratio": lambda b: b("fig5.lower_mass") / b("fig5.upper_mass"),
    "II.fig5_stiffness_ratio": lambda b: b("fig5.floor_stiffness") / b("fig5.ball_stiffness"),
    "II.fig5_floor": lambda b: _fig5(b).intervals[0]["end"],
    "II.fig5_slow": lambda b: _fig5(b).last_release[1],
    "II.fig5_return": lambda b: _second_start(_fig5(b)),
    "II.fig5_floor_count": lambda b: _fig5(b).collisions[0],
    "II.fig5_ball_count": lambda b: _fig5(b).collisions[1],
    "II.equal_first": lambda b: _apart(b).events[0]["upper_velocity"],
    "II.equal_second": lambda b: -_apart(b).events[1]["lower_velocity"],
    "II.equal_third": lambda b: _apart(b).rebound_speeds[0],
    "II.equal_upper": lambda b: _apart(b).rebound_speeds[1],
    "II.spring_upper": lambda b: b.simulate(_simplest(b)).rebound_speeds[1],
    "II.spring_lower": lambda b: b.simulate(_simplest(b)).rebound_speeds[0],
    "II.ten_apart": lambda b: b.simulate(separate(_ten(b))).rebound_ratios[1],
    "II.ten_springs": lambda b: b.simulate(_ten(b)).rebound_ratios[1],
}

READINGS: dict[str, tuple[Compute, ...]] = {
    "I.speed": (lambda b: _lossless(b, stack_masses(b)).rebound_ratios[1],),
    "I.tennis_height": (_height_ratio_of_centre,),
    "II.second_stop": (
        lambda b: truncate(_stopping_ratio(b, b("models.lossless"), 2), 2),
        lambda b: _stopping_ratio(b, b("models.restitution"), 2),
    ),
    "II.second_collision": (lambda b: _more_meetings(b, b("models.restitution"), 2),),
    "II.third_collision": (
        lambda b: _more_meetings(b, b("models.lossless"), 3),
        lambda b: _more_meetings(b, b("models.restitution"), 3),
    ),
    "II.fig5_floor": (
        lambda b: _slowed(b, 0.05),
        lambda b: _slowed(b, 0.1),
        lambda b: _slowed(b, 0.2),
        lambda b: force_above(_fig5(b), 1, 1.0 / 3.0)[0],
        lambda b: force_above(_fig5(b), 1, 0.5)[0],
    ),
    "II.spring_lower": (lambda b: truncate(b.simulate(_simplest(b)).rebound_speeds[0], 2),),
}
