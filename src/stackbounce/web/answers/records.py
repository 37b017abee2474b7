"""What was measured: a file that came in, what is found in it, and a drop fitted to it."""

import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidValue, nearest, shown
from stackbounce.fitting import Fit, fit
from stackbounce.json_values import as_json
from stackbounce.measure.finding import Curve
from stackbounce.measure.kinds import KINDS
from stackbounce.measure.measurement import Measurement, measure_file
from stackbounce.measure.option_values import read_options
from stackbounce.measure.options import options_for
from stackbounce.model import Drop
from stackbounce.version import __version__
from stackbounce.web.answers.play import ran

if TYPE_CHECKING:
    import xarray as xr

    from stackbounce.fitting.residuals import Record

__all__ = ["fitted", "measured", "options"]

_Array = NDArray[np.float64]
_Series = dict[str, Any]

_SHOWN = 4000  # points of a curve that a page draws, at most
_AFTER = 1.5  # of a simulated impact that is kept of a record


def options() -> str:
    """Return, as JSON, the kinds of measurement and the options that the page's form offers."""
    offered = options_for("read", "analyse").values()
    return as_json(
        {
            "kinds": [{"name": kind.name, "says": kind.says} for kind in KINDS.values()],
            "options": [option.to_mapping() for option in offered],
        }
    )


def measured(
    name: str,
    content: bytes,
    options: Mapping[str, Any],
    alone: tuple[str, bytes] | None = None,
) -> str:
    """Return, as JSON, what a file is, what is found in it, and curves to be drawn.

    Parameters
    ----------
    name : str
        The file's name, for messages.
    content : bytes
        What is in it.
    options : mapping
        What the file does not say: those of `read` and `analyse`; numbers may carry units.
    alone : (str, bytes), optional
        Name and content of a record of the lower ball alone.

    Returns
    -------
    str
        JSON with `format`, `why`, `doubt`, `holds`, `found`, `notes`, `series` (curves, in SI),
        `zero` (the first touch on their clock), `measured` (numbers that a fit can use).

    Raises
    ------
    StackbounceError
        If it cannot be read, or nothing that it should hold is there.
    """
    one = _measured(name, content, options, alone)
    return as_json(
        {
            "stackbounce": __version__,
            **one.to_mapping(),
            "series": _drawn(one.curves),
            "zero": one.first_touch,
            "measured": one.measured,
        }
    )


def fitted(
    drop: Drop,
    vary: Sequence[str],
    told: Mapping[str, str],
    name: str,
    content: bytes,
    options: Mapping[str, Any],
) -> str:
    """Return, as JSON, a drop fitted to what was measured.

    Parameters
    ----------
    drop : Drop
        What was dropped, with all that is known.
    vary : sequence of str
        What may change, by its path.
    told : mapping
        What was measured, by the names that `stackbounce.fit` takes, with errors; ``force.0`` is
        the name of a channel of the file.
    name, content, options
        Of the file, as in `measured`; without content there is none.

    Returns
    -------
    str
        JSON with the fitted `drop`, `values` with errors, chi squared, `notes`, and the `series`
        of the force records on the drop's clock.

    Raises
    ------
    StackbounceError
        If it cannot be fitted.
    """
    data: dict[str, Any] = {}
    record = None
    for what, value in told.items():
        data[what] = value
        if what.startswith("force."):
            if not content:
                raise InvalidValue(f"{what} needs a file with a force over time")
            record = record or _measured(name, content, options)
            data[what] = _channel(drop, what, value, record)
        elif re.fullmatch(r"collisions\.\d+", what) and re.fullmatch(r"\s*[0-9]{1,9}\s*", value):
            data[what] = int(value)
    done = fit(drop, data, list(vary))
    return as_json(
        {
            "stackbounce": __version__,
            "drop": done.drop.to_mapping(),
            "values": [_value(done, path) for path in done.names],
            "chi_squared": done.chi_squared,
            "degrees_of_freedom": done.degrees_of_freedom,
            "probability": done.probability,
            "notes": [*done.notes, *done.undetermined],
            "residuals": [one._asdict() for one in done.residuals],
            "series": [_laid_on(one, done.drop) for one in done.records],
        }
    )


def _measured(
    name: str,
    content: bytes,
    options: Mapping[str, Any],
    alone: tuple[str, bytes] | None = None,
) -> Measurement:
    given = dict(options) if alone is None else {**options, "alone": alone}
    known = read_options(given, lambda option: option.name, to=("read", "analyse"))
    return measure_file((name, content), known)


def _drawn(curves: Sequence[Curve]) -> list[_Series]:
    return [_curve(*one[:4]) | {"unit": one.unit, "index": i} for i, one in enumerate(curves)]


def _curve(label: str, what: str, times: _Array, values: _Array) -> _Series:
    """Return a curve with no more points than a page draws, its highest and lowest among them."""
    known = np.isfinite(times) & np.isfinite(values)
    times, values = times[known], values[known]
    if len(times) > _SHOWN:
        parts = np.array_split(np.arange(len(times)), _SHOWN // 2)
        ends = [(part[np.argmin(values[part])], part[np.argmax(values[part])]) for part in parts]
        kept = np.unique(ends)
        times, values = times[kept], values[kept]
    return {"label": label.replace("_", " "), "what": what, "time": times, "values": values}


def _channel(drop: Drop, what: str, which: str, record: Measurement) -> "xr.DataArray":
    """Return the channel of a file that is the force of a contact, cut to one impact."""
    lasting = _AFTER * ran(drop, None, 1000).end_time
    own = {
        name: force
        for one in record.found
        for name, force in one.forces(record.data, lasting).items()
    }
    if not own:
        raise InvalidValue(
            f"{what}: {record.source} holds no force over time, but a {record.told['holds']}"
        )
    if which not in own:
        raise InvalidValue(f"{what} must be a channel, got {shown(which)}; {nearest(which, own)}")
    return own[which]


def _value(done: Fit, path: str) -> dict[str, Any]:
    value = done[path]
    unit = done.units[path]
    return {"path": path, "value": value.nominal_value, "error": value.std_dev, "unit": unit}


def _laid_on(record: "Record", drop: Drop) -> _Series:
    """Return a force record on the fitted drop's clock and, where its scale is free, scale."""
    index = int(record.name.partition(".")[2])
    values, unit = record.measured, record.unit
    if not unit:
        intervals = ran(drop, None, 1000).intervals
        peak = float(np.max(intervals["peak_force"][intervals["contact"] == index], initial=0.0))
        values, unit = values * (peak / float(np.max(record.fitted))), "N"
    curve = _curve(record.name, "force", record.times, values)
    return curve | {"index": index, "unit": unit}
