"""One client sends all that it can, and the times are measured in which others get answers.

Run `python -m adversary.flood [--seconds 10] [--kinds maps,gone]` in `tests/`. The flood comes from
127.0.0.2 and the others ask from 127.0.0.1, so that the server takes them for two clients. The
flood has the lowest priority, as a distant machine would not take the server's processor. Each of
the others' requests has a connection of its own.
"""

import argparse
import asyncio
import json
import multiprocessing
import os
import statistics
import sys
import time
from collections import Counter
from collections.abc import Awaitable, Callable
from multiprocessing.connection import Connection
from time import perf_counter
from typing import NamedTuple

import httpx
from rich.console import Console
from rich.table import Table

from adversary.requests_server import LONG_MAP, Server, make_drop, make_map, serving

__all__ = ["KINDS", "Seen", "flood"]

_FLOODER, _OTHER = "127.0.0.2", "127.0.0.1"
_SPRING = {"law": "Spring", "stiffness": 2500.0}
_POWER = {"law": "PowerLaw", "stiffness": 1e5, "exponent": 1.37}


def _request(path: str, body: bytes, kind: str = "application/json") -> bytes:
    head = (
        f"POST {path} HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: {kind}\r\n"
        f"Content-Length: {len(body)}\r\n\r\n"
    )
    return head.encode() + body


def _json(path: str, value: object) -> bytes:
    return _request(path, json.dumps(value).encode())


def _form(path: str, fields: dict[str, str], file: bytes = b"") -> bytes:
    parts = [f'Content-Disposition: form-data; name="{k}"\r\n\r\n{v}' for k, v in fields.items()]
    whole = [part.encode() for part in parts]
    if file:
        disposition = b'Content-Disposition: form-data; name="file"; filename="a.csv"\r\n\r\n'
        whole.append(disposition + file)
    body = b"".join(b"--cut\r\n" + part + b"\r\n" for part in whole) + b"--cut--\r\n"
    return _request(path, body, "multipart/form-data; boundary=cut")


_LONG_MAP = _json("/api/map", LONG_MAP)
_LONG_RUN = _json(
    "/api/simulate", {"drop": make_drop(6, _POWER, gravity=1000.0), "until": 60.0, "frames": 3000}
)
_LARGE_RUN = _json("/api/simulate", {"drop": make_drop(6, _SPRING), "frames": 3000})
_FIT = _form(
    "/api/fit",
    {
        "drop": json.dumps(LONG_MAP["drop"]),
        "vary": json.dumps([f"contacts.{i}.stiffness" for i in range(6)]),
        "measured": json.dumps({f"rebound_ratios.{i}": f"{i + 1} ± 0.01" for i in range(6)}),
    },
)
_ROWS = b"".join(b"%.5f,%d\n" % (i * 1e-5, i * i % 97) for i in range(1_100_000))
_UPLOAD = _form("/api/measure", {}, (b"Time (s),Force (N)\n" + _ROWS)[: 16 * 1024 * 1024 - 1000])
_STATIC = b"GET /style.css HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n"

_BEFORE = 2.0  # s, from the begin of a flood until others ask

_Streams = tuple[asyncio.StreamReader, asyncio.StreamWriter]


class _Flood:
    """What one client does over many connections, again and again until it is ended."""

    def __init__(self, place: tuple[str, int]) -> None:
        self._place = place
        self.statuses: Counter[int] = Counter()

    async def connect(self) -> _Streams:
        return await asyncio.open_connection(*self._place, local_addr=(_FLOODER, 0))

    async def ask(self, request: bytes) -> None:
        """Send a request and read its answer."""
        reader, writer = await self.connect()
        try:
            writer.write(request)
            await writer.drain()
            status = int((await reader.readline() or b"HTTP/1.1 0").split()[1])
            self.statuses[status] += 1
            await reader.read(1 << 20)
        finally:
            writer.close()

    async def leave(self, request: bytes) -> None:
        """Send a request and go away."""
        _, writer = await self.connect()
        writer.write(request)
        await writer.drain()
        await asyncio.sleep(0.05)
        writer.transport.abort()

    async def stay(self, begun: bytes) -> None:
        """Send the begin of a request, or one whose answer is not read, and stay."""
        reader, writer = await self.connect()
        try:
            writer.transport.pause_reading()  # type: ignore[attr-defined]
            writer.write(begun)
            await asyncio.sleep(5.0)
        finally:
            writer.transport.abort()
            del reader

    async def trickle(self, request: bytes) -> None:
        """Send a request byte by byte."""
        _, writer = await self.connect()
        try:
            for i in range(len(request)):
                if writer.transport.is_closing():
                    return
                writer.write(request[i : i + 1])
                await asyncio.sleep(0.5)
        finally:
            writer.transport.abort()


class _Kind(NamedTuple):
    says: str
    connections: int
    send: Callable[[_Flood], Awaitable[None]]


KINDS = {
    "none": _Kind("no flood", 0, lambda flood: flood.ask(_STATIC)),
    "maps": _Kind("maps of 40 000 points, six balls", 100, lambda flood: flood.ask(_LONG_MAP)),
    "gone": _Kind("such maps, the client gone", 300, lambda flood: flood.leave(_LONG_MAP)),
    "runs": _Kind("drops of 20 000 events", 100, lambda flood: flood.ask(_LONG_RUN)),
    "runs-gone": _Kind("such drops, the client gone", 300, lambda flood: flood.leave(_LONG_RUN)),
    "fits": _Kind("fits of six numbers", 100, lambda flood: flood.ask(_FIT)),
    "uploads": _Kind("uploads of 16 MiB", 40, lambda flood: flood.ask(_UPLOAD)),
    "files": _Kind("files of the page", 150, lambda flood: flood.ask(_STATIC)),
    "open": _Kind("connections without a request", 600, lambda flood: flood.stay(b"")),
    "heads": _Kind("unfinished heads", 600, lambda flood: flood.stay(_STATIC[:-4])),
    "bodies": _Kind("slow bodies", 400, lambda flood: flood.trickle(_LONG_MAP)),
    "unread": _Kind("large answers that are not read", 300, lambda flood: flood.stay(_LARGE_RUN)),
}
"""Kinds of flood: what is sent over how many connections at once."""


class Seen(NamedTuple):
    """What the others saw: times of answers in s and what failed; and the flood's statuses."""

    times: list[float]
    failed: list[str]
    statuses: Counter[int]


async def _again(flood: _Flood, kind: _Kind) -> None:
    while True:
        try:
            await kind.send(flood)
        except (OSError, ValueError, IndexError):
            await asyncio.sleep(0.1)  # it was sent away


def _send_all(place: tuple[str, int], name: str, ended: Connection) -> None:
    """Flood a server until something comes through a pipe; send the statuses back."""
    os.nice(19)
    made, kind = _Flood(place), KINDS[name]

    async def run() -> None:
        tasks = [asyncio.create_task(_again(made, kind)) for _ in range(kind.connections)]
        await asyncio.to_thread(ended.recv)
        for task in tasks:
            task.cancel()
        await asyncio.wait(tasks)

    asyncio.run(run())
    ended.send(made.statuses)


async def _watch(address: str, seconds: float) -> tuple[list[float], list[str]]:
    """Ask for a drop, a small map and a file in turn, without a pause."""
    asked = [
        ("POST", "/api/simulate", {"drop": make_drop(2, _SPRING)}),
        ("POST", "/api/map", make_map(2, _SPRING, 50)),
        ("GET", "/style.css", None),
    ]
    times, failed = [], []
    end = perf_counter() + seconds
    while perf_counter() < end:
        for method, path, value in asked:
            start = perf_counter()
            transport = httpx.AsyncHTTPTransport(local_address=_OTHER)
            try:
                async with httpx.AsyncClient(
                    base_url=address, timeout=60.0, transport=transport
                ) as client:
                    answer = await client.request(method, path, json=value)
                if answer.status_code != 200:
                    failed.append(f"{path}: {answer.status_code}")
            except httpx.HTTPError as error:
                failed.append(f"{path}: {type(error).__name__}")
            times.append(perf_counter() - start)
            await asyncio.sleep(0.05)
    return times, failed


def flood(server: Server, name: str, seconds: float) -> Seen:
    """Flood a server for a while, and ask it meanwhile as somebody else."""
    if not KINDS[name].connections:
        return Seen(*asyncio.run(_watch(server.address, seconds)), Counter())
    context = multiprocessing.get_context("spawn")
    here, there = context.Pipe()
    process = context.Process(target=_send_all, args=(server.place, name, there), daemon=True)
    process.start()
    try:
        time.sleep(_BEFORE)
        times, failed = asyncio.run(_watch(server.address, seconds))
        here.send(None)
        statuses = here.recv() if here.poll(10.0) else Counter()
    finally:
        process.kill()
        process.join()
    return Seen(times, failed, statuses)


def main() -> int:
    """Flood a server in each way; return 1 if somebody else waited too long."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seconds", type=float, default=10.0, help="time of each flood in s")
    parser.add_argument("--kinds", default=",".join(KINDS), help="names, separated by commas")
    parser.add_argument("--most", type=float, default=2.0, help="time in s that an answer may take")
    arguments = parser.parse_args()
    table = Table(box=None, pad_edge=False)
    for head in ("one client's flood", "others' answers", "failed", "median", "longest", "memory"):
        table.add_column(head, justify="left" if head.startswith("one") else "right")
    table.add_column("the flood's answers")
    slow = False
    for name in arguments.kinds.split(","):
        with serving() as server:
            httpx.post(f"{server.address}api/stack", json={"balls": ["B1"]}, timeout=60.0)
            seen = flood(server, name, arguments.seconds)
            memory = server.memory()
        times = (f"{f(seen.times):.2f} s" for f in (statistics.median, max))
        told = ", ".join(f"{count} × {status}" for status, count in sorted(seen.statuses.items()))
        counts = str(len(seen.times)), str(len(seen.failed))
        table.add_row(KINDS[name].says, *counts, *times, f"{memory:.0f} MiB", told)
        slow = slow or bool(seen.failed) or max(seen.times) > arguments.most
    Console(width=120).print(table)
    return int(slow)


if __name__ == "__main__":
    sys.exit(main())
