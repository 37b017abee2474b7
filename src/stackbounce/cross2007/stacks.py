"""The paper's stacks: its pairs of balls with the contacts, speeds and gaps that it gives them."""

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.drops import Array, Two, bisect, fallen_speed, pair, spring_pair
from stackbounce.model.drop import Drop
from stackbounce.model.laws import Hertz, HollowBall, Hysteretic, Spring
from stackbounce.run.calibration import calibrate
from stackbounce.run.collision import contact_time

_HOLLOW = 0.026, 700.0  # s and N/m, where the search for the hollow ball's numbers begins
_CLOSE = 1e-12  # relative error of these numbers


def stack_masses(b: Bench) -> Two:
    """Return the masses of basketball and tennis ball in kg."""
    return b("basketball.mass"), b("tennis.mass")


def section_two(b: Bench, ratio: float, stiffness: float) -> Drop:
    """Return section II's drop for two ratios, with Fig. 5's upper mass and upper spring."""
    upper, spring = b("fig5.upper_mass"), b("fig5.ball_stiffness")
    masses, springs = (ratio * upper, upper), (stiffness * spring, spring)
    return spring_pair(masses, springs, speed=b("models.speed"))


def _springs(b: Bench, fit: str) -> Two:
    """Return the stiffnesses at the floor and between the balls of one of the paper's fits."""
    return b(f"{fit}floor_stiffness"), b(f"{fit}ball_stiffness")


def figure_5(b: Bench) -> Drop:
    """Return the drop of Fig. 5."""
    masses, springs = (b("fig5.lower_mass"), b("fig5.upper_mass")), _springs(b, "fig5.")
    return spring_pair(masses, springs, speed=b("models.speed"))


def better_fit(b: Bench) -> Drop:
    """Return the drop of Fig. 9."""
    return spring_pair(stack_masses(b), _springs(b, "fig9."), speed=b("stack.impact_speed"))


def other_fit(b: Bench) -> Drop:
    """Return the alternative fit that the text describes beside Fig. 9."""
    return spring_pair(stack_masses(b), _springs(b, "fig9.other_"), speed=b("stack.impact_speed"))


def spring_record(b: Bench, gap: float = 0.0) -> Drop:
    """Return the drop of Fig. 8 on Fig. 9's springs, with a gap in m."""
    springs, speed = _springs(b, "fig9."), fallen_speed(b("fig8.drop_height"))
    return spring_pair(stack_masses(b), springs, speed=speed, gap=gap)


def hollow_record(b: Bench, gap: float = 0.0) -> Drop:
    """Return the drop of Fig. 8 with a hollow ball at the floor, with a gap in m."""
    return replace(hollow_pair(b), impact_speed=fallen_speed(b("fig8.drop_height")), gaps=(gap,))


def hollow_pair(b: Bench) -> Drop:
    """Return the tennis ball on a hollow ball, with a spring between them.

    The hollow ball has the restitution of the basketball alone, and buckles as `calibrate` assumes.
    Its contact time and the spring are those with which it leaves with Table II's v1/v0, while its
    floor force in the drop of Fig. 8 lasts as long as measured.
    """
    from scipy.optimize import fsolve

    alone = _calibrate_hollow(math.sqrt(b("basketball.rebound_height") / b("stack.drop_height")))
    speed, recorded = b("stack.impact_speed"), fallen_speed(b("fig8.drop_height"))
    ratio, duration = b("tennis_on_basketball.lower"), b("stack.duration")

    def solved(factors: Array) -> Drop:
        time, stiffness = (factors * _HOLLOW).tolist()
        floor = replace(
            alone,
            stiffness=alone.stiffness * b("basketball.mass") / time**2,
            buckling_compression=alone.buckling_compression * speed * time,
        )
        return pair(stack_masses(b), [floor, Spring(stiffness)], speed=speed)

    def misses(factors: Array) -> list[float]:
        drop = solved(factors)
        record = b.simulate(replace(drop, impact_speed=recorded))
        lower = float(b.simulate(drop).rebound_ratios[0])
        return [lower - ratio, float(record.last_release[0]) / duration - 1.0]

    return solved(fsolve(misses, np.ones(2), xtol=_CLOSE))


@lru_cache(maxsize=64)
def _calibrate_hollow(restitution: float) -> HollowBall:
    """Return a hollow ball of mass, contact time and impact speed 1; others follow by scaling."""
    return calibrate(
        HollowBall, mass=1.0, contact_time=1.0, restitution=restitution, impact_speed=1.0
    )


def heavier_b1(bench: Bench) -> float:
    """Return the mass in kg of the heavier of the two balls B1.

    Table II gives 1.040 for the mass ratio of two balls that share the name B1. If the 101 g of
    Table I are the mass of the lighter one, the heavier one has 105 g.
    """
    return bench("B1_on_B1.mass_ratio") * bench("B1.mass")


def superball_speed(bench: Bench) -> float:
    """Return the superballs' impact speed in m/s, after their fall of about 20 cm."""
    return fallen_speed(bench("superballs.drop_height"))


def gap_for_delay(bench: Bench, drop: Drop, delay: float) -> float:
    """Return the gap in m for which two balls touch `delay` s after the first floor contact.

    Until then the upper ball moves with constant velocity and the lower one bounces alone.
    """
    speed = drop.reference_speed
    alone = bench.simulate(Drop(drop.balls[:1], drop.contacts[:1], impact_speed=speed))
    return speed * delay + float(alone.rerun([delay]).samples.position[0])


def small_fit(bench: Bench, heavy: float) -> Drop:
    """Return section V's drop of B2 on B1, the fit of Fig. 13, with a mass for B1 in kg."""
    return _section_v(bench, "fig13", heavy, "B2")


def smallest_fit(bench: Bench, heavy: float) -> Drop:
    """Return section V's drop of B3 on B1, with a mass for B1 in kg."""
    return _section_v(bench, "B3_fit", heavy, "B3")


def _section_v(bench: Bench, fit: str, heavy: float, upper: str) -> Drop:
    """Return a drop on B1 that loses energy at the floor and none between the balls."""
    below, between = _springs(bench, f"{fit}.")
    speed, gap = superball_speed(bench), bench(f"{fit}.gap")
    masses = heavy, bench(f"{upper}.mass")
    floor = Hysteretic(below, unloading_exponent=bench("V.exponent"))
    return pair(masses, [floor, Spring(between)], speed=speed, gap=gap)


def reversed_pair(bench: Bench, gap: float) -> Drop:
    """Return B1 on B2, no loss: B2's dynamic stiffness below, Fig. 13's between the balls."""
    stiffnesses = bench("B2.dynamic_stiffness"), bench("fig13.ball_stiffness")
    masses = bench("B2.mass"), bench("B1.mass")
    return spring_pair(masses, stiffnesses, speed=superball_speed(bench), gap=gap)


def late_pair(bench: Bench) -> Drop:
    """Return B1 on B3 without loss, with the gap for which they touch after the measured 7 ms."""
    return _reversed_smallest(bench, "superballs.late_delay")


def early_pair(bench: Bench) -> Drop:
    """Return the same pair with the gap for the shortest measured delay, 2 ms."""
    return _reversed_smallest(bench, "superballs.delay")


def _reversed_smallest(bench: Bench, delay: str) -> Drop:
    stiffnesses = bench("B3.dynamic_stiffness"), bench("B3_fit.ball_stiffness")
    masses = bench("B3.mass"), bench("B1.mass")
    drop = spring_pair(masses, stiffnesses, speed=superball_speed(bench))
    return replace(drop, gaps=(gap_for_delay(bench, drop, bench(delay)),))


def twin_pair(bench: Bench, gap: float) -> Drop:
    """Return B1 on B1 without loss: two equal springs in series between the balls."""
    floor = bench("B1.dynamic_stiffness")
    masses = heavier_b1(bench), bench("B1.mass")
    return spring_pair(masses, (floor, floor / 2), speed=superball_speed(bench), gap=gap)


def early_twins(bench: Bench) -> Drop:
    """Return two large balls with the gap for the shortest delay that the text reports, 1 ms."""
    gap = gap_for_delay(bench, twin_pair(bench, 0.0), bench("superballs.twin_delay"))
    return twin_pair(bench, gap)


def late_twins(bench: Bench) -> Drop:
    """Return two large balls with the gap for which the floor contact ends after 12 ms."""

    def late(gap: float) -> float:
        end = float(bench.simulate(twin_pair(bench, gap)).last_release[0])
        return end - bench("superballs.twin_duration")

    return twin_pair(bench, bisect(late, 2e-3, 2e-2))


def parted_twins(bench: Bench) -> Drop:
    """Return two large balls that touch at the moment when the lower one leaves the floor."""
    lower, floor = twin_pair(bench, 0.0).balls[0], twin_pair(bench, 0.0).contacts[0]
    speed = superball_speed(bench)
    bounce = bench.simulate(Drop([lower], [floor], impact_speed=speed)).end_time
    return twin_pair(bench, speed * bounce)


def stiffen(drop: Drop) -> Drop:
    """Return a drop of two balls with each spring replaced by Hertz's law, F = k c**1.5.

    Each new contact has the contact time of the old one, for the lower ball alone on the floor and
    for a collision of the two balls, at the drop's impact speed.
    """
    speed = drop.reference_speed
    lower, upper = (ball.mass for ball in drop.balls)
    laws = []
    for mass, spring in zip((lower, lower * upper / (lower + upper)), drop.contacts, strict=True):
        assert spring is not None
        time = contact_time(spring, mass)
        laws.append(calibrate(Hertz, mass=mass, contact_time=time, impact_speed=speed))
    return replace(drop, contacts=laws)
