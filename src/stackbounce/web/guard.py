"""Admission of requests, and the security headers of every answer.

Only the page that this server serves may use it, not the pages of other sites that are open in the
same browser. So a request must name this machine as its host, and must not come from another site.
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
"""The content security policy of the paper's pages, which hold their styles and pictures inline."""

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
_DRAIN_SECONDS = 3.0  # s, for which a refused request is still read
_DRAINED = 8  # most uploads' worth of bytes that is read of a refused request
_UPLOADS = ("/api/measure", "/api/fit")


class _Refused(Exception):
    """A request is refused."""

    def __init__(self, status: int, detail: str) -> None:
        super().__init__(detail)
        self.status, self.detail = status, detail


class Guard:
    """An ASGI application that checks requests before it passes them to another one.

    Parameters
    ----------
    app : callable
        The ASGI application that answers admitted requests.
    limits : Limits
        Limits of the size of a request and of the time in which it must arrive.

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
        answer = _add_headers(send, scope["path"])
        body = bytearray()
        try:
            self._check(scope, headers)
            await self._receive(body, scope, headers, receive)
            await self._app(scope, _replay(bytes(body), receive), answer)
        except _Refused as refused:
            await self._drain(receive)
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
        followed = (
            mode == "navigate" and scope["method"] == "GET"
        )  # a link on another site may lead here
        if site in ("cross-site", "same-site") and not followed:
            raise _Refused(403, "pages of other sites cannot use this server")

    def _is_here(self, host: str) -> bool:
        """Return whether a host is a name of this machine or an IP address.

        Any other name is refused, as its owner may have pointed it at this machine: DNS rebinding.
        """
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
        """Receive the body of a request; refuse one that is too large or too slow."""
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

    async def _drain(self, receive: _Receive) -> None:
        """Read the rest of a refused request: many clients send all before they read an answer."""
        left = _DRAINED * self._limits.upload_bytes
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(_DRAIN_SECONDS):
                while left > 0:
                    message = await receive()
                    left -= len(message.get("body", b""))
                    if message["type"] != "http.request" or not message.get("more_body", False):
                        return


def _too_large(most: int) -> _Refused:
    size = f"{most >> 20} MiB" if most >= 1 << 20 else f"{most >> 10} KiB"
    return _Refused(413, f"the request is larger than {size}: send less, such as a shorter record")


def _replay(body: bytes, receive: _Receive) -> _Receive:
    """Return a `receive` that delivers a body that was already received."""
    left = [body]

    async def again() -> _Message:
        if left:
            return {"type": "http.request", "body": left.pop(), "more_body": False}
        return await receive()

    return again


def _add_headers(send: _Send, path: str) -> _Send:
    """Return a `send` that adds the security headers to an answer."""
    policy = PAPER if path.startswith("/paper") else _PAGE
    own = [
        (name.encode(), value.encode())
        for name, value in (_HEADERS | {"content-security-policy": policy}).items()
    ]
    names = {name for name, _ in own}

    async def answer(message: _Message) -> None:
        if message["type"] == "http.response.start":
            paper = path.startswith("/paper")  # its policy may list its own scripts
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
