"""Worker processes: the server never computes itself; each job has limits of time and memory."""

import asyncio
import contextlib
import functools
import importlib
import math
import multiprocessing
import os
import threading
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from typing import Any

from stackbounce.errors import StackbounceError
from stackbounce.explorer.limits import Limits
from stackbounce.explorer.shares import Shares
from stackbounce.explorer.turns import Turns

__all__ = ["TooMuch", "Workers"]

_LESS = "ask for fewer balls, points or numbers at once"
_SHORT = ("stackbounce.explorer.answers.maps",)
_LONG = (*_SHORT, "stackbounce.explorer.answers.records", "scipy.stats", "scipy.signal",
         "scipy.io.wavfile", "lmfit")  # fmt: skip
"""What a process imports before its first job: what measures and fits needs seconds."""


class TooMuch(StackbounceError):
    """A job exceeded its limit of time or memory, or its process ended."""


def _prepare(most_bytes: int, nice: int, modules: Sequence[str]) -> None:
    """Prepare a process: it ends with the server, has limited memory, and has imported all."""
    threading.Thread(target=_end_with_parent, daemon=True).start()
    with contextlib.suppress(ImportError, AttributeError):  # Windows has neither
        import resource

        os.nice(nice)

        _, hard = resource.getrlimit(resource.RLIMIT_DATA)
        most = most_bytes if hard == resource.RLIM_INFINITY else min(hard, most_bytes)
        resource.setrlimit(resource.RLIMIT_DATA, (most, hard))

    from stackbounce.cross2007.cases import list_cases
    from stackbounce.explorer.answers.play import play_drop

    play_drop(
        next(list_cases()).drop, until=None, frames=2
    )  # libraries import parts when first used
    for name in modules:
        with contextlib.suppress(ImportError):  # of an extra
            importlib.import_module(name)


def _end_with_parent() -> None:
    """End this process when the server has ended, however that ended."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


class _Worker:
    """A process that computes one job at a time."""

    def __init__(self, limits: Limits, nice: int, modules: Sequence[str]) -> None:
        self._ended = False
        others = set(multiprocessing.active_children())
        self._executor = ProcessPoolExecutor(
            max_workers=1,
            mp_context=multiprocessing.get_context("spawn"),  # a fork would copy the threads
            initializer=_prepare,
            initargs=(limits.worker_bytes, nice, modules),
        )
        self._prepared = self._executor.submit(os.getpid)
        (self._process,) = set(multiprocessing.active_children()) - others

    @property
    def ready(self) -> bool:
        """Whether the process is prepared."""
        return self._prepared.done()

    @property
    def alive(self) -> bool:
        """Whether the process can take a job."""
        return not self._ended and self._process.is_alive()

    async def compute(self, job: Callable[[], Any], seconds: float, abandoned: float) -> Any:
        """Return the result of a job; end the process if it takes too long, or more memory.

        If this is cancelled, nobody waits for the result: then `abandoned` is the limit in s.
        """
        try:
            prepared = asyncio.wrap_future(self._prepared)
            prepared.add_done_callback(_forget)  # this may be cancelled before it ends
            await asyncio.shield(prepared)
            computing = asyncio.get_running_loop().run_in_executor(self._executor, job)
            computing.add_done_callback(_forget)
            await self._wait(computing, seconds, abandoned)
            return computing.result()
        except BrokenProcessPool:
            self.end()
            raise TooMuch(
                f"the process that computed this ended, perhaps for want of memory: {_LESS}"
            ) from None
        except MemoryError:
            self.end()
            raise TooMuch(
                f"this needs more memory than the process of one request may have: {_LESS}"
            ) from None

    async def _wait(self, computing: asyncio.Future[Any], seconds: float, abandoned: float) -> None:
        """Wait for a job, and end it after its time."""
        start = time.monotonic()
        try:
            await asyncio.wait({computing}, timeout=seconds)
        except asyncio.CancelledError:
            left = min(seconds, abandoned) - (time.monotonic() - start)
            await asyncio.wait({computing}, timeout=max(0.0, left))
            raise
        finally:
            if not computing.done():
                computing.cancel()
                self.end()
        if computing.cancelled():
            raise TooMuch(f"this takes longer than the {seconds:g} s that one request may: {_LESS}")

    def end(self) -> None:
        """End the process, also in the middle of a job."""
        self._ended = True
        self._process.kill()
        self._executor.shutdown(wait=False, cancel_futures=True)

    def join(self) -> None:
        """Wait until the process has ended."""
        self._executor.shutdown(wait=True)


class _Lane:
    """Processes of the same priority, and the jobs that wait for them.

    Parameters
    ----------
    limits : Limits
        How many processes there are.
    nice : int
        How much lower their priority is than the server's.
    abandoned : float
        Time in s after which a job whose client has gone is ended with its process. Another process
        needs seconds until it is ready.
    modules : sequence of str
        What a process imports before its first job.
    """

    def __init__(self, limits: Limits, nice: int, abandoned: float, modules: Sequence[str]) -> None:
        self._limits, self._nice, self._abandoned = limits, nice, abandoned
        self._modules = modules
        self._turns = Turns(limits.workers)
        self._idle: list[_Worker] = []
        self._busy: list[_Worker] = []
        self._stopped = False

    def start(self, count: int) -> None:
        """Start so many processes, before there are jobs for them."""
        self._idle = [self._make_worker() for _ in range(count)]

    def stop(self) -> None:
        """End the processes, also in the middle of a job."""
        self._stopped = True
        every = [*self._idle, *self._busy]
        for worker in every:
            worker.end()
        for worker in every:
            worker.join()

    async def compute(self, job: Callable[[], Any], seconds: float, client: str) -> Any:
        """Compute a job when its turn has come."""
        async with self._turns.turn(client):
            if self._stopped:
                raise TooMuch("the server has ended")
            worker = self._find_idle()
            self._busy.append(worker)
            try:
                return await worker.compute(job, seconds, self._abandoned)
            finally:
                self._busy.remove(worker)
                if not self._stopped:  # the one that worked last has imported most
                    self._idle.insert(0, worker if worker.alive else self._make_worker())

    def _find_idle(self) -> _Worker:
        """Take an idle process, one that is ready if there is any; start one if all are busy."""
        self._idle = [worker for worker in self._idle if worker.alive] or [self._make_worker()]
        worker = next((one for one in self._idle if one.ready), self._idle[0])
        self._idle.remove(worker)
        return worker

    def _make_worker(self) -> _Worker:
        return _Worker(self._limits, self._nice, self._modules)


class Workers:
    """Processes for short jobs and as many for long ones, and the jobs that wait for them.

    Parameters
    ----------
    limits : Limits
        How many processes there are, and how many jobs may wait.

    Examples
    --------
    >>> from stackbounce.explorer import LIMITS
    >>> workers = Workers(LIMITS)
    >>> workers.stop()
    """

    def __init__(self, limits: Limits) -> None:
        self._shares = Shares("too many requests", limits.waiting, limits.client_waiting)
        self._workers = limits.workers
        self._short = _Lane(limits, nice=0, abandoned=math.inf, modules=_SHORT)
        self._long = _Lane(limits, nice=5, abandoned=2.0, modules=_LONG)

    def start(self) -> None:
        """Start the processes for short jobs and one for long ones; others start when needed."""
        self._short.start(self._workers)
        self._long.start(1)

    def stop(self) -> None:
        """End the processes, also in the middle of a job."""
        self._short.stop()
        self._long.stop()

    async def run(
        self,
        job: Callable[..., Any],
        *arguments: Any,
        seconds: float,
        client: str = "",
        short: bool = False,
    ) -> Any:
        """Run a job in a worker process; return its result, or raise its error.

        If this is cancelled, because the client has gone, the job is taken out of its queue. One
        that runs already is ended soon.

        Parameters
        ----------
        job : callable
            A function that can be pickled.
        *arguments
            Arguments of the function.
        seconds : float
            Time limit in s; the process is ended after it.
        client : str, optional
            Who asks: each client has its turn.
        short : bool, optional
            Whether the job should take less than a second.

        Raises
        ------
        Busy
            If too many jobs are waiting.
        TooMuch
            If the job exceeded its limit of time or memory, or its process ended.
        """
        lane = self._short if short else self._long
        self._shares.take(client)
        try:
            work = lane.compute(functools.partial(job, *arguments), seconds, client)
            computing = asyncio.create_task(work)  # of its own: it may have to outlast the client
            computing.add_done_callback(_forget)
            try:
                await asyncio.wait({computing})
            finally:
                computing.cancel()
            return computing.result()
        finally:
            self._shares.give_back(client)


def _forget(task: asyncio.Future[Any]) -> None:
    """Take note of an error for which nobody waits, and which asyncio would report otherwise."""
    if not task.cancelled():
        task.exception()
