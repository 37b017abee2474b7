"""Let every program that is installed answer the problems: `python -m benchmarks.impacts`.

It prints the table of who gets what right, and writes `impacts.md`, `impacts.csv` and
`impacts.json`. The programs are the dependency group `bench`.
"""

import argparse
import sys
from pathlib import Path

from rich.console import Console

from benchmarks.impacts.runs import answers
from benchmarks.impacts.score import FOLDER, read, score_all
from benchmarks.impacts.table import Entry, markdown, write
from benchmarks.peers.impacts import PEERS

LIMIT = 30.0  # s


def main() -> None:
    """Run, score, print and write."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.impacts", description=__doc__)
    parser.add_argument(
        "--out", type=Path, default=Path("build/bench"), help="folder for the tables"
    )
    parser.add_argument("--limit", type=float, default=LIMIT, help="s for each problem")
    parser.add_argument("--only", action="append", help="name of a program; may be repeated")
    parser.add_argument("--problem", action="append", help="name of a problem; may be repeated")
    told = parser.parse_args()
    problems = read(FOLDER / "problems.json", "problems")["problems"]
    references = read(FOLDER / "answers.json", "answers")["answers"]
    problems = [one for one in problems if not told.problem or one["name"] in told.problem]
    console = Console(highlight=False, stderr=True)
    entries = []
    with console.status("starting") as status:
        for peer in PEERS:
            version = peer.version()
            if told.only and peer.name not in told.only:
                continue
            if version is None:
                console.print(f"{peer.name}: {peer.needs} is not installed")
                continue
            found = list(answers(peer, problems, told.limit, status.update))
            scores = score_all(problems, references, found)
            entries.append(Entry(peer, version, found, scores))
    if not problems or not entries:
        parser.error("there is no such problem, or no such program is installed")
    write(told.out, entries, problems)
    sys.stdout.write(markdown(entries, problems))


if __name__ == "__main__":
    main()
