"""Timeouts of connections: those that send no request, or its head too slowly, are closed."""

from typing import Any

__all__ = ["HEAD_SECONDS", "make_protocol"]

HEAD_SECONDS = 15.0
"""Time in s in which the whole head of a request must arrive."""


def make_protocol(seconds: float = HEAD_SECONDS) -> type[Any]:
    """Return uvicorn's HTTP protocol with a timeout for the head of a request.

    Parameters
    ----------
    seconds : float, optional
        Timeout in s, from the opening of a connection or from the first bytes of a further head.

    Returns
    -------
    type

    Examples
    --------
    >>> make_protocol().__name__
    'TimeoutProtocol'
    """
    from uvicorn.protocols.http.h11_impl import H11Protocol

    class TimeoutProtocol(H11Protocol):
        """A connection that is closed if no whole request head arrives in time."""

        timer: Any = None

        def connection_made(self, transport: Any) -> None:
            super().connection_made(transport)
            self.start_timer()

        def data_received(self, data: bytes) -> None:
            super().data_received(data)
            if self.is_answering():
                self.cancel_timer()
            elif self.timer is None:
                self.start_timer()

        def connection_lost(self, exc: Exception | None) -> None:
            self.cancel_timer()
            super().connection_lost(exc)

        def is_answering(self) -> bool:
            return self.cycle is not None and not self.cycle.response_complete

        def start_timer(self) -> None:
            self.timer = self.loop.call_later(seconds, self.close_idle)

        def cancel_timer(self) -> None:
            if self.timer is not None:
                self.timer.cancel()
                self.timer = None

        def close_idle(self) -> None:
            self.timer = None
            if not self.is_answering():
                self.transport.close()

    return TimeoutProtocol
