"""Shares: how much of the server one client may have, so that others can use it meanwhile.

A client is an address. All computers behind one router, such as those of a school, are one client.
"""

import ipaddress
from collections import Counter
from collections.abc import Mapping
from typing import Any

from stackbounce.errors import StackbounceError

__all__ = ["AGAIN_SECONDS", "Busy", "Shares", "client_of"]

AGAIN_SECONDS = 5
"""Time in s after which a client that was sent away may try again."""

_NETWORK = 64  # leading bits of an IPv6 address that all addresses of one machine share


class Busy(StackbounceError):
    """Too much is asked for at once: by this client (status 429) or by all together (503)."""

    def __init__(self, what: str, status: int) -> None:
        super().__init__(f"{what}: try again in {AGAIN_SECONDS} s")
        self.status = status


def client_of(scope: Mapping[str, Any]) -> str:
    """Return the client of a connection or request: its IPv4 address, or its IPv6 network.

    Parameters
    ----------
    scope : mapping
        The scope of ASGI, whose ``client`` is an address and a port, or None.

    Returns
    -------
    str

    Examples
    --------
    >>> client_of({"client": ("192.168.0.7", 50000)})
    '192.168.0.7'
    >>> client_of({"client": ("2001:db8::1:2:3:4", 50000)})
    '2001:db8::/64'
    """
    host = (scope.get("client") or ("",))[0]
    try:
        address = ipaddress.ip_address(host)
    except ValueError:
        return str(host)
    if isinstance(address, ipaddress.IPv4Address):
        return str(address)
    if address.ipv4_mapped is not None:
        return str(address.ipv4_mapped)
    return str(ipaddress.ip_network((int(address), _NETWORK), strict=False))


class Shares:
    """What clients hold of something limited.

    Parameters
    ----------
    words : str
        What is said to be too much.
    most : int
        What all clients together may hold.
    share : int
        What one client may hold.

    Examples
    --------
    >>> shares = Shares("too many requests", 200, 100)
    >>> shares.take("192.168.0.7", 60)
    >>> shares.take("192.168.0.7", 60)
    Traceback (most recent call last):
    ...
    stackbounce.explorer.shares.Busy: too many requests from your address at once: try again in 5 s
    """

    def __init__(self, words: str, most: int, share: int) -> None:
        self._words, self._most, self._share = words, most, share
        self._held: Counter[str] = Counter()

    def take(self, client: str, amount: int = 1) -> None:
        """Note that a client holds more.

        Raises
        ------
        Busy
            If that is more than its share, or more than there is.
        """
        if self._held[client] + amount > self._share:
            raise Busy(f"{self._words} from your address at once", 429)
        if self._held.total() + amount > self._most:
            raise Busy(f"{self._words} at once", 503)
        self._held[client] += amount

    def give_back(self, client: str, amount: int = 1) -> None:
        """Note that a client holds less."""
        self._held[client] -= amount
        if not self._held[client]:
            del self._held[client]
