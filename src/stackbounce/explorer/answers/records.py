"""Records: a file of measurements is analysed, and a drop is fitted to it."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from stackbounce.errors import InvalidValue, StackbounceError, a_or_an, one_of, shown
from stackbounce.explorer.answers.predictions import run_drop
from stackbounce.fitting import Record, fit
from stackbounce.fitting.files import convert_measured
from stackbounce.fitting.series import fit_series
from stackbounce.json_values import as_json
from stackbounce.library_types import DataArray
from stackbounce.measure.finding import Branch
from stackbounce.measure.measurement import Measurement, measure_file
from stackbounce.measure.messages import OptionHint
from stackbounce.measure.option_values import read_options
from stackbounce.measure.options import OPTIONS, Option
from stackbounce.model import Drop
from stackbounce.run.quantities import Array
from stackbounce.version import __version__

_Series = dict[str, Any]

_POINTS = 500  # about so many points of a branch that a page draws
_SHOWN = 4000  # most points of a curve that a page draws
_OF_FIT = ("stackbounce", "chi_squared", "degrees_of_freedom", "probability", "residuals", "notes")
_AFTER = 1.5  # part of a record that is kept, in durations of the simulated impact


def measure_record(name: str, content: bytes, options: Mapping[str, Any]) -> str:
    """Recognise a file of measurements and analyse it; return results and curves, as JSON.

    Parameters
    ----------
    name : str
        The file's name, for messages.
    content : bytes
        The content of the file.
    options : mapping
        Options of `read` and `analyse`; numbers may carry units.

    Returns
    -------
    str
        JSON with `format`, `why`, `doubt`, `holds`, `found`, `notes`, `series` (curves, in SI),
        `zero` (the first touch on their clock), `measured` (numbers that a fit can use), `bounce`
        (what is known of one ball's bounce), `branches` (of a press curve).

    Raises
    ------
    StackbounceError
        If it cannot be read, or holds nothing that can be analysed.
    """
    try:
        one = _measure(name, content, options)
    except StackbounceError:
        bounces = _laws_of(name, content)
        if bounces is None:
            raise
        return bounces
    return as_json(
        {
            "stackbounce": __version__,
            **one.to_mapping(),
            "series": [
                _thin(*curve[:4]) | {"unit": curve.unit, "index": i}
                for i, curve in enumerate(one.curves)
            ],
            "zero": one.first_touch,
            "measured": one.measured,
            "bounce": one.bounce,
            "branches": [_sorted(branch) for branch in one.branches],
        }
    )


def _laws_of(name: str, content: bytes) -> str | None:
    """Return what a table of bounces says of the contact laws, as JSON; None if it is none."""
    try:
        done = fit_series((name, content))
    except StackbounceError:
        return None
    rows = []
    for found in done.comparisons:
        for law in found.outcomes:
            title = f"{found.series.title}: {', '.join(law.laws)} ({law.verdict})"
            rows.append({"name": title, "value": law.value, "error": law.error, "unit": ""})
    notes = [*(found.summary for found in done.comparisons), *done.notes]
    about = {"file": name, "format": "table of numbers", "why": "", "doubt": "", "holds": "table"}
    empty: _Series = {"series": [], "zero": None, "measured": {}, "bounce": None, "branches": []}
    return as_json({"stackbounce": __version__, **about, "found": rows, "notes": notes} | empty)


def fit_record(
    drop: Drop,
    vary: Sequence[str],
    quantities: Mapping[str, str],
    name: str,
    content: bytes,
    options: Mapping[str, Any],
) -> str:
    """Fit a drop to what was measured; return it as JSON.

    Parameters
    ----------
    drop : Drop
        The drop, with the values that are known and first guesses of those that vary.
    vary : sequence of str
        Paths of the numbers that vary.
    quantities : mapping
        Measured values by the names that `stackbounce.fit` takes, with errors; ``force.0`` is
        the name of a channel of the file.
    name, content, options
        Of the file, as in `measure_record`; without content there is none.

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
    for what, value in quantities.items():
        if what.startswith("force."):
            if not content:
                raise InvalidValue(f"{what} needs a file with a force over time")
            record = record or _measure(name, content, options)
            data[what] = _find_channel(drop, what, value, record)
        else:
            data[what] = convert_measured(what, value, Path())
    done = fit(drop, data, list(vary))
    known = done.as_dict()
    return as_json(
        {
            "drop": done.drop.to_mapping(),
            "values": [{"path": path, **value} for path, value in known["values"].items()],
            "series": [_align(record, done.drop) for record in done.records],
            **{name: known[name] for name in _OF_FIT},
        }
    )


def _measure(name: str, content: bytes, options: Mapping[str, Any]) -> Measurement:
    known = read_options(options, _control, to=("read", "analyse"))
    return measure_file((name, content), known, _wording)


def _control(option: Option) -> str:
    """Return the name of the page's control for an option."""
    return f"“{option.label}”"


def _wording(hint: OptionHint) -> str:
    """Return a hint as it is entered in the page's form."""
    known = {option.name: _control(option) for option in OPTIONS}
    entered = []
    for name, value in hint.options.items():
        several = value.items() if isinstance(value, Mapping) else ()
        text = ", ".join(f"{key}={one}" for key, one in several) if several else value
        entered.append(known[name] if value is None else f"{text} in {known[name]}")
    return " and ".join(entered)


def _thin(label: str, what: str, times: Array, values: Array) -> _Series:
    """Thin a curve to what a page draws; keep the extremes of each stretch."""
    known = np.isfinite(times) & np.isfinite(values)
    times, values = times[known], values[known]
    if len(times) > _SHOWN:
        parts = np.array_split(np.arange(len(times)), _SHOWN // 2)
        ends = [(part[np.argmin(values[part])], part[np.argmax(values[part])]) for part in parts]
        kept = np.unique(ends)
        times, values = times[kept], values[kept]
    return {"label": label.replace("_", " "), "what": what, "time": times, "values": values}


def _sorted(branch: Branch) -> dict[str, Any]:
    """Return some points of a branch in the order of compression, to be drawn."""
    kept = np.argsort(branch.compression)[:: max(1, len(branch.force) // _POINTS)]
    names = ("compression", "force", "fit")
    return {"label": branch.label, **{name: getattr(branch, name)[kept] for name in names}}


def _find_channel(drop: Drop, what: str, which: str, record: Measurement) -> DataArray:
    """Return the channel of a file that is the force of a contact, cut to one impact."""
    lasting = _AFTER * run_drop(drop, None).end_time
    parts = (quantity.forces(record.data, lasting) for quantity in record.found)
    own = {name: force for part in parts for name, force in part.items()}
    if not own:
        holds = a_or_an(record.evidence["holds"])
        raise InvalidValue(f"{what}: {record.source} holds no force over time, but {holds}")
    return own[one_of(which, own, f"{what} must be a channel, got {shown(which)}")]


def _align(record: Record, drop: Drop) -> _Series:
    """Put a force record on the clock of the fitted drop, and on its scale if that is free."""
    index = int(record.name.partition(".")[2])
    values, unit = record.measured, record.unit
    if not unit:
        intervals = run_drop(drop, None).intervals
        peak = float(np.max(intervals["peak_force"][intervals["contact"] == index], initial=0.0))
        values, unit = values * (peak / float(np.max(record.fitted))), "N"
    return _thin(record.name, "force", record.times, values) | {"index": index, "unit": unit}
