"""The forms of a contact's force: all that the engine knows of them but their codes (`codes`).

A contact has the code of its form and four numbers, `first` to `fourth` in `Drops` and k, p, z, w
here: mostly the stiffness k, the exponent p, and two that depend on the form. The force depends on
the compression c > 0, its rate c', and the *creep* u, a compression that follows c with a delay.

============= =========================================================== ========================
form          force                                                       z
============= =========================================================== ========================
ABSENT        none: there is no floor
POWER         k c^p                                                       none
HYSTERETIC    k c^p loading, k C^p (c/C)^z unloading from the peak C;     unloading exponent
              see `cycles` for cycles in between
DASHPOT       max(0, k c + z c')                                          damping
VISCOELASTIC  max(0, k (c^1.5 + 3/2 z c^0.5 c'))                          dissipative time
HUNT_CROSSLEY max(0, k c^p (1 + z c'))                                    dissipation
RELAXING      max(0, k (c + z (c - u))), u' = (c - u)/w                   relaxation strength;
                                                                          w: relaxation time
TWO_STAGE     k c, from z on k (z + w (c - z)); see `pieces`              z: length, w: softening,
                                                                          p: share returned
TABULATED     k (a + b c + s c^2) in pieces, see `pieces`                 z: number of pieces,
                                                                          p: share returned; w:
                                                                          exponent of the loss,
                                                                          or its pieces if p = 0
BOND          k c + z c', which may pull; the contact never opens         damping
RIGID         an instantaneous collision                                  restitution
RIGID_POWER   the same, with the restitution k v^-p at the speed v        scatter; w: seed
RIGID_LOSS    the same, with the restitution 1 - k v^p                    scatter; w: seed
============= =========================================================== ========================

Those from DASHPOT to RELAXING are one form in the stack, a PRODUCT of a power and a *gain*:

    F = max(0, k c^q g),    g = a + b c + s c^2 + d c' - m u

Its elastic term is k c^p: either a is 1, b is 0 and p = q, or a is 0, b is 1 and p = q + 1. Only a
linear spring with a dashpot has q = 0. With a creep, m > 0, the gain is b c - m u. A term s c^2 is
there in pieces only, where d = 0: `next_event` looks for the zero of a gain without such a term.

A contact that creeps touches and opens at another compression than 0, that of its *surface*: where
its force is 0, c = m u/b. While it is open its surface recovers freely, at the rate of `recovery`,
and so does its creep: it begins the next interval with what is left.

TWO_STAGE and TABULATED are one form in the stack, too: a PIECEWISE contact is a product with q = 0
and d = 0 in each piece, when it unloads times f + g c^M.

A new form that is such a product needs a code (`codes`) and its numbers in `numbers_of_product`;
any other one also a force, an energy, a static compression, and the terms of its power series
(`find_terms`).
"""

import math

from stackbounce.engine import codes
from stackbounce.engine.cycles import has_hysteresis, loading_compression, returned_work
from stackbounce.engine.elementary import power
from stackbounce.engine.kernels import Floats, kernel
from stackbounce.engine.pieces import (
    compression_of_work,
    has_one_curve,
    pieces_work,
    take_table,
    take_two_stages,
)
from stackbounce.engine.slots import GRAVITY
from stackbounce.engine.stack import Stack


@kernel
def take_law(stack: Stack, i: int, kind: int, k: float, p: float, z: float, w: float) -> None:
    """Set the numbers of contact i's law; a law without loss becomes a power law."""
    if kind == codes.ABSENT:
        stack.law[i] = codes.ABSENT
        stack.stiffness[i] = stack.exponent[i] = stack.unloading[i] = 1.0  # placeholders
        return
    stack.law[i] = codes.POWER
    stack.stiffness[i] = k
    stack.exponent[i] = p
    stack.unloading[i] = p
    stack.factor_exponent[i] = p
    if kind == codes.HYSTERETIC:
        if z > p:
            stack.law[i] = codes.HYSTERETIC
            stack.unloading[i] = z
            stack.loss_exponent[i] = z - p
    elif kind == codes.TWO_STAGE:
        take_two_stages(stack, i, z, w, p)
    elif kind == codes.TABULATED:
        take_table(stack, i, int(z), w, p)
    elif kind == codes.BOND or (kind != codes.POWER and z > 0.0):
        stack.law[i] = codes.PRODUCT
        stack.bonded[i] = 1 if kind == codes.BOND else 0
        product = numbers_of_product(kind, k, p, z, w)
        stack.factor_exponent[i], stack.gain_constant[i], stack.gain_slope[i] = product[:3]
        stack.gain_rate[i], stack.gain_creep[i], stack.creep_rate[i] = product[3:]


@kernel
def numbers_of_product(
    kind: int, k: float, p: float, z: float, w: float
) -> tuple[float, float, float, float, float, float]:
    """Return q, a, b, d and m of a product with a loss, and the rate at which its creep follows."""
    if kind in (codes.BOND, codes.DASHPOT):  # k (c + z/k c')
        return 0.0, 0.0, 1.0, z / k, 0.0, 0.0
    if kind == codes.VISCOELASTIC:  # k c^1/2 (c + 3/2 z c')
        return 0.5, 0.0, 1.0, 1.5 * z, 0.0, 0.0
    if kind == codes.HUNT_CROSSLEY:  # k c^p (1 + z c')
        return p, 1.0, 0.0, z, 0.0, 0.0
    return 0.0, 0.0, 1.0 + z, 0.0, z, 1.0 / w  # k ((1 + z) c - z u)


@kernel
def is_nonlinear(stack: Stack, i: int) -> bool:
    """Return whether the force of contact i can be nonlinear, but for straight pieces."""
    if stack.law[i] == codes.PIECEWISE:
        return not has_one_curve(stack, i)
    if stack.law[i] == codes.PRODUCT:
        return stack.factor_exponent[i] != 0.0
    return stack.unloading[i] != 1.0


@kernel
def is_linear(stack: Stack, i: int) -> bool:
    """Return whether the force of a pressing contact is now a constant times its compression."""
    if stack.law[i] >= codes.PRODUCT or stack.depth[i] > 0:
        return False
    return stack.linearised[i] == 1 or stack.curve_exponent[i] == 1.0


@kernel
def creeps(stack: Stack, i: int) -> bool:
    """Return whether the force of contact i depends on a creep."""
    return stack.gain_creep[i] > 0.0


@kernel
def surface(stack: Stack, i: int, creep: float) -> float:
    """Return the compression at which the force of contact i is 0, given its creep."""
    return stack.gain_creep[i] * creep / stack.gain_slope[i] if creep > 0.0 else 0.0


@kernel
def recovery(stack: Stack, i: int) -> float:
    """Return the rate at which the creep of open contact i, and its surface, go back to 0.

    Without a force c = m u/b, so that u' = -(1 - m/b) u/w, where b - m = 1.
    """
    return stack.creep_rate[i] / stack.gain_slope[i]


@kernel
def arm_energy(stack: Stack, i: int, compression: float, creep: float) -> float:
    """Return the energy in the relaxing spring of contact i, whose compression is c - u."""
    stretch = compression - creep
    return 0.5 * stack.stiffness[i] * stack.gain_creep[i] * stretch * stretch


@kernel
def typical_compression(stack: Stack, i: int, speed: float) -> float:
    """Return the compression at which contact i alone would hold the energy m v^2/2."""
    mass, k = stack.mass[i], stack.stiffness[i]
    if creeps(stack, i):
        k *= stack.gain_slope[i]  # before it relaxes
    if i > 0:
        mass = stack.mass[i - 1] * mass / (stack.mass[i - 1] + mass)
    if stack.law[i] == codes.PIECEWISE:
        return compression_of_work(stack, i, 0.5 * mass * speed * speed)
    p = stack.exponent[i]
    share = 1.0 / (p + 1.0)
    return power(0.5 * (p + 1.0) * mass / k, share) * power(speed, 2.0 * share)


@kernel
def raised(x: float, p: float) -> float:
    """Return x^p; for p = 1.5 (Hertz) by a square root, which is faster than a power."""
    if p == 1.5:
        return x * math.sqrt(x)
    return power(x, p)


@kernel
def force(stack: Stack, i: int, compression: float, rate: float, creep: float) -> float:
    """Return the force of contact i on the curve that it follows; no creep is 0."""
    if stack.phase[i] < codes.COMPRESSING:
        return 0.0
    exponent = stack.curve_exponent[i]
    if stack.linearised[i] == 1 or exponent == 1.0:
        pressing = stack.rate[i] * compression
    else:
        ratio = max(0.0, compression / stack.curve_unit[i])
        pressing = stack.curve_force[i] * raised(ratio, exponent)
    if stack.law[i] >= codes.PRODUCT:
        beyond = compression - stack.gain_origin[i]
        slope = stack.gain_slope[i] + stack.gain_square[i] * beyond
        gain = stack.gain_constant[i] + slope * beyond
        gain += stack.gain_rate[i] * rate
        if stack.bonded[i] == 1:
            return pressing * gain
        pressing = (pressing + stack.flat[i]) * max(0.0, gain - stack.gain_creep[i] * creep)
    if stack.depth[i] > 0:
        ratio = max(0.0, compression / stack.held_unit[i])
        held = stack.held_force[i] * power(ratio, stack.loss_exponent[i])
        pressing = max(0.0, pressing + stack.offset[i] + held)
    return pressing


@kernel
def stored_energy(stack: Stack, i: int, compression: float) -> float:
    """Return the energy that contact i would give back if its unloading were not damped.

    Of one that creeps this is the part of the lasting spring only, see `held_energy`.
    """
    if stack.phase[i] == codes.OPEN:
        return 0.0
    if stack.law[i] >= codes.PRODUCT or stack.depth[i] > 0:
        return potential(stack, i, compression)
    exponent = stack.curve_exponent[i]
    if stack.law[i] == codes.HYSTERETIC and stack.top[i] == math.inf:
        exponent = stack.unloading[i]
    return force(stack, i, compression, 0.0, 0.0) * compression / (exponent + 1.0)


@kernel
def held_energy(stack: Stack, i: int, compression: float, creep: float) -> float:
    """Return all energy of contact i: if open, that of its surface while it recovers."""
    if not creeps(stack, i):
        return stored_energy(stack, i, compression)
    held = surface(stack, i, creep) if stack.phase[i] == codes.OPEN else compression
    return _elastic_work(stack, i, held) + arm_energy(stack, i, held, creep)


@kernel
def _elastic_work(stack: Stack, i: int, c: float) -> float:
    """Return the integral from 0 to c of the force of a product at rest."""
    exponent = stack.exponent[i] + 1.0
    return stack.stiffness[i] * power(c, exponent) / exponent


@kernel
def potential(stack: Stack, i: int, compression: float) -> float:
    """Return the work that contact i would do until it opens if it were not damped."""
    c = abs(compression) if stack.bonded[i] == 1 else max(0.0, compression)
    if stack.law[i] == codes.PRODUCT:
        return _elastic_work(stack, i, c)
    if has_hysteresis(stack, i):
        return returned_work(stack, i, c)
    if stack.law[i] == codes.PIECEWISE:
        return stack.stiffness[i] * pieces_work(stack, i, c)
    if stack.linearised[i] == 1 or stack.curve_exponent[i] == 1.0:
        return 0.5 * stack.rate[i] * c * c
    exponent = stack.curve_exponent[i] + 1.0
    share = power(c / stack.curve_unit[i], exponent)
    return stack.curve_force[i] * stack.curve_unit[i] * share / exponent


@kernel
def static_compression(stack: Stack, i: int, weight: float) -> float:
    """Return the compression at which contact i, without hysteresis, carries a weight."""
    if stack.law[i] == codes.PRODUCT:
        return power(weight / stack.stiffness[i], 1.0 / stack.exponent[i])
    if stack.law[i] == codes.PIECEWISE:
        return loading_compression(stack, i, weight)
    if stack.linearised[i] == 1 or stack.curve_exponent[i] == 1.0:
        return weight / stack.rate[i]
    share = power(weight / stack.curve_force[i], 1.0 / stack.curve_exponent[i])
    return stack.curve_unit[i] * share


@kernel
def is_damped(stack: Stack, i: int) -> bool:
    """Return whether the force of contact i depends on the rate, or on a creep.

    Its formula may then give a pulling force while c > 0.
    """
    return stack.gain_rate[i] > 0.0 or stack.gain_creep[i] > 0.0


@kernel
def power_needed(stack: Stack, i: int) -> float:
    """Return the power p of the compression of contact i whose series is needed, 0 for none.

    If the gain is b c + d c', one power serves both terms: c^q (b c + d c') = b c^p + d/p (c^p)'
    with p = q + 1.
    """
    p = stack.curve_exponent[i]
    if p == 0.0 or p == 1.0:
        return 0.0
    added = stack.gain_constant[i] != 0.0 or stack.gain_square[i] != 0.0
    if stack.law[i] >= codes.PRODUCT and not added and stack.gain_origin[i] == 0.0:
        return p + 1.0
    return p


@kernel
def has_rare_terms(stack: Stack, low: int, high: int) -> bool:
    """Return whether a force of contacts low..high-1 has terms that few forces have.

    These are a gain's term in c^2, its origin, a creep, and what elements remember of a peak.
    """
    largest = 0.0
    for i in range(low, high):
        square = max(abs(stack.gain_square[i]), stack.gain_origin[i])
        largest = max(largest, square, stack.gain_creep[i])
        largest = max(largest, stack.flat[i], float(stack.depth[i]))
    return largest > 0.0


@kernel
def _add_power_term(c: Floats, u: Floats, p: float, n: int) -> None:
    """Compute term n of u, a power of c > 0 with its first term known, from c u' = p c' u."""
    part, total, weight = 1.0 / (n * c[0]), 0.0, p * n
    for j in range(1, n):
        weight -= p + 1.0
        total += weight * (c[n - j] * u[j])
    u[n] = part * total + part * (p * n * u[0]) * c[n]


@kernel
def find_terms(stack: Stack, low: int, high: int, order: int, root: int, rare: int) -> None:
    """Compute the series of a cluster, whose first terms are known, up to an order.

    With x = t^(1/root), a series of terms a_k x^k is the rate of one of terms root a_k/(k + root)
    x^(k + root). Of each power of a compression c, all terms are computed that c is known to. This
    is one function, which takes each array from the stack once: several functions took twice as
    long. Only if ``rare`` is 1 may a force have the terms of `has_rare_terms`: the loop is
    faster without.
    """
    c_all, v_all, f_all = stack.compression_series, stack.velocity_series, stack.force_series
    powers, gains, needed = stack.power_series, stack.gain_series, stack.power
    law, curve_force, curve_unit = stack.law, stack.curve_force, stack.curve_unit
    slope, exponent = stack.rate, stack.curve_exponent
    gain_constant, gain_slope = stack.gain_constant, stack.gain_slope
    gain_square, gain_rate, mass = stack.gain_square, stack.gain_rate, stack.mass
    gain_origin = stack.gain_origin
    creep_all, gain_creep, creep_rate = stack.creep_series, stack.gain_creep, stack.creep_rate
    held_all, held_force = stack.held_series, stack.held_force
    depth, offset, flat, loss_exponent = stack.depth, stack.offset, stack.flat, stack.loss_exponent
    for k in range(order + 1):
        n = k + root
        share = root / n
        falling = share * stack.number[GRAVITY] if k == 0 else 0.0
        below = 0.0
        for i in range(low, high):
            c, u, p = c_all[i], powers[i], needed[i]
            rate = v_all[i - 1][k] - v_all[i][k] if i > 0 else -v_all[i][k]
            c[n] = share * rate
            if p > 0.0:
                # u = (c/unit)^p as in `_add_power_term`, whose call would cost a twentieth of
                # the time; c begins with x^a, u with x^b
                a = 2 if root == 2 and c[0] == 0.0 else 0
                b = int(a * p)
                m = n - b
                if m > 0:
                    part, total, weight = 1.0 / (m * c[a]), 0.0, p * m
                    for j in range(1, m):
                        weight -= p + 1.0
                        total += weight * (c[a + m - j] * u[b + j])
                    u[n] = part * total + part * (p * m * u[b]) * c[a + m]
                else:
                    u[n] = raised(c[a] / curve_unit[i], p) if m == 0 else 0.0
            if law[i] < codes.PRODUCT:
                force = curve_force[i] * u[k] if p > 0.0 else slope[i] * c[k]
            else:
                gain = gains[i]
                pressed = c[0]
                if rare == 1:
                    c[0] -= gain_origin[i]
                gain[k] = gain_slope[i] * c[k] + gain_rate[i] * rate
                if k == 0:
                    gain[0] += gain_constant[i]
                if rare == 1:
                    total = 0.0
                    for j in range(k + 1):
                        total += c[j] * c[k - j]
                    creep = creep_all[i]
                    creep[n] = share * creep_rate[i] * (c[k] - creep[k])
                    gain[k] += gain_square[i] * total - gain_creep[i] * creep[k]
                    c[0] = pressed
                if exponent[i] == 0.0:
                    force = curve_force[i] * gain[k]
                elif p > exponent[i]:  # see `power_needed`
                    pull = gain_slope[i] * u[k] + gain_rate[i] / (share * p) * u[n]
                    force = curve_force[i] * curve_unit[i] * pull
                elif p > 0.0:
                    total = 0.0
                    for j in range(1, k + 1):
                        total += u[j] * gain[k - j]
                    force = curve_force[i] * (total + u[0] * gain[k])
                else:
                    total = 0.0
                    for j in range(1, k + 1):
                        total += c[j] * gain[k - j]
                    force = slope[i] * (total + c[0] * gain[k])
                if rare == 1:
                    force += flat[i] * gain[k]
            if rare == 1 and depth[i] > 0:
                _add_power_term(c, held_all[i], loss_exponent[i], n)
                force += held_force[i] * held_all[i][k]
                if k == 0:
                    force += offset[i]
            f_all[i][k] = force
            if i > 0:
                v_all[i - 1][n] = share / mass[i - 1] * (below - force) - falling
            below = force
        v_all[high - 1][n] = share / mass[high - 1] * below - falling
