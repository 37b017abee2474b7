"""A fit problem from texts, as a user types them beside a drop or a file."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from stackbounce.errors import InvalidValue, nearest, one_of, shown
from stackbounce.fitting.files import Parts, convert_measured
from stackbounce.fitting.parameters import list_paths
from stackbounce.fitting.problem import FitProblem
from stackbounce.fitting.tables import read_drops
from stackbounce.run.quantities import QUANTITIES


def build_problem(
    parts: Parts,
    *,
    data: Path | None = None,
    measured: Sequence[str] | None = None,
    vary: Sequence[str] | None = None,
    tie: Sequence[str] | None = None,
    compared: bool = False,
) -> FitProblem:
    """Return the fit problem of a file's parts and of what was typed beside them.

    Parameters
    ----------
    parts : Parts
        What a file has, or drops alone.
    data : Path, optional
        A table of drops, as `read_drops` reads it.
    measured, vary, tie : sequence of str, optional
        Texts ``NAME=VALUE``, ``PATH=BOUNDS`` or ``PATH``, and ``PATH=FORMULA``. They are added to
        those of the file, or replace them.
    compared : bool, optional
        Whether models of their own are fitted, so that nothing has to vary.

    Returns
    -------
    FitProblem

    Raises
    ------
    StackbounceError
        If a text cannot be read, or nothing is measured or varied.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.0567)], [sb.Spring(1e4)], height=0.3)
    >>> build_problem(
    ...     Parts({"": drop}, {}, {}, {}),
    ...     measured=["durations.0=5.0 ± 0.1 ms"],
    ...     vary=["contacts.0.stiffness"],
    ... ).fit().names
    ['contacts.0.stiffness']
    """
    if data is not None:
        if set(parts.drops) != {""} or parts.data:
            raise InvalidValue(
                "--data has drops and what was measured of them: the file must have one drop and "
                "nothing measured"
            )
        drops, rows = read_drops(parts.drops[""], data)
        parts = parts._replace(drops=drops, data=rows)
    found = {key: dict(datum) for key, datum in parts.data.items()}
    for name, value in _pairs(measured, "--measured", "NAME=VALUE"):
        key, own = _own_name(parts, name)
        found.setdefault(key, {})[own] = convert_measured(own, value, Path())
    if not found:
        raise InvalidValue(
            "nothing was measured: give --measured 'rebound_ratios.1=1.64 ± 0.02', --data "
            "drops.csv, or [measured] in the file"
        )
    if compared:
        return FitProblem(parts.drops, found)
    varied = parts.vary | dict(_pairs(vary, "--vary", "PATH=BOUNDS", alone=True))
    tied = parts.tie | dict(_pairs(tie, "--tie", "PATH=FORMULA"))
    if not varied:
        raise InvalidValue(
            "nothing is to vary: give --vary 'contacts.0.stiffness=1kN/m:1MN/m' or [vary] in the "
            f"file; {nearest('', list_paths(parts.drops))}"
        )
    return FitProblem(parts.drops, found, varied, tied)


def _pairs(
    texts: Sequence[str] | None, option: str, right: str, *, alone: bool = False
) -> list[tuple[str, Any]]:
    """Return the ``NAME=VALUE`` texts of an option; a name alone, if allowed, has None."""
    found: list[tuple[str, Any]] = []
    for text in texts or ():
        name, equals, value = (part.strip() for part in text.partition("="))
        if not name or not (value or (alone and not equals)):
            raise InvalidValue(f"{option} must be {right}, got {shown(text)}")
        if name in (other for other, _ in found):
            raise InvalidValue(f"{option} must name each number once, got {name} twice")
        found.append((name, value or None))
    return found


def _own_name(parts: Parts, name: str) -> tuple[str, str]:
    """Split a measured number's name into its drop's name (empty for a single one) and the rest."""
    if "" in parts.drops:
        return "", name
    key, _, own = name.partition(".")
    right = f"DROP.NAME, such as {next(iter(parts.drops))}.rebound_ratios.1"
    return one_of(key, parts.drops, f"--measured must be {right}, got {name}"), own


def has_times(data: Mapping[str, Any]) -> bool:
    """Return whether a time or a force record was measured.

    Examples
    --------
    >>> has_times({"durations.0": (5e-3, 1e-4)}), has_times({"rebound_ratios.0": (0.8, 0.1)})
    (True, False)
    """
    timed = {"force"} | {name for name, quantity in QUANTITIES.items() if quantity.unit == "s"}
    return not timed.isdisjoint(name.partition(".")[0] for name in data)
