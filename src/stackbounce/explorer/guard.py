"""Admission of requests, and the security headers of every answer.

Only the page that this server serves may use it, not the pages of other sites that are open in the
same browser. So a request must name this machine as its host, and must not come from another site.
"""

import socket
from collections.abc import Awaitable, Callable, Sequence
from urllib.parse import urlsplit

from fastapi import FastAPI, Request
from fastapi.responses import JSONResponse, Response
from starlette.middleware.trustedhost import TrustedHostMiddleware

from stackbounce.explorer.addresses import Place
from stackbounce.explorer.framing import frame_rule
from stackbounce.explorer.limits import Limits
from stackbounce.explorer.made import PAGE_POLICY

UPLOADS = ("/api/measure", "/api/fit")
"""The addresses that take a file."""


def add_guard(
    app: FastAPI, limits: Limits, others: Sequence[Place], framed_by: Sequence[str]
) -> None:
    """Let an application refuse foreign and large requests, and tell browsers its policy.

    Parameters
    ----------
    app : FastAPI
        The application.
    limits : Limits
        Limits of the size of a request.
    others : sequence of Place
        The addresses of this machine that others can type.
    framed_by : sequence of str
        The origins of the sites that may show the page in a frame.

    Examples
    --------
    >>> from stackbounce.explorer import LIMITS
    >>> add_guard(FastAPI(), LIMITS, others=[], framed_by=[])
    """
    policy = f"{PAGE_POLICY}; {frame_rule(framed_by)}"

    @app.middleware("http")
    async def guard(
        request: Request, call_next: Callable[[Request], Awaitable[Response]]
    ) -> Response:
        refused = _refuse(request, limits)
        response = await call_next(request) if refused is None else refused
        response.headers.setdefault("content-security-policy", policy)
        return response

    app.add_middleware(TrustedHostMiddleware, allowed_hosts=_list_hosts(others), www_redirect=False)


def _refuse(request: Request, limits: Limits) -> Response | None:
    """Return the refusal of a request from another site, or of one that is too large."""
    headers = request.headers
    own = f"http://{headers['host']}".casefold()
    if headers.get("origin", own).casefold() != own:
        return JSONResponse({"detail": "pages of other sites cannot use this server"}, 403)
    if "transfer-encoding" in headers:
        return JSONResponse({"detail": "the request must tell its length: Content-Length"}, 411)
    most = limits.upload_bytes if request.url.path in UPLOADS else limits.body_bytes
    if int(headers.get("content-length", 0)) > most:
        size = f"{most >> 20} MiB" if most >= 1 << 20 else f"{most >> 10} KiB"
        detail = f"the request is larger than {size}: send less, such as a shorter record"
        return JSONResponse({"detail": detail}, 413)
    return None


def _list_hosts(others: Sequence[Place]) -> list[str]:
    """Return the hosts that a request may name: this machine's names, and addresses.

    Any other name is refused, as its owner may have pointed it at this machine: DNS rebinding. No
    name ends in a number, so that ``*.0`` to ``*.255`` are all addresses in IPv4: behind a router
    or in a container this machine does not know its own.
    """
    name = socket.gethostname()
    names = ["localhost", name, f"{name.partition('.')[0]}.local"]
    if others:
        names.append(socket.getfqdn())
    hosts = [urlsplit(place.address).hostname or "" for place in others]
    six = ["[::1]", *(f"[{host}]" for host in hosts if ":" in host)]
    return [*names, *hosts, *six, *(f"*.{number}" for number in range(256))]
