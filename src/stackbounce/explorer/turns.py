"""Turns: which of the waiting jobs is next, so that no client makes others wait for long."""

import asyncio
import contextlib
from collections import Counter, deque
from collections.abc import AsyncIterator, Iterator

__all__ = ["Turns"]


class Turns:
    """A few places, and a queue for each client; the clients have their turns one after another.

    Parameters
    ----------
    places : int
        How many jobs run at once. A client has all places but one at most, so that there is one
        for the others. If there is only one place, each may have it.

    Examples
    --------
    >>> turns = Turns(2)
    """

    def __init__(self, places: int) -> None:
        self._places, self._share = places, max(1, places - 1)
        self._running: Counter[str] = Counter()
        self._queues: dict[str, deque[asyncio.Future[None]]] = {}  # in the order of their turns

    @contextlib.asynccontextmanager
    async def turn(self, client: str) -> AsyncIterator[None]:
        """Wait for the turn of a client's job; the job has a place within the context."""
        called: asyncio.Future[None] = asyncio.get_running_loop().create_future()
        self._queues.setdefault(client, deque()).append(called)
        self._call_next()
        try:
            await called
            yield
        finally:
            if called.cancelled():
                self._remove(client, called)
            else:
                self._running -= Counter([client])
            self._call_next()

    def _call_next(self) -> None:
        """Call jobs as long as there are places for them."""
        while self._running.total() < self._places:
            found = next(self._find_callable(), None)
            if found is None:
                return
            client, called = found
            self._remove(client, called)
            if client in self._queues:
                self._queues[client] = self._queues.pop(client)  # the others come first now
            self._running[client] += 1
            called.set_result(None)

    def _find_callable(self) -> Iterator[tuple[str, asyncio.Future[None]]]:
        """Yield the jobs that may be called, in the order of their turns."""
        for client, queue in self._queues.items():
            if self._running[client] < self._share:
                yield from ((client, called) for called in queue if not called.done())

    def _remove(self, client: str, called: asyncio.Future[None]) -> None:
        self._queues[client].remove(called)
        if not self._queues[client]:
            del self._queues[client]
