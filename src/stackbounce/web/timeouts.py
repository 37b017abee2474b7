"""How long a connection may be silent, or begin a request without ending its head."""

from typing import Any

__all__ = ["HEAD_SECONDS", "patient_protocol"]

HEAD_SECONDS = 15.0
"""In s, for the head of a request to come in whole."""


def patient_protocol(seconds: float = HEAD_SECONDS) -> type[Any]:
    """Return uvicorn's protocol, which closes connections that do not come to a request.

    Parameters
    ----------
    seconds : float, optional
        In s, from the opening of a connection, or from the first part of a further head.

    Returns
    -------
    type

    Examples
    --------
    >>> patient_protocol().__name__
    'Patient'
    """
    from uvicorn.protocols.http.h11_impl import H11Protocol

    class Patient(H11Protocol):
        """A connection that is closed where no request comes of it."""

        patience: Any = None

        def connection_made(self, transport: Any) -> None:
            super().connection_made(transport)
            self.wait()

        def data_received(self, data: bytes) -> None:
            super().data_received(data)
            if self.under_way():
                self.let_be()
            elif self.patience is None:
                self.wait()

        def connection_lost(self, exc: Exception | None) -> None:
            self.let_be()
            super().connection_lost(exc)

        def under_way(self) -> bool:
            return self.cycle is not None and not self.cycle.response_complete

        def wait(self) -> None:
            self.patience = self.loop.call_later(seconds, self.give_up)

        def let_be(self) -> None:
            if self.patience is not None:
                self.patience.cancel()
                self.patience = None

        def give_up(self) -> None:
            self.patience = None
            if not self.under_way():
                self.transport.close()

    return Patient
