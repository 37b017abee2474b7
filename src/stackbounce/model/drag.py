"""Falls and rises of a ball in air, in closed form.

The drag of a ball of mass m and diameter D at the speed v is ``m k v**2``, with

    k = rho C A/(2 m),    A = pi D**2/4,

so that ``g/k`` is the square of its terminal speed:

    after a fall of h from rest:  v**2 = (g/k) (1 - exp(-2 k h)),   t = acosh(exp(k h))/sqrt(g k)
    after a fall for t from rest: h = ln(cosh(t sqrt(g k)))/k,      v = sqrt(g/k) tanh(t sqrt(g k))
    rising from the speed v:      h = ln(1 + k v**2/g)/(2 k),       t = atan(v sqrt(k/g))/sqrt(g k)
    from the floor to the floor:  t = (atan(w) + asinh(w))/sqrt(g k) with w = v sqrt(k/g),
                                  and it lands at v/sqrt(1 + w**2)

Each is written as the formula without air times a function that is 1 for k = 0, so that a small
drag loses no digits. k is in 1/m, g in m/s**2.
"""

import math

_LARGE = 50.0  # from here on exp(-x) is nothing beside 1


def sphere_drag(density: float, coefficient: float, diameter: float) -> float:
    """Return the drag of a sphere over the square of its speed, ``m k``, in kg/m.

    Examples
    --------
    >>> round(sphere_drag(1.2, 0.5, 0.1), 6)
    0.002356
    """
    return 0.125 * math.pi * density * coefficient * diameter**2


def fallen_speed(k: float, height: float, g: float) -> float:
    """Return the speed after a fall from rest.

    Examples
    --------
    >>> fallen_speed(0.0, 5.0, 10.0)
    10.0
    """
    z = 2.0 * k * height
    return math.sqrt(2.0 * g * height * (-math.expm1(-z) / z if z > 0.0 else 1.0))


def fall_time(k: float, height: float, g: float) -> float:
    """Return the time of a fall from rest.

    Examples
    --------
    >>> fall_time(0.0, 5.0, 10.0)
    1.0
    """
    z = 2.0 * k * height
    if z == 0.0:
        return math.sqrt(2.0 * height / g)
    # acosh(exp(z/2)), of which only ln 2 is left beside z/2 in the end
    part = math.asinh(math.sqrt(math.expm1(z))) if z < _LARGE else 0.5 * z + math.log(2.0)
    return math.sqrt(2.0 * height / g) * part / math.sqrt(z)


def fall_height(k: float, speed: float, g: float) -> float:
    """Return how far a ball has fallen from rest at a speed; infinite from its terminal speed on.

    Examples
    --------
    >>> fall_height(0.0, 10.0, 10.0)
    5.0
    """
    w = k * speed * speed / g
    if w >= 1.0:
        return math.inf
    return speed * speed / (2.0 * g) * (-math.log1p(-w) / w if w > 0.0 else 1.0)


def fallen(k: float, time: float, g: float) -> float:
    """Return how far a ball has fallen from rest after a time.

    Examples
    --------
    >>> fallen(0.0, 1.0, 10.0)
    5.0
    """
    part = time * math.sqrt(g * k)
    if part == 0.0:
        return 0.5 * g * time * time
    if part > _LARGE:
        return (part - math.log(2.0)) / k
    half = math.sinh(0.5 * part) / part  # cosh x = 1 + 2 sinh(x/2)^2
    square = 2.0 * (half * part) ** 2
    return 2.0 * g * (time * half) ** 2 * (math.log1p(square) / square)


def speed_after(k: float, time: float, g: float) -> float:
    """Return the speed of a ball that has fallen from rest for a time.

    Examples
    --------
    >>> speed_after(0.0, 1.0, 10.0)
    10.0
    """
    part = time * math.sqrt(g * k)
    return g * time * (math.tanh(part) / part if part > 0.0 else 1.0)


def flown(k: float, speed: float, time: float, g: float) -> tuple[float, float]:
    """Return the way and the speed after a time, both up-positive; before it if that is negative.

    The speed now is up-positive too, and no ball falls faster than its terminal speed.

    Raises
    ------
    OverflowError
        If the ball would have come from infinitely far.

    Examples
    --------
    >>> flown(0.0, 10.0, 3.0, 10.0), flown(0.0, -10.0, -2.0, 10.0)
    ((-15.0, -20.0), (0.0, 10.0))
    """
    top = rise_time(k, speed, g) if speed >= 0.0 else -_time_to(k, -speed, g)
    start, end = _from_top(k, -top, g), _from_top(k, time - top, g)
    return end[0] - start[0], end[1]


def _time_to(k: float, speed: float, g: float) -> float:
    """Return how long a ball has fallen from rest at a speed."""
    root = speed * math.sqrt(k / g)
    if root >= 1.0:
        raise OverflowError("faster than the terminal speed")
    return speed / g * (math.atanh(root) / root if root > 0.0 else 1.0)


def _from_top(k: float, time: float, g: float) -> tuple[float, float]:
    """Return height above its highest point and velocity of a ball, a time after it was there."""
    if time >= 0.0:
        return -fallen(k, time, g), -speed_after(k, time, g)
    part = -time * math.sqrt(g * k)
    if part == 0.0:
        return -0.5 * g * time * time, -g * time
    if part >= 0.5 * math.pi:
        raise OverflowError("from infinitely far")
    way = -math.log1p(-(math.sin(part) ** 2)) / (part * part)
    return -0.5 * g * time * time * way, -g * time * (math.tan(part) / part)


def risen(k: float, speed: float, g: float) -> float:
    """Return how far a ball rises.

    Examples
    --------
    >>> risen(0.0, 10.0, 10.0)
    5.0
    """
    w = k * speed * speed / g
    return speed * speed / (2.0 * g) * (math.log1p(w) / w if w > 0.0 else 1.0)


def rise_time(k: float, speed: float, g: float) -> float:
    """Return how long a ball rises.

    Examples
    --------
    >>> rise_time(0.0, 10.0, 10.0)
    1.0
    """
    root = speed * math.sqrt(k / g)
    return speed / g * (math.atan(root) / root if root > 0.0 else 1.0)


def launch_speed(k: float, height: float, g: float) -> float:
    """Return the speed from which a ball rises to a height.

    Examples
    --------
    >>> launch_speed(0.0, 5.0, 10.0)
    10.0
    """
    z = 2.0 * k * height
    return math.sqrt(2.0 * g * height * (math.expm1(z) / z if z > 0.0 else 1.0))


def landing_speed(k: float, speed: float, g: float) -> float:
    """Return the speed at which a ball comes back to the floor that left it at a speed.

    Examples
    --------
    >>> landing_speed(0.0, 10.0, 10.0)
    10.0
    """
    return speed / math.sqrt(1.0 + k * speed * speed / g)


def flight_speed(k: float, time: float, g: float) -> float:
    """Return the speed at which a ball leaves the floor that is back on it after a time.

    The time grows with the speed, and ever more slowly. Newton's method from a speed that is too
    low therefore climbs to the root and never passes it. It ends where round-off stops the climb.

    Raises
    ------
    OverflowError
        If no number is as large as the speed.

    Examples
    --------
    >>> flight_speed(0.0, 2.0, 10.0)
    10.0
    """
    part = time * math.sqrt(g * k)  # atan(w) + asinh(w)
    if part == 0.0:
        return 0.5 * g * time
    # both terms are below w, and atan(w) is below pi/2
    w, below = max(0.5 * part, math.sinh(part - 0.5 * math.pi)), 0.0
    while w > below:
        slope = 1.0 / (1.0 + w * w) + 1.0 / math.hypot(1.0, w)
        below, w = w, w + (part - math.atan(w) - math.asinh(w)) / slope
    return 0.5 * g * time * (below / (0.5 * part))
