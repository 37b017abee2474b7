"""Compute the study and write its files: `python -m studies.table2 --out build/study`."""

import argparse
import os
import sys
from pathlib import Path

from studies.table2.page import write


def main() -> None:
    """Write the page, its figures and its numbers."""
    parser = argparse.ArgumentParser(prog="python -m studies.table2", description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("build/study"), metavar="DIR")
    out = parser.parse_args().out
    write(out, _say, os.cpu_count() or 1)
    sys.stderr.write(f"Open {out / 'study.html'}\n")


def _say(line: str) -> None:
    sys.stderr.write(f"{line}\n")


if __name__ == "__main__":
    main()
