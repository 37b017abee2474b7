"""Connections: how long they may be silent, and how many of them a client may have."""

import json
from collections import Counter
from typing import Any

from stackbounce.explorer.limits import Limits
from stackbounce.explorer.shares import AGAIN_SECONDS, client_of

__all__ = ["make_protocol"]


def make_protocol(limits: Limits) -> type[Any]:
    """Return uvicorn's HTTP protocol, with limits of connections.

    A connection is closed if the whole head of a request does not come in time. Where a client has
    more connections than its share, or all together have too many, one of those that the server
    waits for is closed: the one that has been silent for longest. If the server waits for none,
    the new one is refused.

    Parameters
    ----------
    limits : Limits
        How many connections there may be, and for how long each may be silent.

    Returns
    -------
    type

    Examples
    --------
    >>> from stackbounce.explorer import LIMITS
    >>> make_protocol(LIMITS).__name__
    'LimitedProtocol'
    """
    from uvicorn.protocols.http.h11_impl import H11Protocol

    every: set[Any] = set()  # connections that are open, but for those that are being ended

    class LimitedProtocol(H11Protocol):
        """A connection with a timeout, which belongs to a client."""

        timer: Any = None
        owner = ""
        since = 0.0

        def connection_made(self, transport: Any) -> None:
            super().connection_made(transport)
            self.owner = client_of({"client": self.client})
            self.since = self.loop.time()
            self.start_timer()
            every.add(self)
            self.make_room()

        def data_received(self, data: bytes) -> None:
            super().data_received(data)
            if self.is_answering():
                self.cancel_timer()
            elif self.timer is None:
                self.start_timer()

        def on_response_complete(self) -> None:
            self.since = self.loop.time()
            super().on_response_complete()

        def connection_lost(self, exc: Exception | None) -> None:
            every.discard(self)
            self.cancel_timer()
            super().connection_lost(exc)

        def is_answering(self) -> bool:
            return self.cycle is not None and not self.cycle.response_complete

        def is_waiting(self) -> bool:
            """Return whether the next move is the client's."""
            return not self.is_answering() or self.cycle.more_body

        def make_room(self) -> None:
            """End one connection if this client, or all together, have too many."""
            counts = Counter(one.owner for one in every)
            owner = self.owner
            if counts[owner] <= limits.client_connections:
                if len(every) <= limits.connections:
                    return
                owner = counts.most_common(1)[0][0]
            others = (one for one in every if one.owner == owner and one is not self)
            if silent := [one for one in others if one.is_waiting()]:
                min(silent, key=lambda one: one.since).end()
            else:
                self.refuse()

        def end(self) -> None:
            """Close the connection at once, also if its client does not read what was sent."""
            every.discard(self)
            self.transport.abort()

        def refuse(self) -> None:
            """Say that there is no room, and close the connection."""
            detail = f"too many connections at once: try again in {AGAIN_SECONDS} s"
            body = json.dumps({"detail": detail})
            head = (
                "HTTP/1.1 503 Service Unavailable\r\ncontent-type: application/json\r\n"
                f"content-length: {len(body)}\r\nretry-after: {AGAIN_SECONDS}\r\n"
                "connection: close\r\n\r\n"
            )
            every.discard(self)
            self.transport.write((head + body).encode())
            self.transport.close()

        def start_timer(self) -> None:
            self.timer = self.loop.call_later(limits.head_seconds, self.close_idle)

        def cancel_timer(self) -> None:
            if self.timer is not None:
                self.timer.cancel()
                self.timer = None

        def close_idle(self) -> None:
            self.timer = None
            if not self.is_answering():
                self.transport.close()

    return LimitedProtocol
