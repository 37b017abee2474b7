"""Others get answers while one client sends all it can, and so does a class at the same moment."""

import asyncio
from importlib.resources import files

import httpx
import pytest

from adversary.flood import flood
from adversary.server import PATIENCE, serving

pytestmark = pytest.mark.slow

GUARD = 15.0
"""Time in s after which the server counts as blocked. The script says if it keeps its promise."""
RECORD = files("stackbounce.explorer") / "static" / "examples" / "floor-force.csv"


@pytest.fixture(scope="module")
def server():
    with serving("--host", "0.0.0.0") as made:
        asyncio.run(measured(made.address, ["127.0.0.1"]))
        yield made


@pytest.mark.parametrize("name", ["runs", "fits", "uploads", "files"])
def test_others_get_answers_during_a_flood(server, name):
    seen = flood(server, name, seconds=2.0)
    assert seen.failed == []
    assert max(seen.times) < GUARD


async def measured(address, clients):
    """Return the statuses of a record that all clients send at the same moment."""

    async def one(own):
        transport = httpx.AsyncHTTPTransport(local_address=own)
        async with httpx.AsyncClient(transport=transport, timeout=PATIENCE) as client:
            file = {"file": ("force.csv", RECORD.read_bytes())}
            return (await client.post(f"{address}api/measure", files=file)).status_code

    return await asyncio.gather(*map(one, clients))


@pytest.mark.parametrize("router", [False, True], ids=["each its address", "behind one address"])
def test_a_class_of_thirty_that_measures_at_once_gets_answers(server, router):
    clients = [f"127.0.1.{1 if router else i + 1}" for i in range(30)]
    assert asyncio.run(measured(server.address, clients)) == [200] * 30
