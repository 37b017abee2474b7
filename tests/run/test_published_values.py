"""Values computed outside this project, or published, to their printed digits.

Impact speed 1, up-positive, no gravity, rigid floor, unless a name says otherwise. Mass and
stiffness ratios are upper over lower here, the inverse of the paper's. Sources: two methods each
(high-order integration, and a closed form or an event-driven run), or as named in a test.
"""

import math

import pytest

import stackbounce as sb


def run(masses, contacts, gravity=0.0, until=None):
    balls = [sb.Ball(mass) for mass in masses]
    return sb.simulate(sb.Drop(balls, contacts, impact_speed=1.0, gravity=gravity), until=until)


def printed(*values, digits):
    """Compare to so many digits after the point."""
    return pytest.approx(list(values), abs=0.5 * 10.0**-digits)


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
    result = run([1.0, ratio], contacts, gravity=gravity, until=1000.0)
    upper = result.apexes[result.apexes["ball"] == 1]
    drop_height = 1.0 / (2.0 * gravity)
    assert (upper["height"][:2] / drop_height).tolist() == printed(0.571, 2.166, digits=3)
