"""Any cluster with a contact that is not linear: the power series of its motion, step by step.

Inside a phase of every contact the motion is analytic, so its own Taylor series is integrator,
dense output and event search in one. Order by order: forces from compressions, accelerations from
forces, velocities and compressions from accelerations. The step is the time for which the last two
terms of every velocity stay below the tolerance (Jorba and Zou, Exp. Math. 14, 99, 2005).
"""

from stackbounce.engine.kernel import kernel
from stackbounce.engine.series import ORDER, TERMS, power_term
from stackbounce.engine.stack import Stack


@kernel
def expand(stack: Stack, low: int, high: int) -> float:
    """Expand the motion of the cluster with closed contacts low..high-1; return the safe step."""
    bottom = max(low - 1, 0)
    for i in range(low, high):
        stack.compression_series[i * TERMS] = stack.compression[i]
    for b in range(bottom, high):
        stack.velocity_series[b * TERMS] = stack.velocity[b]
    for k in range(ORDER + 1):
        for i in range(low, high):
            stack.force_series[i * TERMS + k] = _force_term(stack, i, k)
        for b in range(bottom, high):
            net = 0.0
            if b >= low:
                net += stack.force_series[b * TERMS + k]
            if b + 1 < high:
                net -= stack.force_series[(b + 1) * TERMS + k]
            acceleration = net / stack.mass[b]
            if k == 0:
                acceleration -= stack.number[0]
            stack.velocity_series[b * TERMS + k + 1] = acceleration / (k + 1)
        for i in range(low, high):
            below = stack.velocity_series[(i - 1) * TERMS + k] if i > 0 else 0.0
            above = stack.velocity_series[i * TERMS + k]
            stack.compression_series[i * TERMS + k + 1] = (below - above) / (k + 1)
    step = 0.0
    for i in range(low, high):
        step = max(step, 100.0 * stack.scale[i] / stack.number[1])
    for b in range(bottom, high):
        for k in range(ORDER - 1, ORDER + 1):
            size = abs(stack.velocity_series[b * TERMS + k])
            if size > 0.0:
                allowed = stack.number[1] * stack.number[2]
                step = min(step, (allowed / size) ** (1.0 / k))
    return step


@kernel
def _force_term(stack: Stack, i: int, k: int) -> float:
    """Return term k of the force of contact i on the curve that it follows."""
    at = i * TERMS
    if stack.faint[i] == 1 or stack.curve_exponent[i] == 1.0:
        return stack.rate[i] * stack.compression_series[at + k]
    exponent = stack.curve_exponent[i]
    unit = stack.curve_unit[i]
    term = power_term(stack.compression_series, unit, stack.power_series, at, exponent, k)
    stack.power_series[at + k] = term
    return stack.curve_force[i] * term
