"""The audit's checks of sections V and VI: the fits with loss, and the conclusion."""

from collections.abc import Callable

from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.checks import Compute
from stackbounce.cross2007.stacks import heavier_b1, small_fit, smallest_fit
from stackbounce.model.drop import Drop
from stackbounce.model.laws import Hysteretic
from stackbounce.run.collision import restitution

_SHORTER = 0.913
"""The factor on d/v0 in the other reading; a fall of 24 cm instead of 20 cm is equivalent."""

Fit = Callable[[Bench, float], Drop]
"""Makes a fit's drop with a mass of the large ball."""

_RATIOS: dict[str, tuple[Fit, int]] = {
    "V.B2_lower": (small_fit, 0),
    "V.B2_upper": (small_fit, 1),
    "V.B3_lower": (smallest_fit, 0),
    "V.B3_upper": (smallest_fit, 1),
}
"""The claims on a ball's rebound ratio in a fit: the fit and the ball."""


def _nearer(drop: Drop, shorter: float) -> Drop:
    """The drop with its balls closer together by a factor."""
    return drop.replace(gaps=(shorter * drop.gaps[0],))


def _rebound_ratio(fit: Fit, ball: int) -> Compute:
    return lambda b: b.simulate(fit(b, b("B1.mass"))).rebound_ratios[ball]


def _with_105(fit: Fit, ball: int, shorter: float) -> Compute:
    return lambda b: b.simulate(_nearer(fit(b, heavier_b1(b)), shorter)).rebound_ratios[ball]


def _exponent(b: Bench) -> float:
    stiffness = b("fig13.floor_stiffness")
    return Hysteretic(stiffness, restitution=b("B1.restitution")).unloading_exponent


def _restitution(b: Bench) -> float:
    return restitution(Hysteretic(b("fig13.floor_stiffness"), unloading_exponent=b("V.exponent")))


def _fitted_ratios(b: Bench) -> list[float]:
    """The ratios k1/k2 of the fits: tennis ball on basketball, B2 on B1, B3 on B1."""
    fits = ("fig9", "fig13", "B3_fit")
    return [b(f"{fit}.floor_stiffness") / b(f"{fit}.ball_stiffness") for fit in fits]


COMPUTED: dict[str, Compute] = {
    "V.exponent": _exponent,
    "V.restitution": _restitution,
    **{name: _rebound_ratio(*given) for name, given in _RATIOS.items()},
    "VI.contact": lambda b: b("stack.duration") - b("stack.delay"),
    "VI.smallest": lambda b: min(_fitted_ratios(b)),
    "VI.largest": lambda b: max(_fitted_ratios(b)),
    "VI.superballs": lambda b: sum(_fitted_ratios(b)[1:]) / 2,
}

READINGS: dict[str, tuple[Compute, ...]] = {
    name: (_with_105(*given, 1.0), _with_105(*given, _SHORTER)) for name, given in _RATIOS.items()
}
