"""``stackbounce transition``, ``highest`` and ``masses``: what they are given, and tell."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from stackbounce.cli.scenario import Scenario, is_file
from stackbounce.cli.show import add_columns, incidence, label, new_table, number
from stackbounce.errors import InvalidValue, positive, shown
from stackbounce.gaps_and_masses.masses import geometric_masses, replace_masses
from stackbounce.model import STANDARD_GRAVITY, Drop
from stackbounce.model.laws import law_named
from stackbounce.run.driver import simulate
from stackbounce.run.result import Status
from stackbounce.units import quantity
from stackbounce.version import __version__

if TYPE_CHECKING:
    import xarray as xr
    from rich.console import Console

__all__ = [
    "candidates",
    "highest_summary",
    "limits",
    "masses_summary",
    "tell_highest",
    "tell_masses",
    "tell_transition",
    "transition_summary",
]

_SHARES = (0.02, 0.05, 0.1, 0.2, 0.5)  # of the whole range, at which the table has rows
_CHANGES = 12  # that have rows
_WIDE = 5  # balls that have a column each
_AT_THE_END = 1e-3  # relative
_REST = 1e-6  # a smaller rebound ratio is shown as none
_OUTPUTS = ("rebound_ratio", "collisions", "first_touch", "last_release", "energy_retained")


def transition_summary(scenario: Scenario, data: "xr.Dataset") -> dict[str, Any]:
    """Return what ``stackbounce transition --json`` prints."""
    return {
        "stackbounce": __version__,
        "drop": scenario.drop.to_mapping(),
        "separate_from": data.attrs["separate_from"],
        "changes": [
            {"gap": gap, "before": before, "after": after} for gap, before, after in _changes(data)
        ],
        "gap": data["gap"].values,
        **{name: data[name].values for name in _OUTPUTS},
        "status": [Status(status).name for status in data["status"].values],
        "textbook": {
            "rebound_ratio": data["textbook_ratio"].values,
            "collisions": data["textbook_collisions"].values,
            "energy_retained": float(data["textbook_energy"]),
        },
    }


def tell_transition(console: "Console", scenario: Scenario, data: "xr.Dataset") -> None:
    """Print a transition, for people: some gaps, and those at which a count changes."""
    drop, gap = scenario.drop, data["gap"].values
    console.print(incidence(scenario), style="bold")
    limit, last = data.attrs["separate_from"], gap[-1]
    balls = range(len(drop.balls)) if len(drop.balls) <= _WIDE else [len(drop.balls) - 1]
    table = new_table("Rebound ratios, the lowest ball first, by the gap")
    add_columns(table, ["gap\nmm", *(f"\n{label(drop.balls[i].name, i)}" for i in balls)])
    add_columns(table, ("energy\nretained", "collisions,\nfloor first"))
    table.add_column("\n")
    changes = data.attrs["changes"]
    notes = {0.0: "touching"} | dict.fromkeys(changes[:_CHANGES], "a count changes")
    if limit <= last:
        notes[limit] = "separate from here on"
    usual = [gap[np.abs(gap - share * last).argmin()] for share in (*_SHARES, 1.0)]
    for one in sorted({*notes, *map(float, usual)}):
        row = data.isel(gap=int(np.flatnonzero(gap == one)[0]))
        ratios = row["rebound_ratio"].values[list(balls)]
        counts = _counts(row["collisions"].values)
        note = notes.get(one, "")
        table.add_row(*_numbers(1e3 * one, ratios, row["energy_retained"]), counts, note)
    ratios = data["textbook_ratio"].values[list(balls)]
    counts = _counts(data["textbook_collisions"].values)
    table.add_row(*_numbers(math.nan, ratios, data["textbook_energy"]), counts, "textbook")
    console.print(table)
    if limit <= last:
        console.print(
            f"\nFrom {1e3 * limit:.6g} mm on nothing changes: the collisions are separate."
        )
    elif math.isfinite(limit):
        console.print(f"\nThe collisions are separate from {1e3 * limit:.6g} mm on, beyond --stop.")
    else:
        console.print("\nThe collisions are never all separate, however wide the gap.")
    if len(changes) > _CHANGES:
        console.print(f"{len(changes) - _CHANGES} more changes of counts: see --json.")


def candidates(
    what: Sequence[str] | None,
    *,
    law: str,
    gaps: Sequence[str] | None,
    height: str | None,
    speed: str | None,
) -> dict[str, Any]:
    """Return what `stackbounce.highest` is given."""
    given: dict[str, Any] = {"law": law_named(law)}
    if what:
        given["balls"] = [Drop.from_toml(one) if is_file(one) else one for one in what]
    if gaps:
        given["gaps"] = [quantity(gap, "m", "--gap") for gap in gaps]
    if height is not None and speed is not None:
        raise InvalidValue("--height and --speed: only one of the two can be given, got both")
    if height is not None:
        fallen = positive("--height", quantity(height, "m", "--height"), "metres")
        given["impact_speed"] = math.sqrt(2.0 * STANDARD_GRAVITY * fallen)
    if speed is not None:
        given["impact_speed"] = quantity(speed, "m/s", "--speed")
    return given


def highest_summary(data: "xr.Dataset") -> dict[str, Any]:
    """Return what ``stackbounce highest --json`` prints."""
    names = ("place", "rebound_ratio", "height_ratio", "energy_share", "energy_retained")
    stacks = []
    for i in range(data.sizes["stack"]):
        row = data.isel(stack=i)
        stacks.append(
            {"balls": row["balls"].values, "collisions": row["collisions"].values}
            | {name: row[name].values for name in names}
        )
    return {**data.attrs, "gap": data["gap"].values, "stacks": stacks}


def tell_highest(console: "Console", data: "xr.Dataset", rows: int) -> None:
    """Print the first stacks in order, for people, and what the gap does to the order."""
    speed = data.attrs["impact_speed"]
    count, gaps = data.sizes["stack"], 1e3 * data["gap"].values
    shown_rows = min(rows, count)
    console.print(f"The best {shown_rows} of {count} stacks, at {number(speed)} m/s", style="bold")
    table = new_table(f"Top ball, with gaps of {number(gaps[0])} mm")
    table.add_column("\nballs, the lowest first")
    add_columns(table, ("ratio\nv/v0", "bounce\n/drop", "share of\nenergy"))
    add_columns(
        table,
        [f"{'place, bounce' if k == 1 else ''}\n{gap:.4g} mm" for k, gap in enumerate(gaps)][1:],
    )
    for i in range(shown_rows):
        row = data.isel(stack=i)
        others = [
            f"{int(place)}, {number(float(height))}"
            for place, height in zip(row["place"].values, row["height_ratio"].values, strict=True)
        ]
        table.add_row(
            " + ".join(map(str, row["balls"].values)),
            number(float(row["rebound_ratio"][0, -1])),
            number(float(row["height_ratio"][0])),
            f"{100.0 * float(row['energy_share'][0]):.1f} %",
            *others[1:],
        )
    console.print(table)
    first = data["balls"].values[data["place"].values.argmin(axis=0)]
    for gap, names in zip(gaps[1:], first[1:], strict=True):
        if list(names) != list(first[0]):
            console.print(f"With gaps of {gap:.4g} mm {' + '.join(names)} is first.")
    unfinished = int((~np.isfinite(data["rebound_ratio"].values[..., -1])).sum())
    if unfinished:
        console.print(f"{unfinished} drops could not be finished.")


def limits(text: str) -> tuple[float, float]:
    """Return the masses that ``--within`` names.

    Examples
    --------
    >>> limits("10g:1kg")
    (0.01, 1.0)
    """
    low, colon, high = text.partition(":")
    if not colon:
        raise InvalidValue(f"--within must be MASS:MASS, such as 10g:1kg, got {shown(text)}")
    return quantity(low, "kg", "--within"), quantity(high, "kg", "--within")


def masses_summary(given: Drop, best: Drop, within: tuple[float, float] | None) -> dict[str, Any]:
    """Return what ``stackbounce masses --json`` prints."""
    means = replace_masses(given, geometric_masses(given)[1:-1])
    outer = sorted([given.balls[0].mass, given.balls[-1].mass])
    low, high = outer if within is None else within
    ends = [
        i
        for i, ball in enumerate(best.balls[1:-1], start=1)
        if min(ball.mass / low, high / ball.mass) < 1.0 + _AT_THE_END
    ]
    stacks = {"best": best, "given": given, "geometric_means": means}
    return {
        "stackbounce": __version__,
        "drop": best.to_mapping(),
        "within": [low, high],
        "at_the_end": ends,
        **{name: _outcome(drop) for name, drop in stacks.items()},
    }


def tell_masses(console: "Console", scenario: Scenario, found: dict[str, Any]) -> None:
    """Print the best masses, for people, beside those given and the geometric means."""
    console.print(incidence(scenario), style="bold")
    table = new_table("Masses in g, the lowest first, and the top ball")
    table.add_column("")
    balls = scenario.drop.balls
    add_columns(table, [label(ball.name, i) for i, ball in enumerate(balls)])
    add_columns(table, ("v/v0", "bounce/drop"))
    for name in ("best", "given", "geometric_means"):
        one = found[name]
        top = float(one["rebound_ratios"][-1])
        heights = [number(top), number(max(top, 0.0) ** 2)]
        words = name.replace("_", " ")
        table.add_row(words, *(number(1e3 * mass) for mass in one["masses"]), *heights)
    console.print(table)
    low, high = found["within"]
    for i in found["at_the_end"]:
        console.print(
            f"{label(balls[i].name, i)} lies at the end of what was tried, {low:.6g} kg to "
            f"{high:.6g} kg: the best mass is beyond (--within)"
        )


def _outcome(drop: Drop) -> dict[str, Any]:
    result = simulate(drop)
    return {
        "masses": [ball.mass for ball in drop.balls],
        "rebound_ratios": result.rebound_ratios,
        "collisions": result.collisions,
        "energy_retained": result.energy_retained,
    }


def _changes(data: "xr.Dataset") -> list[tuple[float, Any, Any]]:
    """Return the gaps at which counts change, with the counts before and after."""
    counts, found = data["collisions"].values, []
    for gap in data.attrs["changes"]:
        i = int(np.flatnonzero(data["gap"].values == gap)[0])
        found.append((gap, counts[i - 1], counts[i]))
    return found


def _numbers(gap: float, ratios: Any, energy: Any) -> list[str]:
    cells = [number(float(one) if abs(one) > _REST else 0.0) for one in ratios]
    return [number(gap), *cells, f"{100.0 * float(energy):.1f} %"]


def _counts(counts: Any) -> str:
    return " ".join("∞" if count < 0 else str(count) for count in counts.tolist())
