"""The records that the explorer offers for a try: made from simulated drops, with noise."""

import stackbounce as sb
from synthetic.track import track
from synthetic.waveform import waveform

_BALLS = [
    sb.Ball(0.150, diameter=0.160, name="basketball"),
    sb.Ball(0.057, diameter=0.066, name="tennis"),
]


def floor_force() -> str:
    """Return the force below a basketball with a tennis ball on top, as a spreadsheet has it."""
    drop = sb.Drop(_BALLS, [sb.Spring(2700.0), sb.Spring(1350.0)], gaps=[0.0], impact_speed=3.53)
    record = waveform(drop, rate=2e4, before=4e-3, noise=0.5, seed=2007)
    rows = [
        f"{t:.5f},{force:.1f}"
        for t, force in zip(record.time.values, record.force.values, strict=True)
    ]
    return "\n".join(["Time (s),Force (N)", *rows, ""])


def two_tracks() -> str:
    """Return where both balls are in a video of 120 frames per second, as Tracker exports it."""
    balls = [sb.Ball(0.101, diameter=0.058, name="B1"), sb.Ball(0.0248, diameter=0.038, name="B2")]
    contacts = [sb.Dashpot(54e3, 8.0), sb.Dashpot(24e3, 2.0)]
    drop = sb.Drop(balls, contacts, gaps=[0.0], height=1.0, gravity=9.80665)
    seen = track(sb.simulate(drop, until=0.34), frame_rate=120, noise=4e-3, seed=2007)
    rows = [
        f"{t:.6E},0.0E0,{lower + 0.029:.4E},0.0E0,{upper + 0.077:.4E},"
        for t, (lower, upper) in zip(seen.time.values, seen.y.values, strict=True)
    ]
    return "\n".join(["#multi:", ",B1,,B2,,", "t,x,y,x,y,", *rows, ""])
