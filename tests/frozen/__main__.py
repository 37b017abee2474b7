"""Compare what is kept with what is computed: ``python -m frozen [GROUP...]``, in tests."""

import argparse
import sys

from frozen.kept import GROUPS, compare, write

_SHOWN = 20


def main() -> int:
    """Compare the groups that are asked for, or write them; return 1 where any differs."""
    parser = argparse.ArgumentParser(prog="python -m frozen", description=__doc__)
    parser.add_argument("groups", nargs="*", metavar="GROUP", help=", ".join(GROUPS))
    parser.add_argument("--write", action="store_true", help="keep the answers of now")
    asked = parser.parse_args()
    unknown = [name for name in asked.groups if name not in GROUPS]
    if unknown:
        parser.error(f"no group {unknown[0]}; known: {', '.join(GROUPS)}")
    changed = 0
    for name in asked.groups or GROUPS:
        if asked.write:
            write(name)
            continue
        differences = compare(name)
        changed += len(differences)
        shown = [f"{name}: {len(differences)} lines differ", *differences[:_SHOWN]]
        sys.stdout.write("\n  ".join(shown) + "\n")
    return int(changed > 0)


if __name__ == "__main__":
    sys.exit(main())
