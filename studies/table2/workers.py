"""Tasks that several processes share."""

import multiprocessing
import signal
from collections.abc import Callable, Iterable, Iterator
from typing import TypeVar

Task = TypeVar("Task")
Answer = TypeVar("Answer")


def spread(work: Callable[[Task], Answer], tasks: Iterable[Task], workers: int) -> Iterator[Answer]:
    """Yield the answers to tasks in their order.

    Parameters
    ----------
    work : callable
        A function of a module, so that other processes find it.
    tasks : iterable
        What it takes.
    workers : int
        Processes; with 1 all is done in this one.

    Examples
    --------
    >>> list(spread(abs, [-2, 3], workers=1))
    [2, 3]
    """
    if workers == 1:
        yield from map(work, tasks)
        return
    # a fork would copy the threads of the engine
    with multiprocessing.get_context("spawn").Pool(workers, _begin) as pool:
        yield from pool.imap(work, tasks)


def _begin() -> None:
    """Leave an interruption to the parent, which ends the workers."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
