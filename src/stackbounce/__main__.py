"""The program ``stackbounce``, which is ``python -m stackbounce``, too.

Ctrl+C ends it quietly at any time: while its modules are imported, too, when no part of it could
handle the interruption, and when it has already ended.
"""

import os
import signal
import sys
from typing import Any, NoReturn

__all__ = ["main"]


def main() -> int:
    """Run the command line with the arguments of this process; return the exit status."""
    wanted = signal.getsignal(signal.SIGINT)  # it may be ignored, as in a shell's background
    if wanted is signal.default_int_handler:
        signal.signal(signal.SIGINT, _end)
    from stackbounce.cli import main as run

    signal.signal(signal.SIGINT, wanted)
    try:
        return run()
    finally:
        if wanted is signal.default_int_handler:
            signal.signal(signal.SIGINT, signal.SIG_DFL)


def _end(*_: Any) -> NoReturn:
    os.write(2, b"stackbounce: interrupted\n")
    os._exit(130)


if __name__ == "__main__":
    sys.exit(main())
