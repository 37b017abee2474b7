"""Which requests are let in at all, and the headers that every answer has.

The server belongs to the page that it serves: pages of other sites must not use it behind their
reader's back, so a request has to name this machine, and must not come from elsewhere.
"""

import asyncio
import contextlib
import ipaddress
import json
import re
import socket
from collections.abc import Awaitable, Callable, MutableMapping
from typing import Any

from stackbounce.web.limits import Limits

__all__ = ["PAPER", "Guard"]

_Message = MutableMapping[str, Any]
_Receive = Callable[[], Awaitable[_Message]]
_Send = Callable[[_Message], Awaitable[None]]
_App = Callable[[_Message, _Receive, _Send], Awaitable[None]]

_PAGE = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
PAPER = (
    "default-src 'none'; style-src 'self' 'unsafe-inline'; img-src 'self' data:; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
"""What a page of the paper may load: it is one file with all its style and pictures inside."""

_HEADERS = {
    "x-content-type-options": "nosniff",
    "x-frame-options": "DENY",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "cross-origin-embedder-policy": "require-corp",
    "permissions-policy": "camera=(), geolocation=(), microphone=()",
    "cache-control": "no-cache",
}
_HOST = re.compile(r"(\[[0-9A-Fa-f:.]+\]|[\w.-]+)(?::\d{1,5})?", re.ASCII)
_POLICY = b"content-security-policy"
_LINGER = 3.0  # s, for which a refused request is listened to
_PATIENCE = 8  # times an upload, of a refused request that is still taken
_UPLOADS = ("/api/measure", "/api/fit")


class _Refused(Exception):
    """A request that is not let in."""

    def __init__(self, status: int, detail: str) -> None:
        super().__init__(detail)
        self.status, self.detail = status, detail


class Guard:
    """An ASGI application around another one.

    Parameters
    ----------
    app : callable
        What answers the requests that are let in.
    limits : Limits
        How large a request may be, and how long it may take to come.

    Examples
    --------
    >>> from stackbounce.web import LIMITS
    >>> guard = Guard(None, LIMITS)
    """

    def __init__(self, app: Any, limits: Limits) -> None:
        self._app, self._limits = app, limits
        self._held = 0
        self._names = {"localhost", socket.gethostname().casefold()}

    async def __call__(self, scope: _Message, receive: _Receive, send: _Send) -> None:
        """Answer one request, or refuse it."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        headers = {
            key.decode("latin-1"): value.decode("latin-1") for key, value in scope["headers"]
        }
        answer = _with_headers(send, scope["path"])
        body = bytearray()
        try:
            self._check(scope, headers)
            await self._receive(body, scope, headers, receive)
            await self._app(scope, _replayed(bytes(body), receive), answer)
        except _Refused as refused:
            await self._let_out(receive)
            await _refuse(answer, refused)
        finally:
            self._held -= len(body)

    def _check(self, scope: _Message, headers: dict[str, str]) -> None:
        host = headers.get("host", "")
        if not self._is_here(host):
            raise _Refused(
                400, f"this server answers to its own address only, not to {host[:60]!r}"
            )
        origin = headers.get("origin")
        if origin is not None and origin.casefold() != f"http://{host.casefold()}":
            raise _Refused(403, "pages of other sites cannot use this server")
        site, mode = headers.get("sec-fetch-site", "").casefold(), headers.get("sec-fetch-mode")
        followed = mode == "navigate" and scope["method"] == "GET"  # a link may lead here
        if site in ("cross-site", "same-site") and not followed:
            raise _Refused(403, "pages of other sites cannot use this server")

    def _is_here(self, host: str) -> bool:
        """Tell whether a name is this machine's: any other may have been made to lead here."""
        found = _HOST.fullmatch(host)
        if found is None:
            return False
        name = found[1].strip("[]").casefold()
        if name in self._names:
            return True
        try:
            ipaddress.ip_address(name)
        except ValueError:
            return False
        return True

    async def _receive(
        self, body: bytearray, scope: _Message, headers: dict[str, str], receive: _Receive
    ) -> None:
        """Receive a request's body, if it is small enough and comes in time."""
        limits = self._limits
        most = limits.upload_bytes if scope["path"] in _UPLOADS else limits.body_bytes
        length = headers.get("content-length", "0")
        if length.isdecimal() and int(length) > most:
            raise _too_large(most)
        try:
            async with asyncio.timeout(limits.upload_seconds):
                while True:
                    message = await receive()
                    if message["type"] != "http.request":
                        raise _Refused(400, "the request ended before it was whole")
                    part = message.get("body", b"")
                    body += part
                    self._held += len(part)
                    if len(body) > most:
                        raise _too_large(most)
                    if self._held > limits.held_bytes:
                        raise _Refused(503, "too much is being sent at once: try again soon")
                    if not message.get("more_body", False):
                        return
        except TimeoutError:
            seconds = limits.upload_seconds
            raise _Refused(408, f"the request did not come in whole within {seconds:g} s") from None

    async def _let_out(self, receive: _Receive) -> None:
        """Take what still comes of a refused request, so that its sender listens to the answer."""
        left = _PATIENCE * self._limits.upload_bytes
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(_LINGER):
                while left > 0:
                    message = await receive()
                    left -= len(message.get("body", b""))
                    if message["type"] != "http.request" or not message.get("more_body", False):
                        return


def _too_large(most: int) -> _Refused:
    size = f"{most >> 20} MiB" if most >= 1 << 20 else f"{most >> 10} KiB"
    return _Refused(413, f"the request is larger than {size}: send less, such as a shorter record")


def _replayed(body: bytes, receive: _Receive) -> _Receive:
    """Return what hands out a body that was received already."""
    left = [body]

    async def again() -> _Message:
        if left:
            return {"type": "http.request", "body": left.pop(), "more_body": False}
        return await receive()

    return again


def _with_headers(send: _Send, path: str) -> _Send:
    """Return what sends an answer with the headers that all answers have."""
    policy = PAPER if path.startswith("/paper") else _PAGE
    own = [
        (name.encode(), value.encode())
        for name, value in (_HEADERS | {"content-security-policy": policy}).items()
    ]
    names = {name for name, _ in own}

    async def answer(message: _Message) -> None:
        if message["type"] == "http.response.start":
            paper = path.startswith("/paper")  # which tells its own scripts, if it has any
            kept = {_POLICY} if paper and _POLICY in dict(message["headers"]) else set()
            given = [one for one in message["headers"] if one[0] not in names - kept]
            message = {**message, "headers": given + [one for one in own if one[0] not in kept]}
        await send(message)

    return answer


async def _refuse(send: _Send, refused: _Refused) -> None:
    body = json.dumps({"detail": refused.detail}).encode()
    headers = [
        (b"content-type", b"application/json"),
        (b"content-length", str(len(body)).encode()),
        (b"connection", b"close"),
    ]
    await send({"type": "http.response.start", "status": refused.status, "headers": headers})
    await send({"type": "http.response.body", "body": body})
