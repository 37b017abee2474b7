"""What was measured: a file that came in, what is found in it, and a drop fitted to it."""

import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import InvalidValue, StackbounceError, nearest, shown
from stackbounce.fitting import Fit, fit
from stackbounce.json_values import as_json
from stackbounce.measure import analyse
from stackbounce.measure.kinds.track.analysis import Tracks
from stackbounce.measure.kinds.waveform import Waveform
from stackbounce.measure.reading import read_content
from stackbounce.measure.told_numbers import NUMBERS, told_number
from stackbounce.model import Drop
from stackbounce.model.laws import law_named
from stackbounce.version import __version__
from stackbounce.web.answers.play import ran

if TYPE_CHECKING:
    import xarray as xr

    from stackbounce.fitting.residuals import Record

__all__ = ["fitted", "measured"]

_Array = NDArray[np.float64]
_Series = dict[str, Any]

_SHOWN = 4000  # points of a curve that a page draws, at most
_READING = ("holds", "table", "run", "names", "units", "decimal")
_WORDS = ("measured_to", "repeated", "law", "exponent")
_AFTER = 1.5  # of a simulated impact that is kept of a record


def measured(name: str, content: bytes, options: Mapping[str, Any]) -> str:
    """Return, as JSON, what a file is, what is found in it, and curves to be drawn.

    Parameters
    ----------
    name : str
        The file's name, for messages.
    content : bytes
        What is in it.
    options : mapping
        What the file does not say: those of `read` and `analyse`; numbers may carry units.

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
    data, found = _analysed(name, content, options)
    rows = [row for one in found for row in one.rows() if row.name != "note"]
    return as_json(
        {
            "stackbounce": __version__,
            "file": name,
            **{key: data.attrs[key] for key in ("format", "why", "doubt", "holds")},
            "found": [_row(row) for row in rows],
            "notes": list(dict.fromkeys(note for one in found for note in one.notes)),
            "series": _series(data, found),
            "zero": _zero(found),
            "measured": _usable(data, found),
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
            record = record or _analysed(name, content, options)
            data[what] = _channel(drop, what, value, name, *record)
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


def _analysed(name: str, content: bytes, options: Mapping[str, Any]) -> tuple[Any, Any]:
    for key in options:
        known = (*_READING, *NUMBERS, *_WORDS)
        if key not in known:
            raise InvalidValue(f"{shown(key)} is no option; {nearest(key, known)}")
    given = {key: value for key, value in options.items() if value not in (None, "")}
    data = read_content(name, content, **_of(_READING, given))
    known_of_it = {key: told_number(key, given[key], key) for key in NUMBERS if key in given}
    words = _of(_WORDS, given)
    if "law" in words:
        words["law"] = law_named(words["law"])
    try:
        return data, analyse(data, **known_of_it, **words)
    except StackbounceError as error:
        raise type(error)(f"{name}: {error}") from error
    except (ArithmeticError, IndexError, ValueError) as error:
        raise InvalidValue(f"{name}: its numbers cannot be analysed ({error})") from error


def _of(keys: Sequence[str], options: Mapping[str, Any]) -> dict[str, Any]:
    return {key: options[key] for key in keys if key in options}


def _row(row: Any) -> dict[str, Any]:
    value, error = row.value, None
    if hasattr(value, "nominal_value"):
        value, error = value.nominal_value, value.std_dev
    return {"name": row.name, "value": value, "error": error, "unit": row.unit}


def _zero(found: Sequence[Any]) -> float | None:
    """Return when the lowest ball first touches the floor, on the file's clock."""
    for one in found:
        if isinstance(one, Tracks):
            return float(one.first_impact.nominal_value)
        if isinstance(one, Waveform) and one.contacts and one.contacts[0].start is not None:
            return float(one.contacts[0].start.nominal_value)
    return None


def _usable(data: "xr.Dataset", found: Sequence[Any]) -> dict[str, str]:
    """Return what a fit can use of what was found, by the names that it takes."""
    usable: dict[str, str] = {}
    for one in found:
        if isinstance(one, Waveform):
            usable |= {f"force.{i}": name for i, name in enumerate(_channels(data)[:2])}
        elif isinstance(one, Tracks) and one.rebound_ratios:
            for i, ratio in enumerate(one.rebound_ratios):
                usable[f"rebound_ratios.{i}"] = _written(ratio)
        else:
            of_one = one.balls[0] if isinstance(one, Tracks) else one
            for kept in getattr(of_one, "restitutions", ())[:1]:
                usable["rebound_ratios.0"] = _written(kept)
    return usable


def _written(value: Any) -> str:
    number = f"{value.nominal_value:.6g}"
    return f"{number} ± {value.std_dev:.2g}" if value.std_dev > 0.0 else number


def _series(data: "xr.Dataset", found: Sequence[Any]) -> list[_Series]:
    """Return the curves of a record over time."""
    tracks = next((one for one in found if isinstance(one, Tracks)), None)
    if tracks is not None:
        return [
            _curve(ball.name, "position", ball.times, ball.heights - ball.levels[0].nominal_value)
            | {"index": i, "unit": "m"}
            for i, ball in enumerate(tracks.balls)
        ]
    wave = next((one for one in found if isinstance(one, Waveform)), None)
    curves: list[_Series] = []
    for name, values in data.data_vars.items():
        if values.dims != ("time",):
            continue
        times, unit = data["time"].values, str(values.attrs.get("units", ""))
        force = _is_force(str(name))
        if force and wave is not None and not curves:
            curve = _curve(str(name), "force", wave.times, wave.force) | {"unit": wave.unit}
        else:
            curve = _curve(str(name), "force" if force else "other", times, values.values)
            curve |= {"unit": unit}
        curves.append(curve | {"index": len(curves)})
    return curves


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


def _channels(data: "xr.Dataset") -> list[str]:
    """Return the names of a record's forces, the first one the floor's by custom."""
    return [str(name) for name in data.data_vars if _is_force(str(name))]


def _is_force(name: str) -> bool:
    return name.split("_", maxsplit=1)[0] in ("force", "voltage")


def _channel(
    drop: Drop, what: str, which: str, name: str, data: "xr.Dataset", found: Sequence[Any]
) -> "xr.DataArray":
    """Return the channel of a file that is the force of a contact, cut to one impact."""
    own = _channels(data)
    wave = next((one for one in found if isinstance(one, Waveform)), None)
    if wave is None or not own:
        raise InvalidValue(f"{what}: {name} holds no force over time, but a {data.attrs['holds']}")
    if which not in own:
        raise InvalidValue(f"{what} must be a channel, got {shown(which)}; {nearest(which, own)}")
    record: xr.DataArray = data[which].dropna("time").sortby("time")
    first = wave.contacts[0]
    if first.start is None:
        return record
    begin = first.start.nominal_value
    lasts = 0.0 if first.end is None else first.end.nominal_value - begin
    end = begin + max(2.0 * lasts, _AFTER * ran(drop, None, 1000).end_time)
    later = [one.start.nominal_value for one in wave.contacts[1:] if one.start is not None]
    beyond = [start for start in later if start > end]
    if beyond:  # the next bounce is of another drop
        record = record.sel(time=slice(None, 0.5 * (end + min(beyond))))
    return record


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
