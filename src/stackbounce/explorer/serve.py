"""Run the explorer: find a port, start a server, open the browser.

With the extra ``app`` the server is `app`, which also measures and fits. Without it the standard
library's serves the one file, which plays.
"""

import contextlib
import errno
import logging
import signal
import socket
import threading
import webbrowser
from collections.abc import Callable, Sequence
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

from stackbounce.errors import FileError, InvalidValue, whole
from stackbounce.explorer.addresses import Place, list_places, url
from stackbounce.explorer.framing import frame_rule
from stackbounce.explorer.limits import Limits
from stackbounce.explorer.made import HEADERS, PAGE, made_file, one_file
from stackbounce.extras import is_installed

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
        If the port is taken or cannot be used, or the page was not made.
    InvalidValue
        If the port is not from 0 to 65535, or the host is not an address of this machine.
    """
    if not host:
        raise InvalidValue(
            f"--host must be an address of this machine, such as {HOST}, or 0.0.0.0 for all, "
            "got nothing"
        )

    with contextlib.closing(_open_socket(host, port)) as listening:
        port = listening.getsockname()[1]
        address, others = url(_OWN.get(host, host), port), list_places(host, port)
        if is_installed("app"):
            run = _measuring_server(listening, limits, others, framed_by)
        else:
            run = _playing_server(listening, framed_by)
        before = signal.signal(signal.SIGTERM, _exit)  # uvicorn raises it again at its end
        try:
            with contextlib.suppress(KeyboardInterrupt):
                tell(address, others)
                if browser:  # in a thread: a browser for a terminal ends with its last page
                    threading.Thread(target=webbrowser.open, args=(address,), daemon=True).start()
                run()
        finally:
            signal.signal(signal.SIGTERM, before)


def _measuring_server(
    listening: socket.socket, limits: Limits, others: list[Place], framed_by: Sequence[str]
) -> Callable[[], None]:
    """Return what runs the server that also measures and fits."""
    import uvicorn

    from stackbounce.explorer.app import create_app

    class Server(uvicorn.Server):
        """A server that does not wait for its answers when it ends."""

        async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
            logging.getLogger("uvicorn.error").setLevel(logging.CRITICAL)
            for task in self.server_state.tasks:
                task.cancel()
            await super().shutdown(sockets)

    made_file(PAGE)  # if there is none, it is told now
    logging.getLogger("python_multipart").setLevel(logging.CRITICAL)  # of forms that are none
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
    return lambda: Server(config).run(sockets=[listening])


def _playing_server(listening: socket.socket, framed_by: Sequence[str]) -> Callable[[], None]:
    """Return what runs the server of the one file."""
    page = one_file().encode()

    class Answer(BaseHTTPRequestHandler):
        """The page at the address ``/``, and nothing at any other."""

        timeout = 30  # s without a word from the client

        def do_GET(self) -> None:
            found = self.path.split("?")[0] == "/"
            self.send_response(200 if found else 404)
            known = {"content-type": "text/html", "content-length": len(page) if found else 0}
            for name, value in {**HEADERS, **known}.items():
                self.send_header(name, str(value))
            self.send_header("content-security-policy", frame_rule(framed_by))
            self.end_headers()
            if found:
                self.wfile.write(page)

        def log_message(self, *_: Any) -> None:
            """Say nothing of requests."""

    class Server(ThreadingHTTPServer):
        """A server that is silent where a client has gone."""

        def handle_error(self, *_: Any) -> None:
            """Say nothing of connections that ended early."""

    server = Server(listening.getsockname()[:2], Answer, bind_and_activate=False)
    server.socket.close()
    server.socket = listening
    return server.serve_forever


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
