"""One client sends all that it can, and the times are measured in which others get answers.

Run `python -m adversary.flood [--seconds 10] [--kinds fits,runs]` in `tests/`. The flood comes from
127.0.0.2 and the others ask from 127.0.0.1, so that the server takes them for two clients. The
flood has the lowest priority, as a distant machine would not take the server's processor.
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
from collections.abc import Callable
from time import perf_counter
from typing import Any, NamedTuple

import httpx

from adversary.server import LONG_RUN, PATIENCE, Server, make_drop, serving

_FLOODER, _OTHER = "127.0.0.2", "127.0.0.1"
_SPRING = {"law": "Spring", "stiffness": 2500.0}
_SMALL = {"drop": make_drop(2, _SPRING), "errors": {"impact_speed": 0.01}}
_FIT = {
    "drop": json.dumps(LONG_RUN["drop"]),
    "vary": json.dumps([f"contacts.{i}.stiffness" for i in range(6)]),
    "measured": json.dumps({f"rebound_ratios.{i}": f"{i + 1} ± 0.01" for i in range(6)}),
}
_BEFORE = 2.0  # s, from the beginning of a flood until others ask


class _Kind(NamedTuple):
    """What is sent over how many connections at once."""

    connections: int
    path: str
    request: Callable[[], dict[str, Any]]


def _record() -> dict[str, Any]:
    """Return the upload of a file of nearly 16 MiB."""
    rows = b"".join(b"%.5f,%d\n" % (i * 1e-5, i * i % 97) for i in range(1_100_000))
    return {"files": {"file": ("a.csv", (b"Time (s),Force (N)\n" + rows)[: (1 << 24) - 1000])}}


KINDS = {
    "none": _Kind(0, "/", dict),
    "runs": _Kind(100, "/api/predict", lambda: {"json": LONG_RUN}),
    "fits": _Kind(100, "/api/fit", lambda: {"data": _FIT}),
    "uploads": _Kind(40, "/api/measure", _record),
    "files": _Kind(150, "/explorer.css", dict),
}
"""Kinds of flood."""


class Seen(NamedTuple):
    """What the others saw: times of answers in s, and what failed."""

    times: list[float]
    failed: list[str]


def _client(address: str, own: str, seconds: float) -> httpx.AsyncClient:
    transport = httpx.AsyncHTTPTransport(
        local_address=own, limits=httpx.Limits(max_connections=None)
    )
    return httpx.AsyncClient(base_url=address, transport=transport, timeout=seconds)


def _send_all(address: str, kind: _Kind) -> None:
    """Flood a server until this process is ended."""
    os.nice(19)
    request = kind.request()

    async def again(client: httpx.AsyncClient) -> None:
        while True:
            try:
                method = "POST" if request else "GET"
                answer = await client.request(method, kind.path, **request)
                sent_away = answer.status_code in (429, 503)
            except httpx.HTTPError:
                sent_away = True
            await asyncio.sleep(0.1 if sent_away else 0.0)

    async def run() -> None:
        async with _client(address, _FLOODER, 600.0) as client:
            await asyncio.gather(*(again(client) for _ in range(kind.connections)))

    asyncio.run(run())


async def _watch(address: str, seconds: float) -> Seen:
    """Ask for a drop and a file in turn, each over a connection of its own."""
    asked = [("POST", "/api/predict", {"json": _SMALL}), ("GET", "/explorer.css", {})]
    seen = Seen([], [])
    end = perf_counter() + seconds
    while perf_counter() < end:
        for method, path, request in asked:
            start = perf_counter()
            try:
                async with _client(address, _OTHER, 60.0) as client:
                    answer = await client.request(method, path, **request)
                if answer.status_code != 200:
                    seen.failed.append(f"{path}: {answer.status_code}")
            except httpx.HTTPError as error:
                seen.failed.append(f"{path}: {type(error).__name__}")
            seen.times.append(perf_counter() - start)
            await asyncio.sleep(0.05)
    return seen


def flood(server: Server, name: str, seconds: float) -> Seen:
    """Flood a server for a while, and ask it meanwhile as somebody else."""
    kind, context = KINDS[name], multiprocessing.get_context("spawn")
    process = context.Process(target=_flood_named, args=(server.address, name), daemon=True)
    if kind.connections:
        process.start()
        time.sleep(_BEFORE)
    try:
        return asyncio.run(_watch(server.address, seconds))
    finally:
        if kind.connections:
            process.kill()
            process.join()


def _flood_named(address: str, name: str) -> None:
    _send_all(address, KINDS[name])


def main() -> int:
    """Flood a server in each way; return 1 if somebody else waited too long."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--seconds", type=float, default=10.0, help="time of each flood in s")
    parser.add_argument("--kinds", default=",".join(KINDS), help="names, separated by commas")
    parser.add_argument("--most", type=float, default=5.0, help="time in s that an answer may take")
    arguments = parser.parse_args()
    slow = False
    for name in arguments.kinds.split(","):
        with serving("--host", "0.0.0.0") as server:
            httpx.post(f"{server.address}api/predict", json=_SMALL, timeout=PATIENCE)
            seen = flood(server, name, arguments.seconds)
        times = (f"{f(seen.times):.2f} s" for f in (statistics.median, max))
        failed = ", ".join(f"{count} × {what}" for what, count in Counter(seen.failed).items())
        sys.stdout.write(f"| {name} | {len(seen.times)} | {' | '.join(times)} | {failed or 0} |\n")
        slow = slow or bool(seen.failed) or max(seen.times) > arguments.most
    return int(slow)


if __name__ == "__main__":
    sys.exit(main())
