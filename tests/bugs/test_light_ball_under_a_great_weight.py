"""A very large static compression under a heavy ball cost the first microns their digits."""

import numpy as np

import stackbounce as sb


def test_light_ball_under_a_great_weight():
    mass, gravity = 7680.765321260328, 14978.377780237126
    drop = sb.Drop(
        [sb.Ball(1.566e-06), sb.Ball(mass)],
        [sb.Spring(493506.0), sb.Spring(2632.0)],
        velocities=[-3.53, -3.53],
        gravity=gravity,
    )
    result = sb.simulate(drop, until=0.0005)
    motion = result.sample(np.linspace(0.0, 0.0005, 400))
    height = mass * gravity * np.abs(motion.position.values).max()
    assert np.ptp(motion.energy.values) < 1e-14 * height + 1e-13 * motion.energy.values[0]
