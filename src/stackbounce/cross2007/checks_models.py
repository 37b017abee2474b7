"""The audit's checks of sections I and II: the usual explanation and the two models."""

import numpy as np

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.checks import Number, Section
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

INTRODUCTION = Section("Sec. I")
MODELS = Section("Sec. II")


def _lossless(b: Bench, masses: Two) -> Result:
    """Separate collisions of two balls without loss."""
    return b.simulate(rigid_pair(masses, b("textbook.restitution")))


def _usual(b: Bench) -> Result:
    """The usual explanation: a light ball on a much heavier one, no loss."""
    return _lossless(b, (b("textbook.mass_ratio"), 1.0))


@INTRODUCTION.check("I.relative", "speed at which the two balls meet, over v", "2")
def _(b: Bench) -> Number:
    bounced = _usual(b).events[0]["upper_velocity"]
    return bounced - _usual(b).drop.start_velocities[1]


@INTRODUCTION.check(
    "I.speed",
    "upper ball's rebound speed over v, lower ball much heavier",
    "3",
    reason="Holds for a very heavy lower ball only; the paper's basketball is 2.63 times heavier.",
)
def _(b: Bench) -> Number:
    return _usual(b).rebound_ratios[1]


INTRODUCTION.other(
    "basketball and tennis ball, no loss",
    lambda b: b.simulate(rigid_pair(stack_masses(b), b("textbook.restitution"))).rebound_ratios[1],
)


@INTRODUCTION.check("I.height", "its bounce height over the drop height", "9")
def _(b: Bench) -> Number:
    return _usual(b).rebound_ratios[1] ** 2


@INTRODUCTION.check(
    "I.tennis_height",
    "tennis ball's bounce off the floor over its drop height",
    "0.55",
    reason="The printed number is a usual value, 'about 0.55'; section III's one bounce is 2 % "
    "higher. If both heights were measured to the ball's centre, a guess, the ratio is closer.",
)
def _(b: Bench) -> Number:
    return b("tennis.rebound_height") / b("stack.drop_height")


def _height_ratio_of_centre(b: Bench) -> float:
    radius = b("tennis.diameter") / 2
    return (b("tennis.rebound_height") - radius) / (b("stack.drop_height") - radius)


INTRODUCTION.other("with both heights measured to the ball's centre", _height_ratio_of_centre)


@INTRODUCTION.check("I.gain", "its energy over that after a bounce off the floor", "16")
def _(b: Bench) -> Number:
    return _usual(b).rebound_ratios[1] ** 2 / b("tennis.height_ratio")


@INTRODUCTION.check("I.actual", "measured rebound speed over v, to the nearest whole number", "2")
def _(b: Bench) -> Number:
    return b("stack.upper_speed") / b("stack.impact_speed")


def _stopping_ratio(b: Bench, restitution: float) -> float:
    """The mass ratio at which the ball-ball collision stops the lower ball."""

    def lower(ratio: float) -> float:
        return after_meeting(b.simulate(rigid_pair((ratio, 1.0), restitution)), 1)[0]

    return bisect(lower, 1.0, 10.0)


@MODELS.check("II.stop", "m1/m2 at which the lower mass stops, e = 1", "3")
def _(b: Bench) -> Number:
    return _stopping_ratio(b, b("models.lossless"))


@MODELS.check("II.stop_lossy", "m1/m2 at which the lower mass stops, e = 0.8", "3.05")
def _(b: Bench) -> Number:
    return _stopping_ratio(b, b("models.restitution"))


@MODELS.check("II.all_energy", "v2/v0 where the lower mass stops, e = 1", "2")
def _(b: Bench) -> Number:
    ratio = _stopping_ratio(b, b("models.lossless"))
    return b.simulate(rigid_pair((ratio, 1.0), b("models.lossless"))).rebound_ratios[1]


@MODELS.check(
    "II.energy_share", "share of the initial energy that m2 then has, e = 1", "all", number="1.0"
)
def _(b: Bench) -> Number:
    ratio = _stopping_ratio(b, b("models.lossless"))
    upper = b.simulate(rigid_pair((ratio, 1.0), b("models.lossless"))).rebound_ratios[1]
    return upper**2 / (ratio + 1.0)


def _heavy(b: Bench) -> Result:
    """A lower mass that is much heavier, with loss."""
    return b.simulate(rigid_pair((b("textbook.mass_ratio"), 1.0), b("models.restitution")))


@MODELS.check("II.heavy_upper", "v2/v0 for m1 >> m2, at e = 0.8", "e(2+e)", number="2.24")
def _(b: Bench) -> Number:
    return _heavy(b).rebound_ratios[1]


@MODELS.check("II.heavy_lower", "v1/v0 for m1 >> m2, at e = 0.8", "e", number="0.8")
def _(b: Bench) -> Number:
    return _heavy(b).rebound_ratios[0]


_CUT = (
    "In general the paper does not cut off digits: it rounds 1.1886, 2.636, 6.366 and 1.127 to "
    "1.19, 2.64, 6.37 and 1.13."
)


def _second_stop(b: Bench, restitution: float) -> float:
    """The mass ratio at which the second ball-ball collision stops the lower ball."""

    def lower(ratio: float) -> float:
        return after_meeting(b.simulate(rigid_pair((ratio, 1.0), restitution)), 2)[0]

    return bisect(lower, 0.35, 0.95)


@MODELS.check(
    "II.second_stop",
    "m1/m2 at which the second ball-ball collision stops the lower mass",
    "0.52",
    where="Sec. II, Fig. 2b",
    reason="For e = 1 the exact value is 5 - sqrt(20); for e = 0.8 it is another. With its third "
    "digit cut off it is the printed one. " + _CUT,
)
def _(b: Bench) -> Number:
    return _second_stop(b, b("models.lossless"))


MODELS.other(
    "cut off after two digits, not rounded",
    lambda b: truncate(_second_stop(b, b("models.lossless")), 2),
)
MODELS.other("e = 0.8", lambda b: _second_stop(b, b("models.restitution")))


def _more_meetings(b: Bench, restitution: float, count: int) -> float:
    """The mass ratio below which the balls collide at least `count` times."""

    def missing(ratio: float) -> float:
        met = int(b.simulate(rigid_pair((ratio, 1.0), restitution)).collisions[1])
        return count - 0.5 - met

    return bisect(missing, 0.1, 10.0)


@MODELS.check(
    "II.second_collision",
    "m1/m2 below which a second ball-ball collision arises, e = 1",
    "m1 < m2",
    number="1",
    reason="Exact for e = 1. With e = 0.8 the threshold is a little higher; the text does not say "
    "so.",
)
def _(b: Bench) -> Number:
    return _more_meetings(b, b("models.lossless"), 2)


MODELS.other("e = 0.8", lambda b: _more_meetings(b, b("models.restitution"), 2))


@MODELS.check(
    "II.third_collision",
    "m1/m2 below which more than two ball-ball collisions arise",
    "4",
    reason="With m1 = 4 m2 the lower mass is not even stopped, and the balls collide once. In the "
    "text at hand the number stands at a page break, where it may have lost its beginning: 0.4 "
    "would be near, but is not what comes out. The thresholds are 1/3 (e = 1) and 0.35 (e = 0.8), "
    "and 0.35 meets 0.4 only at the very edge of rounding.",
)
def _(b: Bench) -> Number:
    return _more_meetings(b, b("models.lossless"), 3)


MODELS.other(
    "e = 1, against 0.4 m2", lambda b: _more_meetings(b, b("models.lossless"), 3), number="0.4"
)
MODELS.other(
    "e = 0.8, against 0.4 m2", lambda b: _more_meetings(b, b("models.restitution"), 3), number="0.4"
)


def _fig5(b: Bench) -> Result:
    masses = b("fig5.lower_mass"), b("fig5.upper_mass")
    stiffnesses = b("fig5.floor_stiffness"), b("fig5.ball_stiffness")
    return b.simulate(spring_pair(masses, stiffnesses))


@MODELS.check("II.fig5_mass_ratio", "r_m of Fig. 5", "2", where="Sec. II, Fig. 5")
def _(b: Bench) -> Number:
    return b("fig5.lower_mass") / b("fig5.upper_mass")


@MODELS.check("II.fig5_stiffness_ratio", "r_k of Fig. 5", "20", where="Sec. II, Fig. 5")
def _(b: Bench) -> Number:
    return b("fig5.floor_stiffness") / b("fig5.ball_stiffness")


@MODELS.check(
    "II.fig5_floor",
    "end of the first part, in which the lower mass bounces off the end stop",
    "5",
    "ms",
    where="Sec. II, Fig. 5",
    reason="The lower mass leaves the end stop later than that, and the ball-ball contact is "
    "closed from the start, so that no event marks 5 ms. It is about where the upper mass begins "
    "to slow down visibly, which is how the text describes the moment; how much is visible is "
    "our choice, and the thresholds of a tenth and a third were chosen to fit.",
)
def _(b: Bench) -> Number:
    return _fig5(b).intervals[0]["end"]


def _slowed(b: Bench, share: float) -> float:
    """When the upper mass of Fig. 5 has lost a share of its speed, in s."""
    times = np.linspace(0.0, _fig5(b).intervals[0]["end"], 401)
    velocity = _fig5(b).sample(times)["velocity"].isel(ball=1)
    return float(np.interp(share - 1.0, velocity, times))


MODELS.other("when the upper mass has lost a twentieth of its speed", lambda b: _slowed(b, 0.05))
MODELS.other("when it has lost a tenth", lambda b: _slowed(b, 0.1))
MODELS.other("when it has lost a fifth", lambda b: _slowed(b, 0.2))
MODELS.other(
    "when the ball-ball force exceeds a third of its peak",
    lambda b: force_above(_fig5(b), 1, 1.0 / 3.0)[0],
)
MODELS.other("when it exceeds half of its peak", lambda b: force_above(_fig5(b), 1, 0.5)[0])


@MODELS.check(
    "II.fig5_slow", "end of the slow ball-ball collision", "19", "ms", where="Sec. II, Fig. 5"
)
def _(b: Bench) -> Number:
    return _fig5(b).last_release[1]


@MODELS.check(
    "II.fig5_return", "start of the second end-stop collision", "29", "ms", where="Sec. II, Fig. 5"
)
def _(b: Bench) -> Number:
    floor = _fig5(b).intervals[_fig5(b).intervals["contact"] == 0]
    return floor[1]["start"]


@MODELS.check(
    "II.fig5_floor_count",
    "collisions of the lower mass with the end stop",
    "two",
    number="2",
    counted=True,
    where="Sec. II, Fig. 5",
)
def _(b: Bench) -> Number:
    return _fig5(b).collisions[0]


@MODELS.check(
    "II.fig5_ball_count",
    "collisions of the two masses (the lower one does not catch up)",
    "a",
    number="1",
    counted=True,
    where="Sec. II, Fig. 5",
)
def _(b: Bench) -> Number:
    return _fig5(b).collisions[1]


def _simplest(b: Bench) -> Drop:
    """Equal masses on equal springs."""
    equal = b("models.equal")
    return spring_pair((equal, 1.0), (equal, 1.0), speed=b("models.speed"))


@MODELS.check("II.equal_first", "equal masses apart: m1 off the end stop", "1", "m/s")
def _(b: Bench) -> Number:
    return b.simulate(separate(_simplest(b))).events[0]["upper_velocity"]


@MODELS.check("II.equal_second", "equal masses apart: m1 off m2, backward", "1", "m/s")
def _(b: Bench) -> Number:
    return -b.simulate(separate(_simplest(b))).events[1]["lower_velocity"]


@MODELS.check("II.equal_third", "equal masses apart: m1 off the end stop again", "1", "m/s")
def _(b: Bench) -> Number:
    return b.simulate(separate(_simplest(b))).rebound_speeds[0]


@MODELS.check("II.equal_upper", "equal masses apart: m2 off m1", "1", "m/s")
def _(b: Bench) -> Number:
    return b.simulate(separate(_simplest(b))).rebound_speeds[1]


@MODELS.check("II.spring_upper", "equal masses and springs: m2", "1.19", "m/s")
def _(b: Bench) -> Number:
    return b.simulate(_simplest(b)).rebound_speeds[1]


@MODELS.check(
    "II.spring_lower",
    "equal masses and springs: m1",
    "0.76",
    "m/s",
    reason="0.766 rounds to 0.77; cut off, as 0.528 to 0.52, it is the printed number. " + _CUT,
)
def _(b: Bench) -> Number:
    return b.simulate(_simplest(b)).rebound_speeds[0]


MODELS.other(
    "cut off after two digits, not rounded",
    lambda b: truncate(b.simulate(_simplest(b)).rebound_speeds[0], 2),
)


def _ten(b: Bench) -> Drop:
    """Ten times the mass on equal springs."""
    return spring_pair((b("models.mass_ratio"), 1.0), (b("models.stiffness_ratio"), 1.0))


@MODELS.check("II.ten_apart", "v2/v0, m1/m2 = 10, separate collisions", "2.64")
def _(b: Bench) -> Number:
    return b.simulate(separate(_ten(b))).rebound_ratios[1]


@MODELS.check("II.ten_springs", "v2/v0, r_m = 10, r_k = 1, springs", "1.13")
def _(b: Bench) -> Number:
    return b.simulate(_ten(b)).rebound_ratios[1]
