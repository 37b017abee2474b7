"""The records that the explorer offers for a try: made from simulated drops, with noise."""

import stackbounce as sb
from stackbounce.measure import synthetic  # noqa: F401
from stackbounce.measure.synthetic.track import track
from stackbounce.measure.synthetic.waveform import waveform

__all__ = ["floor_force", "two_tracks"]

_BALLS = [sb.Ball(0.150, diameter=0.160, name="basketball"), sb.Ball(0.057, diameter=0.066, name="tennis")]


def floor_force() -> str:
    """Return the force below a basketball with a tennis ball on top, as a spreadsheet has it."""
    contacts = [sb.Spring(2700.0), sb.Spring(1350.0)]
    drop = sb.Drop(_BALLS, contacts, gaps=[0.0], impact_speed=3.53)
    record = waveform(drop, rate=2e4, before=4e-3, noise=0.5, seed=2007)
    rows = [f"{t:.5f},{force:.1f}" for t, force in zip(record.time.values, record.force.values)]
    return "\n".join(["Time (s),Force (N)", *rows, ""])


def two_tracks() -> str:
    """Return where both balls are in a video of 240 frames per second, as Tracker exports it."""
    contacts = [sb.Dashpot(2700.0, 4.0), sb.Dashpot(1350.0, 2.0)]
    drop = sb.Drop(_BALLS, contacts, gaps=[0.002], height=0.636, gravity=9.80665)
    seen = track(sb.simulate(drop, until=0.6), frame_rate=240, noise=5e-4, seed=2007, names=["basketball", "tennis"])
    y = seen.y.values
    rows = [
        f"{t:.6E},{0:.1E},{a + 0.08:.4E},{0:.1E},{b + 0.193:.4E},"
        for t, (a, b) in zip(seen.time.values, y)
    ]
    return "\n".join(["#multi:", ",basketball,,tennis,,", "t,x,y,x,y,", *rows, ""])
