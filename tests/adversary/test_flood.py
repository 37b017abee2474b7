"""Others get answers while one client sends all it can (`python -m adversary.flood`: times)."""

import httpx
import pytest

from adversary.flood import flood
from adversary.requests_server import serving

pytestmark = pytest.mark.slow

GUARD = 15.0
"""Time in s after which the server counts as blocked. The script says if it keeps its promise."""


@pytest.fixture(scope="module")
def server():
    with serving() as made:
        httpx.post(f"{made.address}api/stack", json={"balls": ["B1"]}, timeout=60.0)
        yield made


@pytest.mark.parametrize("name", ["maps", "gone", "runs", "uploads", "heads", "unread"])
def test_others_get_answers_during_a_flood(server, name):
    seen = flood(server, name, seconds=2.0)
    assert seen.failed == []
    assert max(seen.times) < GUARD
