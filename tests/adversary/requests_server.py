"""A server as `stackbounce app` starts it, to be attacked, and requests that take it long."""

import contextlib
import dataclasses
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

__all__ = ["LONG_MAP", "Server", "make_drop", "make_map", "serving"]


def make_drop(balls: int, contact: dict[str, Any], **more: float) -> dict[str, Any]:
    """Return so many balls with the same contacts, as a request has them."""
    masses = [{"mass": 0.1 * 3.0**-i} for i in range(balls)]
    return {"balls": masses, "contacts": [contact] * balls, "impact_speed": 3.0, **more}


def make_map(balls: int, contact: dict[str, Any], count: int) -> dict[str, Any]:
    """Return a request for a map over two masses, of `count` times `count` points."""
    sides = {
        name: {"path": f"balls.{i}.mass", "low": 0.01, "high": 10.0, "count": count}
        for i, name in enumerate("xy")
    }
    return {"drop": make_drop(balls, contact), **sides}


LONG_MAP = make_map(
    6, {"law": "Hysteretic", "stiffness": 1e5, "exponent": 1.5, "restitution": 0.999}, 200
)
"""A request for a map that takes ten seconds or more."""


@dataclasses.dataclass(frozen=True)
class Server:
    """A server that runs."""

    address: str
    process: subprocess.Popen[str]

    @property
    def place(self) -> tuple[str, int]:
        """Host and port."""
        parts = urlsplit(self.address)
        return str(parts.hostname), int(parts.port or 0)

    def children(self) -> list[int]:
        """Return the ids of its processes."""
        tasks = Path(f"/proc/{self.process.pid}/task").glob("*/children")
        return [int(child) for task in tasks for child in task.read_text().split()]

    def own_memory(self) -> float:
        """Return the greatest memory in MiB that the server itself had."""
        return _peak(self.process.pid)

    def memory(self) -> float:
        """Return the greatest memory in MiB that it had, and its processes that live have."""
        return self.own_memory() + sum(_peak(pid) for pid in self.children())


def _peak(pid: int) -> float:
    with contextlib.suppress(OSError):
        for line in Path(f"/proc/{pid}/status").read_text().splitlines():
            if line.startswith("VmHWM:"):
                return int(line.split()[1]) / 1024
    return 0.0


@contextlib.contextmanager
def serving(*, workers: int = 2, **pipes: Any) -> Iterator[Server]:
    """Run a server at a free port of this machine."""
    command = [sys.executable, "-m", "stackbounce", "app", "--no-browser", "--port", "0"]
    command += ["--host", "0.0.0.0", "--workers", str(workers)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, **pipes) as process:
        try:
            assert process.stdout is not None
            port = urlsplit(process.stdout.readline().split()[2]).port
            yield Server(f"http://127.0.0.1:{port}/", process)
        finally:
            process.terminate()
