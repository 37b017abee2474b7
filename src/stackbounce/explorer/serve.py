"""Run the explorer: find a port, start the server, open the browser."""

import contextlib
import errno
import logging
import signal
import socket
import threading
import webbrowser
from collections.abc import Callable, Sequence
from typing import Any

from stackbounce.errors import FileError, InvalidValue, whole
from stackbounce.explorer.addresses import Place, list_places, url
from stackbounce.explorer.limits import Limits
from stackbounce.extras import need

need("web", "stackbounce app")

HOST = "127.0.0.1"
"""The default address: it can be reached from this machine only."""

PORT = 8050
"""The first port that is tried by default."""

_MORE = 20  # number of ports that are tried by default
_OWN = {"0.0.0.0": "127.0.0.1", "::": "::1"}  # how this machine itself reaches all of them
_BACKLOG = 128  # connections that wait to be accepted


def serve(
    host: str,
    port: int | None,
    limits: Limits,
    *,
    browser: bool,
    tell: Callable[[str, list[Place]], None],
    framed_by: Sequence[str] = (),
) -> None:
    """Serve the explorer until it is interrupted.

    Parameters
    ----------
    host : str
        The address to listen at; ``"0.0.0.0"`` for all of this machine's, so that a class can use
        it.
    port : int or None
        The port, or None for the first free one from `PORT`; 0 for any.
    limits : Limits
        Limits of requests and workers.
    browser : bool
        Whether to open the page.
    tell : callable
        Called with the address of the page on this machine, and with those for others, before the
        server starts; who comes early waits for it.
    framed_by : sequence of str
        The origins of the sites that may show the page in a frame.

    Raises
    ------
    FileError
        If the port is taken or cannot be used.
    InvalidValue
        If the port is not from 0 to 65535, or the host is not an address of this machine.
    """
    import uvicorn

    from stackbounce.explorer.app import create_app
    from stackbounce.explorer.guard import HEADERS

    if not host:
        raise InvalidValue(
            f"--host must be an address of this machine, such as {HOST}, or 0.0.0.0 for all, "
            "got nothing"
        )

    logging.getLogger("python_multipart").setLevel(logging.CRITICAL)  # of forms that are none
    with contextlib.closing(_open_socket(host, port)) as listening:
        port = listening.getsockname()[1]
        address, others = url(_OWN.get(host, host), port), list_places(host, port)
        config = uvicorn.Config(
            create_app(limits, others, framed_by),
            http="h11",
            ws="none",
            log_level="error",  # what clients do wrong, they are told
            backlog=_BACKLOG,
            headers=list(HEADERS.items()),
            limit_concurrency=limits.connections,
            proxy_headers=False,  # a client could say that it is another one
            server_header=False,
            timeout_graceful_shutdown=1,
            timeout_keep_alive=30,
        )

        class Server(uvicorn.Server):
            """A server that does not wait for its answers when it ends."""

            async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
                logging.getLogger("uvicorn.error").setLevel(logging.CRITICAL)
                for task in self.server_state.tasks:
                    task.cancel()
                await super().shutdown(sockets)

        before = signal.signal(signal.SIGTERM, _exit)  # uvicorn raises it again at its end
        try:
            with contextlib.suppress(KeyboardInterrupt):
                tell(address, others)
                if browser:  # in a thread: a browser for a terminal ends with its last page
                    threading.Thread(target=webbrowser.open, args=(address,), daemon=True).start()
                Server(config).run(sockets=[listening])
        finally:
            signal.signal(signal.SIGTERM, before)


def _exit(*_: Any) -> None:
    """Exit in the ordinary way, so that shared resources of the processes are released."""
    raise SystemExit(0)


def _open_socket(host: str, port: int | None) -> socket.socket:
    """Return a socket that listens at a host, and at a port or the first free one."""
    tried = [whole("port", port, 0, 65535)] if port is not None else range(PORT, PORT + _MORE)
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    problem: OSError | None = None
    for number in tried:
        listening = socket.socket(family)
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            listening.bind((host, number))
            listening.listen(_BACKLOG)
        except OSError as error:
            listening.close()
            if isinstance(error, socket.gaierror) or error.errno == errno.EADDRNOTAVAIL:
                raise InvalidValue(
                    f"--host must be an address of this machine, such as {HOST}, got {host}"
                ) from None
            problem = error
            continue
        return listening
    assert problem is not None
    raise FileError(f"{host}, port {tried[-1]} cannot be used: {problem.strerror or problem}")
