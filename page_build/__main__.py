"""Make the page: `python -m page_build [--engine FOLDER] [--folder FOLDER]`.

The exit status is 0 if all is up to date now, 3 where there is no engine for browsers.
"""

import argparse
import sys
from pathlib import Path

from kernel_build.__main__ import IMPOSSIBLE

from page_build.build import build, has_engine, is_up_to_date
from stackbounce.engine import native
from stackbounce.explorer import made


def main() -> int:
    """Make what is not there or not up to date; return the exit status."""
    parser = argparse.ArgumentParser(prog="python -m page_build")
    parser.add_argument("--engine", type=Path, default=native.FOLDER, help="where the kernels are")
    parser.add_argument("--folder", type=Path, default=made.FOLDER, help="where the page goes")
    given = parser.parse_args()
    if not has_engine(given.engine):
        print("the page needs the engine: run make kernels", file=sys.stderr)  # noqa: T201
        return IMPOSSIBLE
    if not is_up_to_date(given.engine, given.folder):
        print("Making the page", flush=True)  # noqa: T201
        build(given.engine, given.folder)
    return 0


if __name__ == "__main__":
    sys.exit(main())
