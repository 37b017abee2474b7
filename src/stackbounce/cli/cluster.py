"""A connection to a dask cluster."""

import contextlib
import logging
import socket
from collections.abc import Iterator
from typing import Any

from stackbounce.errors import InvalidValue, shown
from stackbounce.extras import need


@contextlib.contextmanager
def connect(address: str | None) -> Iterator[Any]:
    """Connect to a cluster, if any."""
    if address is None:
        yield None
        return
    need("cluster", "--cluster")
    import distributed

    for name in ("distributed", "distributed.client"):  # our own error says it in one line
        logging.getLogger(name).setLevel(logging.CRITICAL)
    wrong = f"--cluster must be the address of a dask scheduler, got {shown(address)}"
    client_of: Any = distributed.Client
    try:
        host, _, port = address.rpartition("://")[2].rpartition(":")
        socket.create_connection((host, int(port)), timeout=5.0).close()  # dask would try for long
        client = client_of(address, timeout="10s")
    except (OSError, ValueError) as error:
        raise InvalidValue(wrong) from error
    with client:
        yield client
