"""A measurement: a Dataset, a file or typed numbers, with the results of the right analysis."""

import logging
import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

from stackbounce.errors import InvalidType, InvalidValue, StackbounceError, shown
from stackbounce.library_types import Dataset
from stackbounce.measure.finding import Branch, Curve, Finding, Findings, channels
from stackbounce.measure.kinds import KINDS, TYPED
from stackbounce.measure.messages import Message, Wording, python_wording
from stackbounce.measure.options import OPTIONS, options_for
from stackbounce.measure.quantities import Number, Row, nominal
from stackbounce.measure.reading import read, read_content
from stackbounce.measure.setup import Place, Setup
from stackbounce.model.drop import STANDARD_GRAVITY
from stackbounce.model.laws import ContactLaw

_LOG = logging.getLogger(__name__)
_CALCULATING = r"(numpy|scipy|pandas|xarray|uncertainties|stackbounce\.measure)\b"
"""Modules whose warnings are no user's: of numbers that an analysis refuses or leaves out."""

File: TypeAlias = Path | tuple[str, bytes]
"""A file: its path, or its name and its content."""


def analyse(
    data: Dataset,
    *,
    mass: Number | float | None = None,
    diameter: Number | float | None = None,
    contact_time: Number | float | None = None,
    law: type[ContactLaw] | ContactLaw | str | None = None,
    exponent: float | None = None,
    height: Number | float | None = None,
    speed: Number | float | None = None,
    height_error: float | None = None,
    repeated: bool = False,
    measured_to: Place | tuple[Place, Place] = "bottom",
    floor: float | None = None,
    tabulated: bool = False,
    time_constant: float | None = None,
    gravity: float = STANDARD_GRAVITY,
    drag_coefficient: Number | float | None = None,
    air_density: Number | float | None = None,
) -> Findings:
    r"""Return the results of the analyses that belong to the kind of a measurement.

    Parameters
    ----------
    data : xarray.Dataset
        As `read` gives it.
    mass : float or ufloat, optional
        Of the ball, in kg: a contact time then gives a stiffness.
    diameter : float or ufloat, optional
        Of the ball, in m; needed where `measured_to` is not its bottom, and for drag.
    contact_time : float or ufloat, optional
        Of the lower ball alone, in s, for the gap of a stack; of a bouncing ball, which is
        subtracted from each interval of knocks.
    law : ContactLaw, its class or its name, optional
        Of the contact in a force waveform; touch and release then have smaller errors.
    exponent : float, optional
        Of the loading curve, where the law leaves it open.
    height : float or ufloat, optional
        From where the ball fell, in m: gives the restitution of the first bounce.
    speed : float or ufloat, optional
        Impact speed in m/s of a force waveform, for the gap and the ball that is saved.
    height_error : float, optional
        Of each height in a table, in m.
    repeated : bool, optional
        Whether a table's heights after the first are those of the first bounce in repeated drops.
    measured_to : {"bottom", "centre", "top"} or a pair of them, optional
        The point of the ball at which `height` and a table's heights were read, and that a track
        follows; a pair has the point for the drop height first, then that for the bounces.
    floor : float, optional
        Level of the floor in a track of one ball, in m as tracked.
    tabulated : bool, optional
        Whether the contact of a press curve is the table of its points, in place of a fitted law.
    time_constant : float, optional
        Of a piezo sensor's droop, in s, which is then corrected.
    gravity : float, optional
        In m/s**2.
    drag_coefficient : float or ufloat, optional
        Of the ball in air, with `mass` and `diameter`: its drag is then taken into account in times
        and heights of bounces and in tracks. By default, or with 0, there is no air.
    air_density : float or ufloat, optional
        In kg/m**3, with a drag coefficient; by default 1.204.

    Returns
    -------
    Findings
        A tuple that shows its results. Of a sound `Bounces` (`FewBounces` where they are too few
        for a restitution) and `Knocks`; of knock times and of phyphox's bounces `Bounces`; of a
        track `Tracks`; of an acceleration `Accelerometer`; of a force waveform `Waveform`, with a
        second sensor between two balls `SensorGap` before it; of a press curve `Press`; of a table
        with one column of heights, the drop's above the bounces', `Heights`.

    Raises
    ------
    InvalidType
        If `data` is not from `read`.
    InvalidValue
        If there is no analysis for what `data` holds, or the analysis finds nothing.

    Notes
    -----
    A kind that has no use for an option ignores it, so that files of several kinds can be analysed
    with the same options.

    Examples
    --------
    >>> import stackbounce as sb
    >>> path = getfixture("tmp_path") / "knocks.csv"
    >>> text = '"Event time (s)","Interval (s)"\n0,0\n0.8,0.8\n1.44,0.64\n1.952,0.512\n'
    >>> _ = path.write_text(text)
    >>> found = analyse(sb.read(path))
    >>> f"{found[0].mean.nominal_value:.3f}"
    '0.800'
    >>> found._repr_html_() == found[0]._repr_html_()
    True
    """
    options = dict(locals())
    holds = getattr(data, "attrs", {}).get("holds")
    if holds is None:
        raise InvalidType(f"data must be a Dataset from read, got {shown(data)}")
    if holds not in KINDS:
        raise InvalidValue(
            f"there is no analysis of {holds}: give the kind of measurement, one of "
            f"{', '.join(KINDS)}"
        )
    kind = KINDS[holds]
    return Findings(kind.analyse(data, Setup.of(kind.options, options)))


@dataclass(frozen=True)
class Measurement:
    """A file, or typed numbers, and what was found.

    Parameters
    ----------
    source : str
        The file's name, or the options that were typed.
    evidence : mapping
        `format`, `why`, `doubt` and `holds` of what was read.
    data : xarray.Dataset or None
        What was read.
    found : tuple of Finding
        What was found in it.
    wording : callable, optional
        What the user interface makes of hints in notes.
    """

    source: str
    evidence: Mapping[str, str]
    data: Any
    found: tuple[Finding, ...]
    wording: Wording = python_wording

    @property
    def rows(self) -> list[Row]:
        """The quantities of all results."""
        return [row for result in self.found for row in result.rows()]

    @property
    def notes(self) -> list[str]:
        """The notes of all results, each once."""
        every = (note for result in self.found for note in result.notes)
        return list(dict.fromkeys(Message(note).worded(self.wording) for note in every))

    @property
    def measured(self) -> dict[str, str]:
        """The measured values that a fit can use, by the names that `stackbounce.fit` takes."""
        every = [result.measured(self.data) for result in self.found]
        return {name: value for values in every for name, value in values.items()}

    @property
    def curves(self) -> list[Curve]:
        """The curves over time, to draw over a simulated drop."""
        own = (result.curves(self.data) for result in self.found)
        return next((curves for curves in own if curves is not None), None) or channels(self.data)

    @property
    def branches(self) -> list[Branch]:
        """The branches of a press curve."""
        return [branch for result in self.found for branch in result.branches()]

    @property
    def bounce(self) -> dict[str, Any] | None:
        """What was found of one ball's bounce: `restitution`, `contact_time`, `impact_speed`.

        Numbers are without errors, and None where they are not known. A press curve gives the
        `contact` instead, a law as a drop's TOML has it.
        """
        names = ("restitution", "contact_time", "impact_speed")
        for result in self.found:
            values = result.law_arguments()
            known = {name: nominal(values[name]) for name in names if values.get(name) is not None}
            contact = None if known else result.parts().get("contact")
            if contact or {"restitution", "contact_time"} & set(known):
                return {**dict.fromkeys(names), **known, "contact": contact}
        return None

    @property
    def first_touch(self) -> float | None:
        """When the lowest ball first touches the floor, in s on the record's clock."""
        times = (result.first_touch() for result in self.found)
        return next((time for time in times if time is not None), None)

    def to_mapping(self) -> dict[str, Any]:
        """Return source, evidence, quantities and notes, for JSON."""
        rows = [row_mapping(row) for row in self.rows]
        return {"file": self.source, **self.evidence, "found": rows, "notes": self.notes}


def measure_file(
    file: File, options: Mapping[str, Any], wording: Wording = python_wording
) -> Measurement:
    """Read a file and analyse it.

    Parameters
    ----------
    file : Path or (str, bytes)
        Its path, or its name and its content.
    options : mapping
        Those of `read` and `analyse`, as `read_options` returns them.
    wording : callable, optional
        What the user interface makes of hints in doubts and errors; by default Python.

    Raises
    ------
    StackbounceError
        If the file cannot be read, or the analysis finds nothing in it.
    """
    try:
        return _measured(file, options, wording)
    except StackbounceError as error:
        raise type(error)(Message.of(error).worded(wording)) from error


def _measured(file: File, options: Mapping[str, Any], wording: Wording) -> Measurement:
    of_reader = options_for("read")
    reading = {name: value for name, value in options.items() if name in of_reader}
    own = {name: options[name] for name in options_for("analyse") if name in options}
    name = file[0] if isinstance(file, tuple) else str(file)
    with warnings.catch_warnings():  # numpy's and scipy's, of numbers that the analysis refuses
        warnings.filterwarnings("ignore", module=_CALCULATING)
        data = read_content(*file, **reading) if isinstance(file, tuple) else read(file, **reading)
        try:
            found = analyse(data, **own)
        except StackbounceError as error:
            raise type(error)(Message.of(error).of_file(name)) from error
        except Exception:
            _LOG.exception("the analysis of %s as %s has a bug", name, data.attrs["holds"])
            raise
    evidence = {key: data.attrs[key] for key in ("format", "why", "doubt", "holds")}
    evidence["doubt"] = Message(evidence["doubt"]).worded(wording)
    return Measurement(name, evidence, data, found, wording)


def measure_numbers(options: Mapping[str, Any], wording: Wording) -> list[Measurement]:
    """Analyse typed numbers; return a measurement of each kind for which they suffice."""
    known = {option.name: option for option in OPTIONS}
    done = []
    for kind in TYPED:
        given = [name for name in kind.starts_with if name in options]
        if not given:
            continue
        form = "numbers of the command line"
        evidence = {"format": form, "why": "", "doubt": "", "holds": kind.typed}
        source = " ".join(known[name].on_command_line for name in given)
        try:
            found = kind.of_numbers(Setup.of(kind.options, options))
        except ArithmeticError as error:
            raise InvalidValue(f"{source} has numbers that are too large or too small") from error
        done.append(Measurement(source, evidence, None, (found,), wording))
    return done


def row_mapping(row: Row) -> dict[str, Any]:
    """Return a quantity for JSON, its error apart.

    Examples
    --------
    >>> row_mapping(Row("knocks", 7))
    {'name': 'knocks', 'value': 7, 'error': None, 'unit': ''}
    """
    value = getattr(row.value, "nominal_value", row.value)
    error = getattr(row.value, "std_dev", None)
    return {"name": row.name, "value": value, "error": error, "unit": row.unit}
