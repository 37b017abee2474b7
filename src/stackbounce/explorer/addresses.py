"""The addresses at which other machines reach the explorer, with their QR codes."""

import contextlib
import ipaddress
import socket
from typing import NamedTuple

from stackbounce.extras import is_installed

_ALL = ("0.0.0.0", "::")
_OUTSIDE = "192.0.2.1"  # RFC 5737; nothing is sent there


class Place(NamedTuple):
    """An address of the page, and its QR code: rows of 1, which is dark, and 0."""

    address: str
    code: list[str]


def url(host: str, port: int) -> str:
    """Return the address of the page at a host.

    Examples
    --------
    >>> url("::1", 8050)
    'http://[::1]:8050/'
    """
    return f"http://[{host}]:{port}/" if ":" in host else f"http://{host}:{port}/"


def list_places(host: str, port: int) -> list[Place]:
    """Return the addresses that others can type, the likeliest first.

    Parameters
    ----------
    host : str
        Where the server listens: an address, ``"0.0.0.0"`` for all of IPv4, ``"::"`` for all.
    port : int
        Its port.

    Returns
    -------
    list of Place
        None where the server listens to this machine alone, or the machine is in no network.

    Examples
    --------
    >>> list_places("127.0.0.1", 8050)
    []
    >>> list_places("203.0.113.7", 8050)[0].address
    'http://203.0.113.7:8050/'
    """
    hosts = _own_hosts() if host in _ALL else [host]
    others = [host for host in hosts if not _is_loopback(host)]
    return [Place(address, _code(address)) for address in (url(other, port) for other in others)]


def _code(address: str) -> list[str]:
    """Return the rows of an address's QR code; none without the library for it."""
    if not is_installed("app"):
        return []
    import segno

    code = segno.make_qr(address, error="m", boost_error=False)
    return ["".join(map(str, row)) for row in code.matrix]


def _is_loopback(host: str) -> bool:
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:  # a name, such as localhost
        return host.casefold() == "localhost"


def _own_hosts() -> list[str]:
    """Return this machine's addresses in IPv4, that of the way to other networks first.

    Without the library that lists them it is that one alone.
    """
    first = _way_out()
    if not is_installed("app"):
        return [] if first is None else [first]
    import psutil

    up = {name for name, stat in psutil.net_if_stats().items() if stat.isup}
    found = [
        address.address
        for name, own in psutil.net_if_addrs().items()
        if name in up
        for address in own
        if address.family == socket.AF_INET
        and not ipaddress.ip_address(address.address).is_link_local
    ]
    return sorted(found, key=lambda host: host != first)


def _way_out() -> str | None:
    """Return the address from which this machine would send to another network; none is sent."""
    with contextlib.suppress(OSError), socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as trying:
        trying.connect((_OUTSIDE, 9))
        return str(trying.getsockname()[0])
    return None
