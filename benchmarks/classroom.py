"""A class on one machine: fifty users of the explorer at once, each with a page of their own.

Run `python -m benchmarks.classroom [--users 50] [--moves 5]`. It starts a server as `stackbounce
app` does on two cores. Each user loads the page, measures a record and carries errors forward;
all begin at the same moment, and nobody waits between two requests, as people do.
"""

import argparse
import asyncio
import subprocess
import sys
from collections import defaultdict
from importlib.resources import files
from time import perf_counter
from typing import Any

import httpx
import numpy as np
from rich.console import Console
from rich.table import Table

from stackbounce.explorer.made import PLAYING

__all__ = ["Seen", "run"]

Seen = dict[str, list[tuple[float, int]]]
"""What was asked for, and of each answer the time in s and the status."""

_PATIENCE = 300.0  # s
RECORD = files("stackbounce.explorer") / "static" / "examples" / "floor-force.csv"


def drop(mass: float) -> dict[str, Any]:
    """Return a basketball of a mass in kg with a tennis ball on top."""
    return {
        "balls": [{"mass": mass}, {"mass": 0.057}],
        "contacts": [
            {"law": "Hysteretic", "stiffness": 2500.0, "restitution": 0.77},
            {"law": "Spring", "stiffness": 1000.0},
        ],
        "height": 0.71,
    }


async def user(client: httpx.AsyncClient, number: int, moves: int, seen: Seen) -> None:
    """Do what one user does."""

    async def ask(what: str, method: str, path: str, **request: Any) -> httpx.Response:
        start = perf_counter()
        response = await client.request(method, path, **request)
        seen[what].append((perf_counter() - start, response.status_code))
        return response

    await ask("page", "GET", "/")
    for file in PLAYING:
        await ask("its files", "GET", file)
    record = {"file": ("force.csv", RECORD.read_bytes())}
    await ask("a record", "POST", "/api/measure", files=record)
    for move in range(moves):
        asked = {"drop": drop(0.1 + 0.005 * move + 1e-4 * number), "errors": {"height": "1 cm"}}
        await ask("errors", "POST", "/api/predict", json=asked)


async def run(address: str, users: int, moves: int) -> tuple[Seen, float]:
    """Let so many users in at once; return what they saw, and how long all took, in s."""
    seen: Seen = defaultdict(list)
    limits = httpx.Limits(max_connections=None)
    start = perf_counter()
    async with httpx.AsyncClient(base_url=address, timeout=_PATIENCE, limits=limits) as client:
        await asyncio.gather(*(user(client, number, moves, seen) for number in range(users)))
    return seen, perf_counter() - start


def table(seen: Seen) -> Table:
    """Return what users saw, for people."""
    made = Table(box=None, pad_edge=False)
    for head in ("", "requests", "errors", "median", "95 %", "longest"):
        made.add_column(head, justify="right" if head else "left")
    for what, answers in seen.items():
        times, statuses = np.array(answers).T
        shown = (f"{1e3 * np.quantile(times, q):.0f} ms" for q in (0.5, 0.95, 1.0))
        made.add_row(what, str(len(times)), str(int((statuses >= 400).sum())), *shown)
    return made


def main() -> None:
    """Serve, measure and print."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.classroom", description=__doc__)
    parser.add_argument("--users", type=int, default=50)
    parser.add_argument("--moves", type=int, default=5, help="predictions that each user asks for")
    told = parser.parse_args()
    command = [sys.executable, "-m", "stackbounce", "app", "--no-browser", "--port", "0"]
    with subprocess.Popen(
        [*command, "--workers", "2"], stdout=subprocess.PIPE, text=True
    ) as server:
        try:
            assert server.stdout is not None
            address = server.stdout.readline().split()[2]
            seen, seconds = asyncio.run(run(address, told.users, told.moves))
        finally:
            server.terminate()
    console = Console(highlight=False)
    console.print(table(seen))
    count = sum(map(len, seen.values()))
    errors = sum(status >= 400 for answers in seen.values() for _, status in answers)
    console.print(f"{told.users} users, {count} requests in {seconds:.1f} s: {errors} errors")
    sys.exit(errors > 0)


if __name__ == "__main__":
    main()
