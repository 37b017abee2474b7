"""How balls leave sideways that do not stand exactly above each other, to first order.

It follows from a run that is known, whatever the contact laws: `engine/sideways.py` has the method.
"""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.engine import codes, native
from stackbounce.engine.memory import kernel_named
from stackbounce.engine.sideways import ENOUGH, FEW, LEVELS, MANY, WRONG, new_pushes
from stackbounce.engine.stack import as_arrays
from stackbounce.engine.tables import Table
from stackbounce.errors import InvalidType, InvalidValue, finite, shown, whole
from stackbounce.library_types import Dataset
from stackbounce.model import STANDARD_GRAVITY
from stackbounce.units import in_unit
from stackbounce.version import __version__

if TYPE_CHECKING:
    from stackbounce.run.result import Result

_Array = NDArray[np.float64]

LIMIT = math.radians(15.0)  # an exact angle of 16.5 degrees is 16.1 to first order
UNITS = {"sideways_speed": "m/s", "angle": "rad"} | dict.fromkeys(
    ("offset", "offset_at_top", "landing"), "m"
)
_ENDED = ("FINISHED", "TIME_REACHED")  # statuses of runs in which no impulse is missing
REMARK = "an angle is above 15 degrees, where first order ends"


def leave_sideways(
    result: "Result", offsets: Mapping[int, Any] | None, speeds: Mapping[int, Any] | None
) -> Dataset:
    """Return how the balls of a run leave sideways; see `Result.sideways`."""
    import xarray as xr

    count = len(result.drop.balls)
    ball = np.arange(count)
    attrs: dict[str, Any] = {"stackbounce": __version__, "drop": result.drop.to_toml()}
    if not offsets and not speeds:
        offset, sideways, attrs["error"] = _carried(result, np.eye(count, 2 * count))
        data = {
            "transfer": (("ball", "moved"), sideways, {"units": "1/s"}),
            "amplification": (("ball", "moved"), offset, {"units": "1"}),
        }
        return xr.Dataset(data, {"ball": ball, "moved": ball}, attrs)
    begun = [*_given("offsets", offsets, "m", count), *_given("speeds", speeds, "m/s", count)]
    for i, (lower, upper) in enumerate(zip(result.drop.balls, result.drop.balls[1:], strict=False)):
        apart = abs(begun[i + 1] - begun[i])
        reach = 0.5 * ((lower.diameter or math.inf) + (upper.diameter or math.inf))
        if apart >= reach:
            raise InvalidValue(
                f"offsets must leave ball {i + 1} on ball {i}, less than {reach:.6g} m to the side "
                f"of it, got {apart:.6g} m"
            )
    offset, sideways, attrs["error"] = _carried(result, np.array([begun]))
    offset, sideways = offset[:, 0], sideways[:, 0]
    upward = np.array(result.final_velocities)
    angle = np.arctan2(sideways, np.abs(upward))
    pull = result.drop.gravity or STANDARD_GRAVITY
    above = result.sampled([result.end_time])["position"][:, 0]
    with np.errstate(invalid="ignore"):
        down = (upward + np.sqrt(upward**2 + 2.0 * pull * above)) / pull
    down[~(down >= 0.0)] = math.nan
    top = np.where(upward > 0.0, upward / pull, math.nan)
    if np.any(np.abs(angle[upward > 0.0]) > LIMIT):
        attrs["remark"] = REMARK
    found = {
        "sideways_speed": sideways,
        "angle": angle,
        "offset": offset,
        "offset_at_top": offset + top * sideways,
        "landing": offset + down * sideways,
    }
    columns = {name: ("ball", values, {"units": UNITS[name]}) for name, values in found.items()}
    return xr.Dataset(columns, {"ball": ball}, attrs)


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


def _carried(result: "Result", begun: _Array) -> tuple[_Array, _Array, float]:
    """Return the offsets in m and sideways speeds in m/s at the end of a run, (balls, rows).

    Each row of `begun` has the offsets at the start and the sideways speeds. The third is an
    estimate of the error of the speeds, over the largest.
    """
    balls, rows = result.drop.balls, result._rows
    for i, law in enumerate(result.drop.contacts):
        if law is not None and law.pulls:
            raise InvalidValue(f"sideways motion needs contacts that open: contact {i} is a Bond")
    for i, ball in enumerate(balls):
        if ball.diameter is None:
            raise InvalidValue(f"sideways motion needs each ball's diameter: ball {i} has none")
    endless = any(result.infinite)
    if endless or result.status.name not in _ENDED:
        what = "had infinitely many collisions" if endless else f"is {result.status.name}"
        raise InvalidValue(f"sideways motion needs all impulses of a run: this one {what}")
    struck = rows[rows[:, codes.KIND] == codes.COLLISION]
    if len(struck):
        pushes = _pushes(result, len(struck))
        pushes.time[:], pushes.share[:] = struck[:, codes.TIME], 1.0
        at = np.arange(len(struck)) * len(balls) + struck[:, codes.CONTACT].astype(int)
        pushes.force[at] = struck[:, codes.IMPULSE]
        return *_carry(pushes, begun, 1, result.end_time)[:2], 0.0
    times = rows[:, [codes.TIME, codes.START, codes.PEAK_TIME]].ravel()
    moments = np.unique([0.0, *times[(times > 0.0) & (times < result.end_time)]])  # and no nan
    count = FEW
    while True:
        pushes = _pushes(result, count * len(moments))
        pushes.time[::count] = moments
        _call("place_pushes", pushes, count, result.end_time)
        tables = result.sampled(pushes.time)
        pushes.force[:] = tables["force"].T.ravel()
        pushes.compression[:] = tables["compression"].T.ravel()
        deep = tables["compression"].max(axis=1) >= pushes.distance
        if any(deep[1:]):
            raise InvalidValue(
                "sideways motion needs centres that stay apart: the compression of contact "
                f"{1 + np.argmax(deep[1:])} exceeds the sum of the radii"
            )
        offset, speed, error = _carry(pushes, begun, LEVELS, result.end_time)
        error = float(error / (np.max(np.abs(speed)) or 1.0))
        if error > WRONG and len(pushes.time) >= MANY:
            raise InvalidValue(
                "sideways motion grows too fast in this run to be followed: the error of the "
                f"speeds would be {100.0 * error:.1g} %"
            )
        if error <= ENOUGH or len(pushes.time) >= MANY:
            return offset, speed, error
        count *= 2


def _pushes(result: "Result", count: int) -> Any:
    """Return room for so many pushes on the balls of a run."""
    balls = result.drop.balls
    pushes = as_arrays(new_pushes(len(balls), count))
    pushes.mass[:] = [ball.mass for ball in balls]
    radii = [0.5 * (ball.diameter or 0.0) for ball in balls]
    pushes.distance[:] = np.add(radii, [0.0, *radii[:-1]])
    return pushes


def _carry(pushes: Any, begun: _Array, levels: int, end: float) -> tuple[_Array, _Array, float]:
    """Return the offsets and speeds at the end, (balls, rows), and the error of the speeds."""
    found, error = [], 0.0
    for row in begun:
        pushes.begin[:] = row
        _call("carry_sideways", pushes, levels, end)
        coarse, last = np.reshape([*row, *pushes.end], (LEVELS + 1, -1))[levels - 1 : levels + 1]
        error = max(error, np.max(np.abs(last - coarse)[len(pushes.mass) :]))
        found.append(last)
    offset, speed = np.split(np.transpose(found), 2)
    return offset, speed, error


def _call(kernel: str, pushes: Any, *numbers: float) -> None:
    compiled = native.available()
    kernel_named(kernel, compiled)(Table(pushes) if compiled else pushes, *numbers)
