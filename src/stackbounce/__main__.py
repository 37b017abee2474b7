"""The program ``stackbounce``, which is ``python -m stackbounce``, too.

Ctrl+C ends it quietly at any time: while its modules are imported, too, when no part of it could
handle the interruption, and when it has already ended.
"""

import os
import signal
import sys

TYPE_CHECKING = False  # importing typing takes longer than all else before `main`
if TYPE_CHECKING:
    from typing import Any, NoReturn

_SOON = 0.02  # s, after which the object is finalised


def main() -> int:
    """Run the command line with the arguments of this process; return the exit status."""
    wanted = signal.getsignal(signal.SIGINT)  # it may be ignored, as in a shell's background
    if wanted is signal.default_int_handler:
        signal.signal(signal.SIGINT, _end)
    from stackbounce.cli import main as run

    signal.signal(signal.SIGINT, wanted)
    sys.unraisablehook = interrupt_again
    try:
        return run()
    finally:
        if wanted is signal.default_int_handler:
            signal.signal(signal.SIGINT, signal.SIG_DFL)


def interrupt_again(lost: "Any") -> None:
    """Interrupt the program once more if Python dropped an interruption; else report as usual.

    It drops one that comes while an object is finalised. This is a `sys.unraisablehook`.
    """
    if not issubclass(lost.exc_type, KeyboardInterrupt):
        sys.__unraisablehook__(lost)
        return
    import threading

    threading.Timer(_SOON, _interrupt).start()


def _interrupt() -> None:
    """Interrupt the main thread, even if it waits for something."""
    import _thread
    import threading

    if hasattr(signal, "pthread_kill"):
        signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGINT)
    else:  # Windows
        _thread.interrupt_main()


def _end(*_: "Any") -> "NoReturn":
    os.write(2, b"stackbounce: interrupted\n")
    os._exit(130)


if __name__ == "__main__":
    sys.exit(main())
