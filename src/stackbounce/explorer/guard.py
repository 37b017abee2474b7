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
import threading
from collections.abc import Awaitable, Callable, MutableMapping, Sequence
from typing import Any

from stackbounce.explorer.framing import frame_rule
from stackbounce.explorer.limits import Limits
from stackbounce.explorer.page.policy import PAGE
from stackbounce.explorer.shares import AGAIN_SECONDS, Busy, Shares, client_of

__all__ = ["PAPER", "Guard"]

_Message = MutableMapping[str, Any]
_Receive = Callable[[], Awaitable[_Message]]
_Send = Callable[[_Message], Awaitable[None]]
_App = Callable[[_Message, _Receive, _Send], Awaitable[None]]

_FRAMED = ("/", "/index.html")  # the addresses of the page, which other sites may frame if asked
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
    "permissions-policy": "camera=(), geolocation=(), microphone=(self)",
    "cache-control": "no-cache",
}
_HOST = re.compile(r"(\[[0-9A-Fa-f:.]+\]|[\w.-]+)(?::\d{1,5})?", re.ASCII)
_POLICY = b"content-security-policy"
_DRAIN_SECONDS = 3.0  # s, for which a refused request is still read
_DRAINED = 8  # most uploads' worth of bytes that is read of a refused request
_PART = 1 << 16  # bytes of a body that are passed on at once
_UPLOADS = ("/api/measure", "/api/fit")


class _Refused(Exception):
    """A request is refused."""

    def __init__(self, status: int, detail: str) -> None:
        super().__init__(detail)
        self.status = status


class Guard:
    """An ASGI application that checks requests before it passes them to another one.

    Parameters
    ----------
    app : callable
        The ASGI application that answers admitted requests.
    limits : Limits
        Limits of the size of a request and of the time in which it must arrive.
    framed_by : sequence of str
        The origins of the sites that may show the page in a frame.

    Examples
    --------
    >>> from stackbounce.explorer import LIMITS
    >>> guard = Guard(None, LIMITS)
    """

    def __init__(self, app: Any, limits: Limits, framed_by: Sequence[str] = ()) -> None:
        self._app, self._limits, self._framed_by = app, limits, framed_by
        self._held = Shares("too much data", limits.held_bytes, limits.client_bytes)
        self._names = _find_names()

    async def __call__(self, scope: _Message, receive: _Receive, send: _Send) -> None:
        """Answer one request, or refuse it."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        headers = {
            key.decode("latin-1"): value.decode("latin-1") for key, value in scope["headers"]
        }
        answer = _Answer(send, scope["path"], self._framed_by)
        coming = _Coming(receive)
        body = bytearray()
        try:
            self._check(scope, headers)
            await self._receive(body, scope, headers, coming)
            await self._pass_on(scope, bytes(body), receive, answer)
        except (_Refused, Busy) as refused:
            await self._drain(coming)
            await answer.refuse(refused.status, str(refused))
        except asyncio.CancelledError:  # the server ends
            await answer.refuse(503, f"the server ends: try again in {AGAIN_SECONDS} s")
        finally:
            self._held.give_back(client_of(scope), len(body))

    async def _pass_on(
        self, scope: _Message, body: bytes, receive: _Receive, answer: "_Answer"
    ) -> None:
        """Let the application answer a request, unless its client goes away before."""
        leaving = asyncio.ensure_future(receive())  # after a whole body, only this is left to come
        answering = asyncio.ensure_future(self._app(scope, _replay(body, leaving), answer.send))
        try:
            await asyncio.wait({leaving, answering}, return_when=asyncio.FIRST_COMPLETED)
            if answer.complete or answering.done():
                await answering
        finally:
            for task in (leaving, answering):
                task.cancel()
            await asyncio.wait({leaving, answering})
            if not answering.cancelled():
                answering.exception()  # it is raised above, or its client has gone

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
        self, body: bytearray, scope: _Message, headers: dict[str, str], coming: "_Coming"
    ) -> None:
        """Receive the body of a request; refuse one that is too large or too slow."""
        limits, client = self._limits, client_of(scope)
        most = limits.upload_bytes if scope["path"] in _UPLOADS else limits.body_bytes
        length = headers.get("content-length", "0")
        if length.isdecimal() and int(length) > most:
            raise _too_large(most)
        try:
            async with asyncio.timeout(limits.upload_seconds):
                while not coming.whole:
                    message = await coming.receive()
                    if message["type"] != "http.request":
                        raise _Refused(400, "the request ended before it was whole")
                    part = message.get("body", b"")
                    if len(body) + len(part) > most:
                        raise _too_large(most)
                    self._held.take(client, len(part))
                    body += part
        except TimeoutError:
            seconds = limits.upload_seconds
            raise _Refused(408, f"the request did not come in whole within {seconds:g} s") from None

    async def _drain(self, coming: "_Coming") -> None:
        """Read the rest of a refused request: many clients send all before they read an answer."""
        left = _DRAINED * self._limits.upload_bytes
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(_DRAIN_SECONDS):
                while left > 0 and not coming.whole:
                    left -= len((await coming.receive()).get("body", b""))


class _Coming:
    """A request that is coming in."""

    def __init__(self, receive: _Receive) -> None:
        self._receive = receive
        self.whole = False

    async def receive(self) -> _Message:
        """Receive a part of the request, or that its client has gone."""
        message = await self._receive()
        self.whole = not message.get("more_body", False)
        return message


def _too_large(most: int) -> _Refused:
    size = f"{most >> 20} MiB" if most >= 1 << 20 else f"{most >> 10} KiB"
    return _Refused(413, f"the request is larger than {size}: send less, such as a shorter record")


def _replay(body: bytes, leaving: asyncio.Future[_Message]) -> _Receive:
    """Return a `receive` that delivers a body that was already received, in parts."""
    left = [body[i : i + _PART] for i in range(0, len(body), _PART)] or [b""]
    left.reverse()

    async def again() -> _Message:
        if left:
            await asyncio.sleep(0)  # others have their turn while a long body is read
            return {"type": "http.request", "body": left.pop(), "more_body": bool(left)}
        return await asyncio.shield(leaving)

    return again


class _Answer:
    """An answer that is being sent, with the security headers."""

    def __init__(self, send: _Send, path: str, framed_by: Sequence[str]) -> None:
        self._send = send
        self._paper = path.startswith("/paper")
        origins = framed_by if path in _FRAMED else ()
        policy = PAPER if self._paper else f"{PAGE}; {frame_rule(origins)}"
        headers = _HEADERS | {"content-security-policy": policy}
        if origins:
            del headers["x-frame-options"]  # it knows no list of sites
        self._own = [(name.encode(), value.encode()) for name, value in headers.items()]
        self._started = False
        self.complete = False

    async def send(self, message: _Message) -> None:
        """Send a part of the answer."""
        if message["type"] == "http.response.start":
            self._started = True
            message = {**message, "headers": self._add_headers(message["headers"])}
        elif message["type"] == "http.response.body":
            self.complete = not message.get("more_body", False)
        await self._send(message)

    def _add_headers(self, given: list[tuple[bytes, bytes]]) -> list[tuple[bytes, bytes]]:
        own = [one for one in self._own if not (self._paper and one[0] == _POLICY in dict(given))]
        names = {name for name, _ in own}
        return [one for one in given if one[0] not in names] + own

    async def refuse(self, status: int, detail: str) -> None:
        """Send a refusal, unless another answer has begun."""
        if self._started:
            return
        body = json.dumps({"detail": detail}).encode()
        headers = [
            (b"content-type", b"application/json"),
            (b"content-length", str(len(body)).encode()),
            (b"connection", b"close"),
        ]
        if status in (429, 503):
            headers.append((b"retry-after", str(AGAIN_SECONDS).encode()))
        await self.send({"type": "http.response.start", "status": status, "headers": headers})
        await self.send({"type": "http.response.body", "body": body})


def _find_names() -> set[str]:
    """Return the names of this machine; the full one is added once the network has answered."""
    name = socket.gethostname().casefold()
    short = name.partition(".")[0]
    names = {"localhost", name, short, f"{short}.local"}

    def add_full() -> None:
        full = socket.getfqdn().casefold()
        if full.startswith(f"{short}."):
            names.add(full)

    threading.Thread(target=add_full, daemon=True).start()
    return names
