"""The shape that the results of all analyses share."""

from collections.abc import Iterable
from dataclasses import fields
from typing import Any, ClassVar, NamedTuple

from stackbounce.library_types import DataArray, DataFrame, Dataset
from stackbounce.measure.quantities import Array, Number, Row, known_rows, nominal
from stackbounce.shown import Shown

_LARGEST_GAIN = 0.02  # of a restitution above 1, or 3 standard errors


class Curve(NamedTuple):
    """A curve over time, to be drawn: a position, a force or anything else, in SI units."""

    label: str
    what: str
    times: Array
    values: Array
    unit: str


class Branch(NamedTuple):
    """A way in or out of a press curve: the points, and the power law through them.

    Attributes
    ----------
    label : str
        Which way it is.
    compression : ndarray
        (N,) from the contact on, in m; negative in the slack.
    force : ndarray
        (N,) in N, less its zero.
    fit : ndarray
        (N,) in N, the power law.
    misfit : float
        Root mean square of the residuals' moving averages, over the peak force.
    fits : bool
        Whether that is below 1 % of the peak force, or not significant in the noise.
    """

    label: str
    compression: Array
    force: Array
    fit: Array
    misfit: float
    fits: bool


class Listed(NamedTuple):
    """The name in a table, and the SI unit, of a dataclass's field that is annotated with it."""

    name: str
    unit: str = ""


class Finding(Shown):
    """The result of an analysis, a dataclass.

    Attributes
    ----------
    picture : str
        The module of `stackbounce.plots.measurements` that draws it.
    notes : tuple of str
        What a reader of the numbers should know, a sentence each.
    """

    picture: ClassVar[str] = "numbers"
    notes: tuple[str, ...]

    def rows(self) -> list[Row]:
        """Return the quantities that were found, the most important first.

        They are the fields that are annotated as `Listed` and known, in their order.
        """
        return known_rows(
            (label.name, getattr(self, field.name), label.unit)
            for field in fields(self)  # type: ignore[arg-type]
            for label in getattr(field.type, "__metadata__", ())
        )

    @property
    def table(self) -> DataFrame:
        """The quantities of `rows`, each with its error in the last digits."""
        import pandas as pd

        rows = {row.name: [_written(row.value), row.unit] for row in self.rows()}
        return pd.DataFrame.from_dict(rows, orient="index", columns=["value", "unit"])

    def parts(self) -> dict[str, Any]:
        """Return ball, contact, height and impact speed, as far as known, as in a drop's TOML."""
        return {}

    def law_arguments(self) -> dict[str, Any]:
        """Return contact time, restitution and impact speed, as `law_constants` takes them."""
        return {}

    def measured(self, data: Dataset) -> dict[str, str]:  # noqa: ARG002
        """Return the measured values that a fit can use, by the names that `stackbounce.fit` takes.

        Where a result has `restitutions`, the first one is the ball's rebound ratio.
        """
        return as_ratios(getattr(self, "restitutions", ())[:1])

    def forces(self, data: Dataset, lasting: float) -> dict[str, DataArray]:  # noqa: ARG002
        """Return force channels by name, without later impacts; one lasts `lasting` s."""
        return {}

    def curves(self, data: Dataset) -> list[Curve] | None:  # noqa: ARG002
        """Return the curves to draw over a simulated drop; None means the recorded channels."""
        return None

    def branches(self) -> list[Branch]:
        """Return the branches of a force over a compression; nothing for results over time."""
        return []

    def first_touch(self) -> float | None:
        """Return when the lowest ball first touches the floor, in s on the record's clock."""
        return None


class Findings(tuple[Finding, ...]):
    """All that was found in a file, which is shown one below the other."""

    def __repr__(self) -> str:
        """Their tables and notes, as text."""
        return "\n\n".join(map(repr, self))

    def _repr_html_(self) -> str:
        """Their tables and notes, for a notebook."""
        return "".join(finding._repr_html_() for finding in self)


def _written(value: Any) -> str:
    if getattr(value, "std_dev", 0.0) > 0.0:
        return f"{value:.2uS}"
    return value if isinstance(value, str) else f"{nominal(value):.4g}"


def as_ratios(values: Iterable[Any]) -> dict[str, str]:
    """Return rebound ratios with their errors, by the names that a fit takes, lowest ball first.

    Examples
    --------
    >>> from uncertainties import ufloat
    >>> as_ratios([ufloat(0.75, 0.02)])
    {'rebound_ratios.0': '0.75 ± 0.02'}
    """
    return {
        f"rebound_ratios.{i}": f"{value.nominal_value:.6g}"
        + (f" ± {value.std_dev:.2g}" if value.std_dev > 0.0 else "")
        for i, value in enumerate(values)
    }


def rigid_contact(restitution: Number) -> dict[str, Any]:
    """Return the floor's contact for `Finding.parts`; nothing for a restitution outside 0 to 1.

    Examples
    --------
    >>> rigid_contact(0.75), rigid_contact(1.02)
    ({'contact': {'law': 'Rigid', 'restitution': 0.75}}, {})
    """
    kept = nominal(restitution)
    return {"contact": {"law": "Rigid", "restitution": kept}} if 0.0 <= kept <= 1.0 else {}


def no_gain(restitutions: Iterable[Number], moments: Iterable[Any]) -> str:
    """Return why restitutions are those of no ball, above 1 or not above 0; nothing where they are.

    Examples
    --------
    >>> from uncertainties import ufloat
    >>> no_gain([ufloat(0.75, 0.02)], [0.4]), no_gain([ufloat(1.3, 0.02)], [0.4])[:38]
    ('', 'a restitution of 1.30(2) at 0.4 (bounc')
    """
    for k, (kept, moment) in enumerate(zip(restitutions, moments, strict=True)):
        value, error = kept.nominal_value, kept.std_dev
        if value <= 0.0 or value > 1.0 + max(_LARGEST_GAIN, 3.0 * error):
            return (
                f"a restitution of {kept:.1uS} at {nominal(moment):.3g} (bounce {k}): a ball alone "
                "rebounds with 0 to 1 of its speed; it is hit or thrown there, swings or jumps, or "
                "the record lacks a bounce or a ball"
            )
    return ""


def force_channels(data: Dataset) -> list[str]:
    """Return the names of a record's forces; the first one is the floor's by custom."""
    names = map(str, data.data_vars)
    return [name for name in names if name.partition("_")[0] in ("force", "voltage")]


def channels(data: Dataset, force: Curve | None = None) -> list[Curve]:
    """Return a record's channels over time; `force` replaces the first one if that is a force."""
    curves: list[Curve] = []
    forces = force_channels(data)
    for name, channel in data.data_vars.items():
        if channel.dims == ("time",):
            what = "force" if name in forces else "other"
            unit = str(channel.attrs.get("units", ""))
            curves.append(Curve(str(name), what, data["time"].values, channel.values, unit))
    if force is not None and curves and curves[0].what == "force":
        curves[0] = force._replace(label=curves[0].label)
    return curves
