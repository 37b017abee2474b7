"""Values computed outside this project, or published, to their printed digits.

Impact speed 1, up-positive, no gravity, rigid floor, unless a name says otherwise. Mass and
stiffness ratios are upper over lower here, the inverse of the paper's. Sources: two methods each
(high-order integration, and a closed form or an event-driven run), or as named in a test.
"""

import math

import pytest

import stackbounce as sb


def stack(masses, contacts, gaps=None, **given):
    """Return a drop at speed 1."""
    balls = [sb.Ball(mass) for mass in masses]
    return sb.Drop(balls, contacts, gaps, **({"impact_speed": 1.0} | given))


def run(masses, contacts, gaps=None, **given):
    return sb.simulate(stack(masses, contacts, gaps, **given))


def printed(*values, digits):
    """Compare to so many digits after the point."""
    return pytest.approx(list(values), abs=0.5 * 10.0**-digits)


@pytest.mark.parametrize(
    ("floor", "pair", "speeds"),
    [(1.0, 1.0, (0.647416, 2.647416)), (0.8, 0.9, (0.498541, 2.118541))],
)
def test_sequential_collisions(floor, pair, speeds):
    result = run([0.600, 0.058], [sb.Rigid(floor), sb.Rigid(pair)])
    m1, m2, e1, e2 = 0.600, 0.058, floor, pair
    lower = (m1 * e1 - m2 - m2 * e2 * (1 + e1)) / (m1 + m2)
    upper = (m1 * e1 - m2 + m1 * e2 * (1 + e1)) / (m1 + m2)
    assert result.rebound_ratios.tolist() == pytest.approx([lower, upper], rel=1e-14)
    assert result.rebound_ratios.tolist() == printed(*speeds, digits=6)


@pytest.mark.parametrize(
    ("exponent", "constant"), [(1.0, math.pi), (1.5, 2.943275), (2.0, 2.804364)]
)
def test_contact_time_of_a_power_law(exponent, constant):
    """T = C c_max/v, C = 2 sqrt(pi) Gamma(1 + 1/(n+1))/Gamma(1/2 + 1/(n+1))."""
    for speed in (0.3, 2.0):
        law = sb.PowerLaw(700.0, exponent)
        (row,) = run([0.05], [law], impact_speed=speed).intervals
        found = row["end"] * speed / row["peak_compression"]
        power = 1.0 / (exponent + 1.0)
        closed = 2.0 * math.sqrt(math.pi) * math.gamma(1.0 + power) / math.gamma(0.5 + power)
        assert found == pytest.approx(closed, rel=1e-10)
        assert [found] == printed(constant, digits=6)


@pytest.mark.parametrize(
    ("zeta", "restitution", "at_zero", "time"),
    [(0.1, 0.744079, 0.729248, 2.956075), (0.3, 0.450975, 0.372326, None)],
)
def test_dashpot_ends_at_no_force(zeta, restitution, at_zero, time):
    """Bartz, arXiv 2007.15005: the convention of the end changes the restitution."""
    result = run([1.0], [sb.Dashpot(1.0, 2.0 * zeta)])
    assert result.rebound_ratios.tolist() == printed(restitution, digits=6)
    if time is not None:
        assert result.last_release.tolist() == printed(time, digits=6)
    omega = math.sqrt(1.0 - zeta**2)
    assert [math.exp(-zeta * math.pi / omega)] == printed(at_zero, digits=6)
    assert result.rebound_ratios[0] > at_zero


@pytest.mark.parametrize("exponent", [1.0, 1.5, 2.0])
@pytest.mark.parametrize(("d", "restitution"), [(0.1, 0.937476), (0.3, 0.832870), (1.0, 0.593624)])
def test_hunt_crossley(exponent, d, restitution):
    """With d = chi v: d (1+e) = ln[(1+d)/(1-d e)], whatever the exponent (Hunt, Crossley 1975)."""
    law = sb.HuntCrossley(300.0, exponent, d / 2.0)
    e = run([0.1], [law], impact_speed=2.0).rebound_ratios[0]
    assert [e] == printed(restitution, digits=6)
    assert d * (1 + e) == pytest.approx(math.log((1 + d) / (1 - d * e)), rel=1e-10)


@pytest.mark.parametrize(
    ("scaled", "restitution"), [(0.3, 0.902852), (0.5, 0.760037), (0.8, 0.525371)]
)
def test_viscoelastic(scaled, restitution):
    """v* = sqrt(1.5 A (k/m)^(2/5)) v^(1/10); Kuwabara, Kono; Brilliantov, Poeschel."""
    mass, stiffness, speed = 0.02, 5e4, 0.4
    a = scaled**2 / (1.5 * (stiffness / mass) ** 0.4 * speed**0.2)
    result = run([mass], [sb.Viscoelastic(stiffness, a)], impact_speed=speed)
    assert result.rebound_ratios.tolist() == printed(restitution, digits=6)


@pytest.mark.parametrize(
    ("mass", "stiffness", "speeds"),
    [
        (1 / 3, 1.0, (0.888123, 1.278167)),
        (1 / 3, 0.01, (0.009420, 1.999933)),
        (1 / 3, 100.0, (0.999788, 1.000636)),
        (1.0, 1.0, (0.766350, 1.188574)),
        (0.1, 0.1, (0.751498, 2.313548)),
    ],
)
def test_springs_without_a_gap(mass, stiffness, speeds):
    result = run([1.0, mass], [sb.Spring(1.0), sb.Spring(stiffness)])
    assert result.rebound_ratios.tolist() == printed(*speeds, digits=6)


def test_springs_with_a_gap():
    apart = run([1.0, 10.0], [sb.Spring(1.0), sb.Spring(1.0)], [math.pi])
    sequence = run([1.0, 10.0], [sb.Rigid(1.0)] * 2, [math.pi])
    assert [apart.rebound_ratios[0]] == printed(0.168, digits=3)
    assert [sequence.rebound_ratios[0]] == printed(0.748, digits=3)
    result = run([1.0, 1 / 3], [sb.Spring(1.0), sb.Spring(1.0)], [1.0])
    # printed as 1.920577, cut off rather than rounded
    assert result.rebound_ratios.tolist() == printed(0.322171, 1.920578, digits=6)
    assert math.floor(result.rebound_ratios[1] * 1e6) == 1920577


@pytest.mark.parametrize(
    ("radius", "speeds"),
    [(1.0, (0.71077, 1.22262)), (0.5, (0.76851, 2.06765)), (0.3, (0.98319, 1.49491))],
)
def test_hertz_without_a_gap(radius, speeds):
    """Equal materials: k2/k1 = sqrt(r/(1+r))/2, masses as r^3."""
    stiffness = math.sqrt(radius / (1 + radius)) / 2
    result = run([1.0, radius**3], [sb.Hertz(1.0), sb.Hertz(stiffness)])
    assert result.rebound_ratios.tolist() == printed(*speeds, digits=5)
    assert result.energy_retained == pytest.approx(1.0, abs=1e-10)


def test_delayed_rebound():
    """Theme of Bartz, arXiv 2007.15005: a low first bounce, a higher second one."""
    ratio, zeta, gravity = 0.02, 0.1, 0.005
    reduced = ratio / (1.0 + ratio)
    contacts = [sb.Dashpot(1.0, 2.0 * zeta), sb.Dashpot(1.0, 2.0 * zeta * math.sqrt(reduced))]
    result = sb.simulate(stack([1.0, ratio], contacts, gravity=gravity), until=1000.0)
    upper = result.apexes[result.apexes["ball"] == 1]
    drop_height = 1.0 / (2.0 * gravity)
    assert (upper["height"][:2] / drop_height).tolist() == printed(0.571, 2.166, digits=3)


def test_steel_balls_of_hessel():
    """Hessel et al., quoted in the paper: collision times of two steel balls, measured as 1.407.

    Hertz: T = 3.218 (m^2/(K^2 v))^(1/5) is as the diameter for two like balls, at one speed.
    """
    times = []
    for diameter in (0.0381, 0.0270):
        mass = 7800.0 * math.pi * diameter**3 / 6.0
        ball = sb.Ball(mass, diameter=diameter, young_modulus=2e11, poisson_ratio=0.3)
        law = sb.Hertz.between(ball, ball)
        drop = sb.Drop([ball, ball], [None, law], velocities=[0.5, -0.5])
        times.append(sb.simulate(drop).last_release[1])
    ratio = times[0] / times[1]
    assert ratio == pytest.approx(0.0381 / 0.0270, rel=1e-9)
    assert ratio == pytest.approx(1.407, rel=0.005)  # as good as the measurement
