"""A server as `stackbounce app` starts it, to be attacked, and requests that take it long."""

import contextlib
import dataclasses
import subprocess
import sys
from collections.abc import Iterator
from typing import Any
from urllib.parse import urlsplit

import psutil

PATIENCE = 300.0  # s until an answer: it is slow while other tests have the processors


def make_drop(balls: int, contact: dict[str, Any], **more: float) -> dict[str, Any]:
    """Return so many balls with the same contacts, as a request has them."""
    masses = [{"mass": 0.1 * 3.0**-i} for i in range(balls)]
    return {"balls": masses, "contacts": [contact] * balls, "impact_speed": 3.0, **more}


_POWER = {"law": "PowerLaw", "stiffness": 1e5, "exponent": 1.37}
LONG_RUN = {
    "drop": make_drop(6, _POWER, gravity=1000.0),
    "until": 60.0,
    "errors": {"impact_speed": 0.01},
}
"""A request for a drop of 20 000 events."""


@dataclasses.dataclass(frozen=True)
class Server:
    address: str
    process: subprocess.Popen[str]

    @property
    def place(self) -> tuple[str, int]:
        parts = urlsplit(self.address)
        return str(parts.hostname), int(parts.port or 0)

    def children(self) -> list[psutil.Process]:
        return psutil.Process(self.process.pid).children()


@contextlib.contextmanager
def running(command: list[str], **pipes: Any) -> Iterator[subprocess.Popen[str]]:
    """Run a command, and end it also where what is done meanwhile fails."""
    pipes |= {"stdout": subprocess.PIPE, "encoding": "utf-8"}
    with subprocess.Popen(command, **pipes) as process:
        try:
            yield process
        finally:
            process.terminate()


@contextlib.contextmanager
def serving(*options: str, workers: int = 2, **pipes: Any) -> Iterator[Server]:
    """Run a server at a free port of this machine."""
    command = [sys.executable, "-m", "stackbounce", "app", "--no-browser", "--port", "0"]
    command += ["--workers", str(workers), *options]
    with running(command, **pipes) as process:
        assert process.stdout is not None
        port = urlsplit(process.stdout.readline().split()[2]).port
        yield Server(f"http://127.0.0.1:{port}/", process)
