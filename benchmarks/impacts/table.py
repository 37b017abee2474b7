"""The table of who gets what right, as Markdown, CSV and JSON."""

import csv
import json
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from statistics import median
from typing import Any

from benchmarks.impacts.score import LEVELS, Score, summary
from benchmarks.peers.impacts.common import Answer, Peer, Problem


@dataclass(frozen=True)
class Entry:
    """A program, its version, its answers and their scores."""

    peer: Peer
    version: str
    answers: list[Answer]
    scores: list[Score]


def markdown(entries: Sequence[Entry], problems: Sequence[Problem]) -> str:
    """Return the tables: sums, by grade, by group, and the programs' settings."""
    grades = sorted({one["grade"] for one in problems})
    groups = list(dict.fromkeys(one["group"] for one in problems))
    of_group = {one["name"]: one["group"] for one in problems}
    return "\n".join(
        [
            f"{len(problems)} problems.\n",
            _lines(
                [
                    "program",
                    "version",
                    "answered",
                    "counts right",
                    *(f"right to {level} digits" for level in LEVELS),
                    "median digits: speeds",
                    "times",
                    "forces",
                    "median ms",
                ],
                [_sums(one) for one in entries],
            ),
            f"Right to {_listed(LEVELS)} digits, of the problems of each grade:\n",
            _parts(entries, [f"grade {g}" for g in grades], lambda x: f"grade {x.grade}"),
            "The same of each group:\n",
            _parts(entries, groups, lambda x: of_group[x.name]),
            "What the programs are meant for, and how they were used:\n",
            _lines(
                ["program", "package", "meant for", "settings"],
                [[e.peer.name, e.peer.needs, e.peer.meant_for, e.peer.settings] for e in entries],
            ),
        ]
    )


def _listed(levels: Sequence[int]) -> str:
    return f"{', '.join(map(str, levels[:-1]))} and {levels[-1]}"


def _sums(entry: Entry) -> list[str]:
    sums = summary(entry.scores)
    seconds = [
        a["seconds"]
        for a, s in zip(entry.answers, entry.scores, strict=True)
        if s.outcome == "answered"
    ]
    digits = ["–" if sums[x] is None else f"{sums[x]:.1f}" for x in ("speeds", "times", "forces")]
    time = f"{1e3 * median(seconds):.1f}" if seconds else "–"
    wanted = ("answered", "counts", *(f"right_{level}" for level in LEVELS))
    return [entry.peer.name, entry.version, *(str(sums[x]) for x in wanted), *digits, time]


def _parts(entries: Sequence[Entry], heads: list[str], part: Callable[[Score], str]) -> str:
    totals = {head: sum(part(x) == head for x in entries[0].scores) for head in heads}

    def cell(entry: Entry, head: str) -> str:
        mine = [x for x in entry.scores if part(x) == head]
        if all(x.outcome == "unsupported" for x in mine):
            return "–"
        return ", ".join(str(sum(x.right(level) for x in mine)) for level in LEVELS)

    rows = [[entry.peer.name, *(cell(entry, head) for head in heads)] for entry in entries]
    return _lines(["program", *(f"{head} ({totals[head]})" for head in heads)], rows)


def _lines(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [heads, ["---"] * len(heads), *rows]
    return "".join(f"| {' | '.join(line)} |\n" for line in lines)


def write(folder: Path, entries: Sequence[Entry], problems: Sequence[Problem]) -> None:
    """Write impacts.md, impacts.csv (a row for each answer), and impacts.json (the answers)."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "impacts.md").write_text(markdown(entries, problems), "utf-8")
    with (folder / "impacts.csv").open("w", encoding="utf-8", newline="") as file:
        rows = [
            {"program": e.peer.name, "version": e.version, **asdict(x), "seconds": a.get("seconds")}
            for e in entries
            for a, x in zip(e.answers, e.scores, strict=True)
        ]
        out = csv.DictWriter(file, fieldnames=list(rows[0]))
        out.writeheader()
        out.writerows(rows)
    told: list[dict[str, Any]] = [
        {"program": e.peer.name, "version": e.version, "answers": e.answers} for e in entries
    ]
    (folder / "impacts.json").write_text(json.dumps(told, indent=1) + "\n", "utf-8")
