"""How balls leave sideways that do not stand exactly above each other, to first order.

To first order in the offsets the vertical motion is that of the aligned stack, so that the sideways
motion follows from a run that is known, whatever the contact laws. The normal of contact i leans by
(s_i - s_(i-1)) / L_i, with the distance of the centres L_i = R_(i-1) + R_i - c_i, so that

    m_i s_i'' = F_i (s_i - s_(i-1)) / L_i - F_(i+1) (s_(i+1) - s_i) / L_(i+1)

for the offsets s_i, with the force F_i and the overlap c_i of the run. There is no friction, and
the floor pushes straight up. A rigid collision changes the sideways speeds at one instant, by its
impulse in place of the force.
"""

import functools
import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from stackbounce.engine import codes
from stackbounce.errors import InvalidType, InvalidValue, finite, shown, whole
from stackbounce.model import STANDARD_GRAVITY
from stackbounce.units import in_unit
from stackbounce.version import __version__

if TYPE_CHECKING:
    import xarray

    from stackbounce.run.result import Result

_Array = NDArray[np.float64]

LIMIT = math.radians(15.0)  # an exact angle of 16.5 degrees is 16.1 to first order
UNITS = {"sideways_speed": "m/s", "angle": "rad"} | dict.fromkeys(
    ("offset", "offset_at_top", "landing"), "m"
)
REMARK = "an angle is above 15 degrees, where first order ends"

_NODES = 32  # of a stretch between two events or peaks: 16 give 3e-7 of a speed, 24 give 2e-10
_SWEEPS = 100  # of Picard's iteration, whose error falls as 1/(2 n)!
_ENOUGH = 1e-15  # relative


def leave_sideways(
    result: "Result", offsets: Mapping[int, Any] | None, speeds: Mapping[int, Any] | None
) -> "xarray.Dataset":
    """Return how the balls of a run leave sideways; see `Result.sideways`."""
    import xarray as xr

    found = _transfer_of(result)
    count = len(result.drop.balls)
    ball, attrs = np.arange(count), {"stackbounce": __version__, "drop": result.drop.to_toml()}
    if not offsets and not speeds:
        return xr.Dataset(
            {
                "transfer": (("ball", "moved"), found.speed[:, :count], {"units": "1/s"}),
                "amplification": (("ball", "moved"), found.offset[:, :count], {"units": "1"}),
            },
            {"ball": ball, "moved": ball},
            attrs,
        )
    begun = [*_given("offsets", offsets, "m", count), *_given("speeds", speeds, "m/s", count)]
    offset, sideways = found.offset @ begun, found.speed @ begun
    upward = np.array(result.final_velocities)
    angle = np.arctan2(sideways, upward)
    pull = result.drop.gravity or STANDARD_GRAVITY
    above = result.sampled([result.end_time])["position"][:, 0]
    with np.errstate(invalid="ignore"):
        down = (upward + np.sqrt(upward**2 + 2.0 * pull * above)) / pull
    down[~(down >= 0.0)] = math.nan
    top = np.where(upward > 0.0, upward / pull, math.nan)
    if np.any(np.abs(angle[upward > 0.0]) > LIMIT):
        attrs["remark"] = REMARK
    columns = {
        "sideways_speed": sideways,
        "angle": angle,
        "offset": offset,
        "offset_at_top": offset + top * sideways,
        "landing": offset + down * sideways,
    }
    return xr.Dataset(
        {name: ("ball", values, {"units": UNITS[name]}) for name, values in columns.items()},
        {"ball": ball},
        attrs,
    )


def _given(name: str, values: Mapping[int, Any] | None, unit: str, count: int) -> list[float]:
    """Return what is given for some balls as a list for all; 0 for the others."""
    found = [0.0] * count
    if not isinstance(values, Mapping | None):
        raise InvalidType(f"{name} must be a dict such as {{1: 1e-3}}, got {shown(values)}")
    for ball, value in (values or {}).items():
        place = whole(f"a ball of {name}", ball, 0, count - 1)
        told = f"{name}[{place}]"
        found[place] = finite(told, in_unit(value, unit, told), unit)
    return found


def _transfer_of(result: "Result") -> "Transfer":
    """Return what becomes of offsets and sideways speeds in a run."""
    balls, rows = result.drop.balls, result._rows
    for i, ball in enumerate(balls):
        if ball.diameter is None:
            raise InvalidValue(f"sideways motion needs each ball's diameter: ball {i} has none")
    invalid = result.status.name == "INVALID"
    if invalid or any(result.infinite):
        what = "is INVALID" if invalid else "had infinitely many collisions"
        raise InvalidValue(f"sideways motion needs all impulses of a run: this one {what}")
    times = rows[:, [codes.TIME, codes.START, codes.PEAK_TIME]].ravel()
    inside = (times > 0.0) & (times < result.end_time)  # and no nan
    return transfer(
        [ball.mass for ball in balls],
        [0.5 * (ball.diameter or 0.0) for ball in balls],
        np.unique([0.0, *times[inside], result.end_time]),
        [
            (row[codes.TIME], int(row[codes.CONTACT]), row[codes.IMPULSE])
            for row in rows[rows[:, codes.KIND] == codes.COLLISION].tolist()
        ],
        result.sampled,
    )


class Transfer(NamedTuple):
    """What offsets and sideways speeds before a run make of themselves, linearly.

    Parameters
    ----------
    offset : ndarray
        (balls, 2 balls) offset in m at the run's end, per m of the offset and per m/s of the speed
        with which each ball begins.
    speed : ndarray
        (balls, 2 balls) sideways speed in m/s then.
    """

    offset: _Array
    speed: _Array


def transfer(
    mass: Sequence[float],
    radii: Sequence[float],
    moments: _Array,
    impulses: Sequence[tuple[float, int, float]],
    sampled: Callable[[_Array], dict[str, _Array]],
) -> Transfer:
    """Return what becomes of offsets and sideways speeds.

    Parameters
    ----------
    mass, radii : sequence of float
        (balls,) in kg and in m.
    moments : ndarray
        Ascending times in s from the start to the end of the run, with all at which a force may
        begin, end or have a kink.
    impulses : sequence of tuple
        Time in s, contact and impulse in N s of each rigid collision, in order.
    sampled : callable
        From times in s to `force` in N and `compression` in m, (contacts, times); not used if there
        are rigid collisions.
    """
    weights, distance = np.array(mass), np.convolve(radii, [1.0, 1.0])[:-1]
    offset, speed = np.eye(len(mass), 2 * len(mass)), np.eye(len(mass), 2 * len(mass), len(mass))
    if impulses:
        now = moments[0]
        for time, contact, impulse in impulses:
            offset, now = offset + (time - now) * speed, time
            if contact > 0:
                lean = impulse * (offset[contact] - offset[contact - 1]) / distance[contact]
                speed[contact] += lean / mass[contact]
                speed[contact - 1] -= lean / mass[contact - 1]
        return Transfer(offset + (moments[-1] - now) * speed, speed)
    nodes, slopes, weigh, inner = _quadrature()
    spans = np.diff(moments)
    tables = sampled((moments[:-1, None] + spans[:, None] * nodes).ravel())
    lean = tables["force"] / (distance[:, None] - tables["compression"])
    lean[0] = 0.0  # the floor pushes straight up
    lean = lean.reshape(len(mass), len(spans), _NODES)
    for stretch, span in enumerate(spans):
        rates = lean[:, stretch, :, None]
        if not np.any(rates):
            offset = offset + span * speed
            continue
        steps = span * slopes  # of time, at the nodes
        rule = inner * steps
        base = offset[:, None] + (rule @ np.ones(_NODES))[:, None] * speed[:, None]
        path = base
        for _ in range(_SWEEPS):
            before, path = path, base + rule @ (rule @ _pushed(path, rates, weights))
            if np.max(np.abs(path - before)) <= _ENOUGH * np.max(np.abs(path)):
                break
        gained = rule @ _pushed(path, rates, weights)
        last = weigh * steps
        offset = offset + span * speed + np.einsum("k,bkc->bc", last, gained)
        speed = speed + np.einsum("k,bkc->bc", last, _pushed(path, rates, weights))
    return Transfer(offset, speed)


def _pushed(path: _Array, rates: _Array, mass: _Array) -> _Array:
    """Return the accelerations (balls, nodes, columns) of balls at offsets of the same shape."""
    push = rates * np.diff(path, axis=0, prepend=0.0)
    push[:-1] -= push[1:].copy()
    return push / mass[:, None, None]


@functools.cache
def _quadrature() -> tuple[_Array, _Array, _Array, _Array]:
    """Return nodes from 0 to 1, the derivative of their map, and the rules of its integrals.

    The map t(x) = x^4 (35 - 84 x + 70 x^2 - 20 x^3) has flat ends, so that forces that begin as a
    root of time are smooth in x. The rules integrate polynomials of x: over all, and up to each
    node.
    """
    x, weigh = np.polynomial.legendre.leggauss(_NODES)
    powers = np.polynomial.legendre.legvander(x, _NODES)
    series = (np.arange(_NODES) + 0.5)[:, None] * (powers[:, :-1] * weigh[:, None]).T
    upto = np.empty((_NODES, _NODES))
    upto[:, 0] = 1.0 + x
    for order in range(1, _NODES):
        upto[:, order] = (powers[:, order + 1] - powers[:, order - 1]) / (2 * order + 1)
    x, inner = 0.5 * (x + 1.0), 0.5 * upto @ series
    nodes = x**4 * (35.0 - 84.0 * x + 70.0 * x**2 - 20.0 * x**3)
    return nodes, 140.0 * (x * (1.0 - x)) ** 3, 0.5 * weigh, inner
