"""The benchmarks' page: figures, tables, and what they were measured with."""

import base64
import math
import os
import platform
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

import jinja2
from matplotlib.figure import Figure

from benchmarks import (
    calls,
    figures,
    growth,
    hard_pairs,
    many,
    pairs,
    race,
    startup,
    work_precision,
)
from benchmarks.peers import common
from stackbounce.cross2007.style import render

PACKAGES = ("stackbounce", "numpy", "numba", "scipy")
NOT_INSTALLED = "not installed"
LONG_IMPORT = 0.01  # s
MANY = ["contacts", "drops", "to", "threads", "µs a drop, by the clock", "memory (MiB)"]
FROM = 8  # balls; of smaller stacks one or a few intervals are hard to time


@dataclass(frozen=True)
class Table:
    """A table as text: title, heads, rows; the first `words` columns are words."""

    title: str
    heads: list[str]
    rows: list[list[str]]
    words: int = 1


@dataclass(frozen=True)
class Section:
    """A figure as SVG and PNG with its caption, and the tables of its numbers."""

    name: str
    title: str
    caption: str
    svg: bytes
    png: bytes
    tables: list[Table]

    @property
    def address(self) -> str:
        """The figure itself, as an address within the page."""
        return "data:image/svg+xml;base64," + base64.b64encode(self.svg).decode()


def write(out: Path, progress: Callable[[str], None]) -> list[Table]:
    """Measure, write the page and its figures to a folder, and return the tables."""
    makers = (_growth, _accuracy, _work, _peers, _pairs, _startup)
    sections = [make(progress) for make in makers]
    progress("writing the page")
    out.mkdir(parents=True, exist_ok=True)
    for section in sections:
        (out / f"{section.name}.svg").write_bytes(section.svg)
        (out / f"{section.name}.png").write_bytes(section.png)
    (out / "index.html").write_text(_page(sections), encoding="utf-8")
    return [table for section in sections for table in section.tables]


def _growth(progress: Callable[[str], None]) -> Section:
    costs = growth.measure(progress)
    sizes = [size for size in growth.SIZES if size >= FROM]
    kinds = list(dict.fromkeys((c.shape, c.law) for c in costs))

    def table(title: str, number: Callable[[growth.Cost], str]) -> Table:
        rows = [
            [*kind, *[number(c) for c in costs if (c.shape, c.law) == kind and c.balls >= FROM]]
            for kind in kinds
        ]
        return Table(title, ["stack", "contacts", *map(str, sizes)], rows, words=2)

    caption = (
        "Left: what a contact interval costs, the set-up left out. Right: how many contacts in a "
        "row press on each other on average. A chain is struck by one ball; a gapped stack has "
        "random masses and gaps and falls on a floor. The cost follows the cluster, not the number "
        "of balls: the wave in a Hertz chain stays about six contacts long, a gapped stack has "
        "mostly single contacts, and in a chain of springs the wave spreads, by about the cube "
        "root of the number of balls. Gapped stacks are stopped after "
        f"{growth.EVENTS:,} events. A rigid chain is not shown: its collisions take no time "
        "beside the set-up."
    )
    tables = [
        table("Time per contact interval (µs), by number of balls", _interval),
        table("Time of the whole run (ms)", lambda c: _three(1e3 * c.seconds)),
        table("of it to set up (ms)", lambda c: _three(1e3 * c.setup)),
        table(
            "Contact intervals (+: stopped there)",
            lambda c: f"{c.intervals}{'' if c.finished else '+'}",
        ),
        table("Contacts that press at once", lambda c: f"{c.cluster:.1f}"),
        Table("Sweeps of two balls, by number of drops", MANY, many_rows(progress), 1),
    ]
    return _section(
        "growth", "From two balls to two thousand", caption, figures.growth(costs), tables
    )


def _accuracy(progress: Callable[[str], None]) -> Section:
    spreads = work_precision.errors(progress)
    rows = [
        [
            f"{rtol:.0e}",
            *[f"{s.worst / rtol:.2g}" for s in spreads if s.rtol == rtol and s.family != "all"],
            *[
                f"{x / rtol:.2g}"
                for s in spreads
                if (s.rtol, s.family) == (rtol, "all")
                for x in (s.ninety, s.median)
            ],
        ]
        for rtol in work_precision.TOLERANCES
    ]
    names = [s.family for s in spreads if s.rtol == work_precision.TOLERANCES[0]]
    heads = ["rtol", *names[:-1], "90 %", "median"]
    over = sum(s.worst > 10.0 * s.rtol for s in spreads if s.family == "all")
    caption = (
        "Errors of the velocities after the impact, in units of v0, against references of thirty "
        "digits: all stacks of tests/data/laws.json that have a nonlinear contact. The line is ten "
        f"times the tolerance; the worst stack is above it at {over} of "
        f"{len(work_precision.TOLERANCES)} tolerances."
    )
    table = Table("Error / rtol: the worst of each family, and quantiles of all", heads, rows)
    title = "Error against tolerance"
    return _section("accuracy", title, caption, figures.accuracy(spreads), [table])


def _work(progress: Callable[[str], None]) -> Section:
    runs = work_precision.work(progress)
    tables = []
    for drop in work_precision.DROPS:
        heads, columns = ["rtol"], []
        for method in work_precision.METHODS:
            heads += [f"{method}: error", "ms"]
            found = {r.rtol: r for r in runs if (r.drop, r.method) == (drop, method)}
            columns.append(found)
        rows = [
            [f"{rtol:.0e}", *[text for found in columns for text in _pair(found.get(rtol))]]
            for rtol in work_precision.TOLERANCES
        ]
        tables.append(Table(f"Two balls, {drop}: error / v0 and time per drop", heads, rows))
    caption = (
        "Error and time of one drop, from a Drop to its rebound speeds: two balls of 150 g and "
        "57 g, 2 mm apart, on equal contacts, for tolerances from 1e-3 on. scipy's solve_ivp "
        "stops at every touch and release, as a careful script would. Of the compiled time, most "
        "is Python's to set up one drop."
    )
    return _section("work", "Error against time", caption, figures.work(runs), tables)


def _peers(progress: Callable[[str], None]) -> Section:
    given = race.sets(progress)
    check = race.check(given, progress)
    entries = race.race(given, progress)
    hard = [key for key in given.drops if key]
    skipped = [entry.peer.name for entry in entries if not entry.rounds]
    caption = (
        "Two balls on springs: mass ratios from 0.05 to 50 and stiffness ratios from 0.02 to 50, "
        f"log-uniform, half with zero gap, half with gaps to 2 v0/ω. {len(given.drops[0.0]):,} "
        "random drops; a peer gets as many of them as fit in "
        f"{race.SECONDS:g} s. Times are medians of {race.ROUNDS} rounds, processor time without "
        f"compilation; ratios are to {entries[0].peer.name}, errors in units of v0. Hard drops, "
        f"{len(given.drops[hard[0]])} at each offset, lie that far, relative, below and above a "
        "gap, mass ratio or stiffness ratio where the number of contacts changes; a count is "
        "wrong where that of either contact is. The truth is sb.simulate's, which on "
        f"{check.drops} of the drops differs from a reference of fifty digits by "
        f"{check.errors.max():.1e} at most, with {check.wrong} wrong counts; the sweep that is "
        "timed here has another engine for most of them. "
        f"SciPy, CyRK and CVODE have rtol = atol = {common.RTOL:g}, heyoka its default."
        + (f" Not installed and skipped: {', '.join(skipped)}." if skipped else "")
    )
    times = ["solver", "version", "µs per drop", "ratio", "drops", "median error", "worst error"]
    shares = ["solver", "random", *[f"hard, {key:.0e}" for key in hard]]
    hows = [[entry.peer.name, entry.peer.how] for entry in entries]
    tables = [
        Table("Two balls on springs: time, and errors / v0", times, peer_times(entries), 2),
        Table("Drops with a wrong count", shares, peer_counts(entries, len(given.drops))),
        Table("How each was used", ["solver", "how"], hows, words=2),
    ]
    title = "Next to other solvers"
    return _section("peers", title, caption, figures.peers(entries), tables)


def _pairs(progress: Callable[[str], None]) -> Section:
    entries = pairs.all_entries(progress)
    caption = (
        f"{pairs.COUNT:,} random drops of two balls under each law, one thread: the engine of a "
        "sweep, the general engine drop by drop, the classical Runge-Kutta method with a fixed "
        "step as one would write it by hand (10 to 160 steps in the shorter contact time, compiled "
        "by numba), and general solvers stopped at every event, for the first drops. heyoka cannot "
        "expand powers that are no whole numbers, nor forces that are clipped. Of hysteretic drops "
        "those are solved for which the loop's simpler rule for a second compression makes no "
        f"difference. {pairs.RIGID_COUNT:,} rigid pairs have no tolerance. Hard pairs are "
        f"{hard_pairs.COUNT:,} others, with masses and stiffnesses over three decades each and all "
        "pairs of laws, a fifth of them under gravity. Asked are those that a sweep leaves to the "
        f"general engine; what that finds at {hard_pairs.TRUTH:g} tells which numbers are wrong."
    )
    hard = hard_pairs.rows(hard_pairs.measure(progress))
    tables = [
        Table("Time and errors / v0", pairs.HEADS, pairs.rows(entries), 2),
        Table("Hard pairs in sweeps: wrong numbers, and errors / v0", hard_pairs.HEADS, hard, 2),
    ]
    title = "Sweeps of other laws, and a loop by hand"
    return _section("pairs", title, caption, figures.pairs(entries), tables)


def many_rows(progress: Callable[[str], None]) -> list[list[str]]:
    """Return how sweeps grow with the number of drops."""
    return [
        [
            *(one.law, f"{one.drops:,}", one.how, f"{one.threads}" if one.threads else "all"),
            *(_three(1e6 * one.seconds / one.drops), f"{one.memory:.0f}"),
        ]
        for one in many.measure(progress)
    ]


def _startup(progress: Callable[[str], None]) -> Section:
    starts = startup.measure(progress)
    caption = (
        "Each a process of its own, from its start to its end, with compiled bytecode at hand: "
        f"medians of {startup.ROUNDS} rounds, and of the ratios to numpy's import in the same "
        "round. Processor time is that of all threads. A call: `simulate(drop).rebound_ratios`, "
        "two balls at rtol 1e-12, least of its rounds, in turns with its kernel alone and with "
        "plain Python. A first sweep is a process that runs 10 000 drops and ends."
    )
    heads = ["start", "processor (ms)", "ratio", "clock (ms)", "ratio"]
    table = Table("Time from start to end", heads, startup_times(starts))
    found = calls.measure(progress), calls.first_sweeps(progress)
    title = "How soon it starts"
    costs = import_times(startup.imports(progress))
    imports = Table("Imports of 10 ms or more", ["start", "packages (ms)"], costs, words=2)
    tables = [table, imports, Table("One call", calls.HEADS, calls.rows(*found))]
    return _section("startup", title, caption, figures.startup(starts), tables)


def startup_times(starts: list[startup.Start]) -> list[list[str]]:
    """Return what each start takes, in ms and next to numpy's import."""
    return [
        [
            start.name,
            _three(1e3 * start.processor),
            f"{start.processor_ratio:.2f}",
            _three(1e3 * start.clock),
            f"{start.clock_ratio:.2f}",
        ]
        for start in starts
    ]


def import_times(starts: list[dict[str, float]]) -> list[list[str]]:
    """Return the packages that take long to import in each start, the longest first."""
    rows = []
    for name, costs in zip(startup.STARTS, starts, strict=True):
        heavy = sorted((-time, package) for package, time in costs.items() if time >= LONG_IMPORT)
        rows.append([name, ", ".join(f"{package} {-1e3 * time:.0f}" for time, package in heavy)])
    return rows


def peer_times(entries: list[race.Entry]) -> list[list[str]]:
    """Return the solvers' times and errors, in words where one is not installed."""
    rows = []
    for entry in entries:
        if not entry.rounds:
            rows.append([entry.peer.name, NOT_INSTALLED, *["–"] * 5])
            continue
        rows.append(
            [
                entry.peer.name,
                entry.peer.version() or "–",
                _three(1e6 * entry.seconds),
                _three(entry.seconds / entries[0].seconds),
                f"{entry.drops:,}",
                f"{entry.median_error:.1e}",
                f"{entry.worst_error:.1e}",
            ]
        )
    return rows


def peer_counts(entries: list[race.Entry], sets: int) -> list[list[str]]:
    """Return the solvers' shares of wrong counts in each set."""
    shares = [[f"{100.0 * share:.2g} %" for share in entry.wrong.values()] for entry in entries]
    return [
        [entry.peer.name, *(share or ["–"] * sets)]
        for entry, share in zip(entries, shares, strict=True)
    ]


def _section(
    name: str, title: str, caption: str, figure: Figure, tables: Iterable[Table]
) -> Section:
    files = render(figure)
    return Section(name, title, caption, files["svg"], files["png"], list(tables))


def _interval(cost: growth.Cost) -> str:
    return "–" if math.isnan(cost.per_interval) else _three(1e6 * cost.per_interval)


def _three(value: float) -> str:
    return f"{value:#.3g}".rstrip(".") if value < 1e3 else f"{value:,.0f}"


def _pair(run: work_precision.Work | None) -> tuple[str, str]:
    return ("–", "–") if run is None else (f"{run.error:.1e}", _three(1e3 * run.seconds))


def _page(sections: list[Section]) -> str:
    environment = jinja2.Environment(
        loader=jinja2.ChoiceLoader(
            [
                jinja2.FileSystemLoader(Path(__file__).parent),
                jinja2.PackageLoader("stackbounce.cross2007"),
            ]
        ),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    return environment.get_template("report.html.j2").render(
        sections=sections,
        versions={"Python": platform.python_version()} | {p: version(p) for p in PACKAGES},
        cores=os.cpu_count(),
        machine=platform.machine(),
    )
