"""A cluster with linear contacts only moves in normal modes: no time step and no tolerance.

In the coordinates w_i = sqrt(k_i/k) c_i of the closed contacts, k being that of the lowest one, the
stored energy is k |w|^2/2, and eqs 5 and 6, for any number of balls, read w'' = -B B^T w + g. The
row of B for contact i holds sqrt(k_i/m) of its two balls. Orthogonalising these rows (one-sided
Jacobi; a single rotation for two contacts) gives the modes y = Q w, whose frequencies are the
lengths of the rows. The balls' motion follows from the contact forces by momentum, so that impulses
are exact as well.
"""

import math

from stackbounce.engine.codes import EPSILON
from stackbounce.engine.contacts import approach_speed
from stackbounce.engine.elementary import hypotenuse, sine_and_cosine
from stackbounce.engine.kernels import Floats, kernel
from stackbounce.engine.slots import GRAVITY
from stackbounce.engine.stack import WIDTH, Stack


@kernel
def find_modes(stack: Stack, low: int, high: int) -> None:
    """Find the modes of the closed contacts low..high-1 of one cluster, in place."""
    bottom = max(low - 1, 0)
    for i in range(low, high):
        for b in range(bottom, high):
            stack.rows[i * WIDTH + b - bottom] = 0.0
        for j in range(low, high):
            stack.shape[i * WIDTH + j - low] = 1.0 if i == j else 0.0
        stack.weight[i] = math.sqrt(stack.rate[i] / stack.rate[low])
        if i > 0:
            stack.rows[i * WIDTH + i - 1 - bottom] = math.sqrt(stack.rate[i] / stack.mass[i - 1])
        stack.rows[i * WIDTH + i - bottom] = -math.sqrt(stack.rate[i] / stack.mass[i])
    for _ in range(60):
        turned = False
        for i in range(low, high - 1):
            for j in range(i + 1, high):
                if _orthogonalise(stack, i, j, low, high):
                    turned = True
        if not turned:
            break
    for i in range(low, high):
        square = 0.0
        for b in range(bottom, high):
            square += stack.rows[i * WIDTH + b - bottom] * stack.rows[i * WIDTH + b - bottom]
        stack.omega[i] = math.sqrt(square)


@kernel
def _orthogonalise(stack: Stack, i: int, j: int, low: int, high: int) -> bool:
    """Apply a Jacobi rotation that makes rows i and j of B orthogonal.

    Returns whether a rotation was needed.
    """
    balls = high - max(low - 1, 0)
    one, other = i * WIDTH, j * WIDTH
    ii, jj, ij = 0.0, 0.0, 0.0
    for b in range(balls):
        x, y = stack.rows[one + b], stack.rows[other + b]
        ii += x * x
        jj += y * y
        ij += x * y
    if abs(ij) <= 2.0 * EPSILON * math.sqrt(ii) * math.sqrt(jj):
        return False
    zeta = (jj - ii) / (2.0 * ij)
    tangent = 1.0 / (abs(zeta) + math.sqrt(1.0 + zeta * zeta))
    if zeta < 0.0:
        tangent = -tangent
    cosine = 1.0 / math.sqrt(1.0 + tangent * tangent)
    sine = tangent * cosine
    _rotate(stack.rows, one, other, balls, cosine, sine)
    _rotate(stack.shape, one, other, high - low, cosine, sine)
    return True


@kernel
def _rotate(rows: Floats, one: int, other: int, count: int, cosine: float, sine: float) -> None:
    """Rotate two rows of numbers, which begin at ``one`` and ``other``, into each other."""
    for k in range(count):
        x, y = rows[one + k], rows[other + k]
        rows[one + k] = cosine * x - sine * y
        rows[other + k] = sine * x + cosine * y


@kernel
def start_modes(stack: Stack, low: int, high: int) -> None:
    """Set the amplitudes of the modes of contacts low..high-1 from compressions and velocities."""
    gravity = stack.number[GRAVITY]
    for j in range(low, high):
        start, speed, load = 0.0, 0.0, 0.0
        for i in range(low, high):
            weight = stack.shape[j * WIDTH + i - low] * stack.weight[i]
            start += weight * stack.compression[i]
            speed += weight * approach_speed(stack, i)
            if i == 0:
                load += weight * gravity
        stack.static[j] = load / (stack.omega[j] * stack.omega[j])
        stack.cosine[j] = start
        stack.sine[j] = speed


@kernel
def modal_position(stack: Stack, j: int, s: float) -> float:
    """Return the coordinate of mode j at the time s after the anchor.

    The initial coordinate is ``cosine``, the initial velocity ``sine``, and the equilibrium
    ``static``. The formula avoids the difference of coordinate and equilibrium, which would cancel
    digits if the equilibrium is far away.
    """
    sin, cos, versed = _turn(stack.omega[j] * s)
    return _swing(stack, j, sin, cos, versed)


@kernel
def _turn(angle: float) -> tuple[float, float, float]:
    """Return sine, cosine and 1 - cosine of an angle, without cancellation, from half of it."""
    sin, cos = sine_and_cosine(0.5 * angle)
    return 2.0 * sin * cos, (cos - sin) * (cos + sin), 2.0 * sin * sin


@kernel
def _swing(stack: Stack, j: int, sin: float, cos: float, versed: float) -> float:
    """Return the coordinate of mode j, given the numbers of `_turn`."""
    swing = stack.cosine[j] * cos + stack.sine[j] * sin / stack.omega[j]
    return swing + stack.static[j] * versed


@kernel
def modal_compression(
    stack: Stack, i: int, low: int, high: int, s: float, out: Floats
) -> tuple[float, float, float]:
    """Write the Taylor series of the compression of closed contact i to ``out``, up to order 7.

    It is expanded about the time s after the anchor. Returns a bound on the coefficient of the
    remainder (order 8), and the round-off of the compression and of its rate.
    """
    for k in range(8):
        out[k] = 0.0
    tail, noise, rate_noise = 0.0, 0.0, 0.0
    for j in range(low, high):
        weight = stack.shape[j * WIDTH + i - low] / stack.weight[i]
        omega = stack.omega[j]
        amplitude = stack.cosine[j] - stack.static[j]
        sin, cos, versed = _turn(omega * s)
        position = _swing(stack, j, sin, cos, versed)
        speed = stack.sine[j] * cos - amplitude * omega * sin
        even, odd = weight * (position - stack.static[j]), weight * speed
        out[0] += weight * position
        for k in range(2, 8, 2):
            out[k - 1] += odd
            even *= -omega * omega / ((k - 1) * k)
            odd *= -omega * omega / (k * (k + 1))
            out[k] += even
        out[7] += odd
        fastest = abs(weight) * hypotenuse(amplitude * omega, stack.sine[j])
        cube = omega * omega * omega
        tail += fastest * (cube * cube * omega) / 40320.0
        turned = min(omega * s, 1.0)
        reach = abs(stack.cosine[j]) + abs(stack.sine[j]) * turned / omega
        noise += abs(weight) * (abs(stack.static[j]) * turned * turned + reach)
        rate_noise += abs(weight) * (abs(amplitude) * omega * turned + abs(stack.sine[j]))
    return tail, 16.0 * EPSILON * noise, 16.0 * EPSILON * rate_noise


@kernel
def modal_impulse(stack: Stack, i: int, low: int, high: int, s: float) -> tuple[float, float]:
    """Return the first and second time integrals of the force of closed contact i over s."""
    once, twice = 0.0, 0.0
    for j in range(low, high):
        weight = stack.shape[j * WIDTH + i - low] / stack.weight[i] * stack.rate[i]
        omega = stack.omega[j]
        angle = omega * s
        sin, _, versed = _turn(angle)
        first = sin / omega
        second = versed / (omega * omega)
        third = _sine_rest(angle, sin) / omega
        fourth = _cosine_rest(angle, versed) / (omega * omega)
        static, start, rate = stack.static[j], stack.cosine[j], stack.sine[j]
        once += weight * (static * third + start * first + rate * second)
        twice += weight * (static * fourth + start * second + rate * third / (omega * omega))
    return once, twice


@kernel
def _sine_rest(x: float, sin: float) -> float:
    """Return x - sin x without cancellation, given sin x."""
    if x > 0.7:
        return x - sin
    square = x * x
    total = 1.0
    for k in range(16, 3, -2):
        total = 1.0 - square / (k * (k + 1)) * total
    return x * square / 6.0 * total


@kernel
def _cosine_rest(x: float, versed: float) -> float:
    """Return x^2/2 - 1 + cos x without cancellation, given 1 - cos x."""
    square = x * x
    if x > 0.7:
        return 0.5 * square - versed
    total = 1.0
    for k in range(17, 4, -2):
        total = 1.0 - square / (k * (k + 1)) * total
    return square * square / 24.0 * total
