"""Press curves: how often the error bars of stiffness, exponent and loss cover the truth."""

from collections.abc import Callable
from typing import Any

from uncertainties import UFloat

import stackbounce as sb
from stackbounce.measure import press, split_series
from synthetic.press import press_record

__all__ = ["CASES"]

Trial = list[tuple[str, UFloat, float]]

BALL = sb.Hysteretic(4e4, exponent=1.3, restitution=0.78)
LINEAR = sb.Hysteretic(1e4, restitution=0.85)
PEAK = 5e-3


def _truth(law: Any, peak: float) -> dict[str, float]:
    """Return what a noiseless press would find."""
    p, n = law.exponent, getattr(law, "unloading_exponent", law.exponent)
    top = law.stiffness * peak**p
    return {
        "stiffness": law.stiffness,
        "exponent": p,
        "peak_compression": peak,
        "peak_force": top,
        "work_in": top * peak / (p + 1.0),
        "work_out": top * peak / (n + 1.0),
        "restitution": ((p + 1.0) / (n + 1.0)) ** 0.5,
        "unloading_exponent": n,
        "energy_exponent": n,
        "tangent_stiffness": p * top / peak,
        "secant_stiffness": top / peak,
        "contact": 0.0,
        "linear_stiffness": 3.0 / (p + 2.0) * top / peak,
    }


def _case(law: Any, names: str, **how: Any) -> Callable[[int], Trial]:
    """Return a trial that presses a law and compares what is found with what went in."""
    own = {"peak": PEAK, "points": 300, "slack": 1e-3} | how
    truth = _truth(law, own["peak"])

    def trial(seed: int) -> Trial:
        found = press(press_record(law, seed=seed, **own))
        return [(name, getattr(found, name), truth[name]) for name in names.split()]

    return trial


_ALL = (
    "stiffness exponent linear_stiffness tangent_stiffness peak_compression peak_force work_in "
    "work_out restitution unloading_exponent energy_exponent contact"
)


def _series(seed: int) -> Trial:
    """Press two balls alone and one on the other, and split the compression."""
    lower, upper = sb.PowerLaw(4e3, 1.2), sb.PowerLaw(3e4, 1.1)
    both = sb.PowerLaw(2.3e3, 1.2)
    truth = [(30.0 / law.stiffness) ** (1.0 / law.exponent) for law in (lower, upper, both)]
    ends = [(32.0 / law.stiffness) ** (1.0 / law.exponent) for law in (lower, upper, both)]
    found = [
        press(
            press_record(
                law, peak=end, points=200, slack=0.1 * end, noise=0.15, seed=3 * seed + i
            ).isel(point=slice(0, 100))  # the way in
        )
        for i, (law, end) in enumerate(zip((lower, upper, both), ends, strict=True))
    ]
    split = split_series(*(one.compression_at(30.0) for one in found), force=30.0)
    bottom = truth[0] / 2.0
    between = truth[2] - bottom - truth[1] / 2.0
    return [
        ("top", split.top, truth[2] - bottom - truth[1]),
        ("ratio", split.ratio, between / bottom),
        ("ball_stiffness", split.ball_stiffness, 30.0 / between),
    ]


CASES: dict[str, Callable[[int], Trial]] = {
    "white noise": _case(BALL, _ALL, noise=0.15),
    "no slack": _case(
        BALL, "stiffness exponent restitution energy_exponent", slack=0.0, noise=0.15
    ),
    "a straight line": _case(LINEAR, _ALL, noise=0.3),
    "noise of both": _case(BALL, _ALL, noise=0.1, jitter=10e-6),
    "noise that remembers": _case(
        BALL,
        "stiffness exponent linear_stiffness work_in restitution",
        noise=0.1,
        memory=4.0,
        points=900,
    ),
    "a drifting zero": _case(
        BALL, "stiffness exponent linear_stiffness work_in restitution", noise=0.1, drift=2.0
    ),
    "coarse digits": _case(
        BALL, "stiffness exponent linear_stiffness work_in restitution", noise=0.1, force_step=0.2
    ),
    "an exponent of 3": _case(
        sb.PowerLaw(3e8, 3.0), "stiffness exponent work_in work_out contact", noise=0.1
    ),
    "two in series": _series,
}
