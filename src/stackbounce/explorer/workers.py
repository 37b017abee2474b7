"""Worker processes: the server never computes itself; each job has limits of time and memory."""

import asyncio
import contextlib
import importlib
import multiprocessing
import os
import threading
from collections import Counter
from collections.abc import AsyncIterator, Callable
from concurrent.futures.process import BrokenProcessPool
from typing import Any

from pebble import ProcessExpired, ProcessPool

from stackbounce.errors import StackbounceError
from stackbounce.explorer.limits import Limits

AGAIN_SECONDS = 5
"""Time in s after which a client that was sent away may try again."""

_NICE = 5  # how much lower the priority of a worker process is than the server's
_MODULES = ("stackbounce.explorer.answers.records", "pandas", "pint", "scipy.stats",
            "scipy.signal", "scipy.io.wavfile", "scipy.optimize")  # fmt: skip
"""What a process imports before its first job, as that takes seconds."""


class Busy(StackbounceError):
    """A client has too many jobs at once."""


class TooMuch(StackbounceError):
    """A job exceeded its limit of time or memory, or its process ended."""


def _prepare(most_bytes: int) -> None:
    """Prepare a process: it ends with the server, has limited memory, and has imported all."""
    threading.Thread(target=_end_with_parent, daemon=True).start()
    with contextlib.suppress(ImportError, AttributeError):  # Windows has neither
        import resource

        os.nice(_NICE)
        _, hard = resource.getrlimit(resource.RLIMIT_DATA)
        most = most_bytes if hard == resource.RLIM_INFINITY else min(hard, most_bytes)
        resource.setrlimit(resource.RLIMIT_DATA, (most, hard))

    from stackbounce.cross2007.cases import list_cases
    from stackbounce.explorer.answers.predictions import run_drop

    run_drop(next(list_cases()).drop, None).sample([0.0])  # imports what the first run needs
    for name in _MODULES:
        importlib.import_module(name)


def _end_with_parent() -> None:
    """End this process when the server has ended, however that ended."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


class Workers:
    """Processes that compute, and the jobs that wait for them.

    No client has all processes, and the clients that wait have their turns one after another.

    Parameters
    ----------
    limits : Limits
        How many processes there are, their memory, and how many jobs a client may have.

    Examples
    --------
    >>> from stackbounce.explorer import LIMITS
    >>> workers = Workers(LIMITS)
    >>> workers.stop()
    """

    def __init__(self, limits: Limits) -> None:
        self._limits = limits
        self._pool = self._make_pool()
        self._places = asyncio.Semaphore(limits.workers)
        self._turns: dict[str, asyncio.Semaphore] = {}
        self._jobs: Counter[str] = Counter()  # that wait or run, by client

    def _make_pool(self) -> ProcessPool:
        return ProcessPool(
            max_workers=self._limits.workers,
            initializer=_prepare,
            initargs=(self._limits.worker_bytes,),
            context=multiprocessing.get_context("spawn"),  # a fork would copy the threads
        )

    def start(self) -> None:
        """Start the processes, before there are jobs for them."""
        self._pool.schedule(os.getpid)

    def stop(self) -> None:
        """End the processes, also in the middle of a job.

        They are killed before the pool closes what it shares with them: a process that has just
        begun would else write that it does not find it.
        """
        self._pool.stop()  # type: ignore[no-untyped-call]
        for process in multiprocessing.active_children():
            process.kill()
        self._pool.join()

    @contextlib.asynccontextmanager
    async def turn(self, client: str) -> AsyncIterator[None]:
        """Wait for the turn of a client's job; within the context it has a process.

        Raises
        ------
        Busy
            If too many jobs of this client run or wait.
        """
        if self._jobs[client] >= self._limits.client_jobs:
            raise Busy(f"too many requests from your address: try again in {AGAIN_SECONDS} s")
        share = max(1, self._limits.workers - 1)
        own = self._turns.setdefault(client, asyncio.Semaphore(share))
        self._jobs[client] += 1
        try:
            async with own, self._places:
                yield
        finally:
            self._jobs[client] -= 1
            if not self._jobs[client]:
                del self._jobs[client], self._turns[client]

    async def run(self, job: Callable[..., Any], *arguments: Any, seconds: float) -> Any:
        """Run a job in a worker process; return its result, or raise its error.

        Parameters
        ----------
        job : callable
            A function that can be pickled.
        *arguments
            Arguments of the function.
        seconds : float
            Time limit in s; the process is ended after it.

        Raises
        ------
        TooMuch
            If the job exceeded its limit of time or memory, or its process ended.
        """
        if not self._pool.active:  # one of its processes ended between two jobs
            self.stop()
            self._pool = self._make_pool()
        try:
            return await asyncio.wrap_future(self._pool.schedule(job, arguments, timeout=seconds))
        except TimeoutError:
            what = f"this takes longer than the {seconds:g} s that one request may"
        except MemoryError:
            what = "this needs more memory than the process of one request may have"
        except (ProcessExpired, BrokenProcessPool):
            what = "the process that computed this ended, perhaps for want of memory"
        raise TooMuch(f"{what}: ask for fewer balls, points or numbers at once")
