"""A pool of worker processes: the server never computes itself, and every job has a time limit."""

import asyncio
import concurrent.futures
import multiprocessing
from collections.abc import Callable
from typing import Any

from stackbounce.errors import StackbounceError
from stackbounce.web.limits import Limits

__all__ = ["Busy", "TooLong", "Workers"]


class Busy(StackbounceError):
    """Too many jobs are waiting."""


class TooLong(StackbounceError):
    """A job exceeded its time limit, or its process ended."""


def _import_answers() -> None:
    """Import what most answers need, so that no request waits for it."""
    import xarray  # noqa: F401

    import stackbounce.web.answers.maps
    import stackbounce.web.answers.play  # noqa: F401


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
    >>> workers.stop()
    """

    def __init__(self, limits: Limits) -> None:
        self._context = multiprocessing.get_context("spawn")  # a fork would copy the threads
        self._limits = limits
        self._jobs = 0
        self._stopped = False
        self._pool = self._make_pool()

    def _make_pool(self) -> Any:
        from pebble import ProcessPool

        return ProcessPool(self._limits.workers, initializer=_import_answers, context=self._context)

    def start(self) -> None:
        """Start the processes, before the first request comes."""
        self._pool.submit(_import_answers, None)

    def stop(self) -> None:
        """End the processes, also in the middle of a job."""
        self._stopped = True
        self._pool.stop()
        self._pool.join(timeout=5.0)

    def _submit(self, job: Callable[..., Any], seconds: float, *arguments: Any) -> Any:
        """Submit a job; start new processes first if the pool was stopped from outside."""
        if not self._pool.active and not self._stopped:
            self._pool.stop()
            self._pool = self._make_pool()
        return self._pool.submit(job, seconds, *arguments)

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
        Busy
            If too many jobs are waiting.
        TooLong
            If the job exceeded its time limit, or its process ended.
        """
        from concurrent.futures.process import BrokenProcessPool

        from pebble import ProcessExpired

        if self._jobs >= self._limits.waiting:
            raise Busy(
                f"{self._limits.waiting} requests are being computed already: "
                "wait a few seconds and try again"
            )
        self._jobs += 1
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
            self._jobs -= 1
