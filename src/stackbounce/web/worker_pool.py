"""Processes that compute: no job holds up the server, and none runs longer than it may."""

import asyncio
import concurrent.futures
import multiprocessing
from collections.abc import Callable
from typing import Any

from stackbounce.errors import StackbounceError
from stackbounce.web.answers.compile_all import begin, prepared
from stackbounce.web.limits import Limits

__all__ = ["Busy", "TooLong", "Workers"]


class Busy(StackbounceError):
    """More is asked for than can be answered now."""


class TooLong(StackbounceError):
    """A job that took longer than it may."""


class Workers:
    """A few processes, and a queue of jobs for them.

    Parameters
    ----------
    limits : Limits
        How many processes, and how many jobs may wait.

    Examples
    --------
    >>> from stackbounce.web import LIMITS
    >>> workers = Workers(LIMITS)
    >>> workers.ready
    False
    >>> workers.stop()
    """

    def __init__(self, limits: Limits) -> None:
        self._context = multiprocessing.get_context("spawn")  # a fork would copy the threads
        self._limits = limits
        self._ready = self._context.Event()
        self._under_way = 0
        self._stopped = False
        self._pool = self._processes()

    def _processes(self) -> Any:
        from pebble import ProcessPool

        return ProcessPool(
            self._limits.workers,
            initializer=begin,
            initargs=(self._context.Lock(), self._ready),
            context=self._context,
        )

    @property
    def ready(self) -> bool:
        """Whether the compiled kernels are there: the first start on a machine compiles them."""
        return self._ready.is_set()

    def start(self) -> None:
        """Start the processes now, which begin to load the compiled kernels."""
        for _ in range(self._limits.workers):
            self._pool.submit(prepared, None)

    def stop(self) -> None:
        """End the processes, whatever they do."""
        self._stopped = True
        self._pool.stop()
        self._pool.join(timeout=5.0)

    def _submit(self, job: Callable[..., Any], seconds: float, *arguments: Any) -> Any:
        """Hand a job to the processes; to new ones, if these have been ended from outside."""
        if not self._pool.active and not self._stopped:
            self._pool.stop()
            self._pool = self._processes()
        return self._pool.submit(job, seconds, *arguments)

    async def run(self, job: Callable[..., Any], *arguments: Any, seconds: float) -> Any:
        """Return what a job returns, or raise what it raises.

        Parameters
        ----------
        job : callable
            A function of a module, which goes to another process by its name.
        *arguments
            For it.
        seconds : float
            After which its process is ended.

        Raises
        ------
        Busy
            If too many jobs are waiting.
        TooLong
            If it was ended.
        """
        from concurrent.futures.process import BrokenProcessPool

        from pebble import ProcessExpired

        if self._under_way >= self._limits.waiting:
            raise Busy(
                f"{self._limits.waiting} requests are being computed already: "
                "wait a few seconds and try again"
            )
        self._under_way += 1
        try:
            return await asyncio.wrap_future(self._submit(job, seconds, *arguments))
        except (ProcessExpired, BrokenProcessPool):
            raise TooLong(
                "the process that computed this ended, perhaps for want of memory: "
                "ask for fewer balls, points or numbers at once"
            ) from None
        except concurrent.futures.TimeoutError:
            raise TooLong(
                f"this takes longer than the {seconds:g} s that one request may: "
                "ask for fewer balls, points or numbers at once"
            ) from None
        finally:
            self._under_way -= 1
