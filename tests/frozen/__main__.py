"""Compare all answers with those that were kept: ``python -m frozen [GROUP...]``, in tests."""

import argparse
import os
import sys

from frozen import store
from frozen.groups import GROUPS, changed, computed

_SHOWN = 20


def main() -> int:
    """Compare the groups that are asked for, or write them; return 1 where any differs."""
    parser = argparse.ArgumentParser(prog="python -m frozen", description=__doc__)
    parser.add_argument("groups", nargs="*", metavar="GROUP", help=", ".join(GROUPS))
    parser.add_argument("--write", action="store_true", help="keep the answers of now")
    parser.add_argument("--exact", action="store_true", help="compare the bits of all numbers")
    parser.add_argument("--all", action="store_true", help="show all differences, not 20 a group")
    asked = parser.parse_args()
    unknown = [name for name in asked.groups if name not in GROUPS]
    if unknown:
        parser.error(f"no group {unknown[0]}; known: {', '.join(GROUPS)}")
    found = [
        _write(name) if asked.write else _compare(name, asked.exact, asked.all)
        for name in asked.groups or GROUPS
    ]
    return int(any(found))


def _write(name: str) -> int:
    now = computed(name)
    store.keep(name, now)
    _say(f"{name}: {len(now)} values written, {store.file_of(name).stat().st_size} bytes")
    return 0


def _compare(name: str, exact: bool, everything: bool) -> int:
    """Print how a group compares; return how many of its values differ."""
    begun = sum(os.times()[:4])  # of this process and of the server
    now = computed(name)
    found = changed(name, now, exact or GROUPS[name].bits)
    _say(f"{name}: {len(now)} values, {len(found)} differ ({sum(os.times()[:4]) - begun:.0f} s)")
    for one in found if everything else found[:_SHOWN]:
        _say(f"  {one}")
    if len(found) > _SHOWN and not everything:
        _say(f"  and {len(found) - _SHOWN} more")
    return len(found)


def _say(line: str) -> None:
    sys.stdout.write(f"{line}\n")
    sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main())
