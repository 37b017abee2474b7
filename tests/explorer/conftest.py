"""A server of the explorer, as `stackbounce app` runs it."""

import copy

import httpx
import pytest

from adversary.server import PATIENCE, serving

DROP = {
    "balls": [{"mass": "150 g", "name": "basketball"}, {"mass": "57 g"}],
    "contacts": [{"law": "Spring", "stiffness": 2500.0}, {"law": "Spring", "stiffness": 1000.0}],
    "impact_speed": 3.53,
}
ASKED = {"drop": DROP, "errors": {"impact_speed": "5 cm/s"}}


@pytest.fixture(scope="session")
def address_of_server():
    with serving() as server:
        yield server.address


@pytest.fixture(scope="session")
def server(address_of_server):
    with httpx.Client(base_url=address_of_server, timeout=PATIENCE) as client:
        yield client


@pytest.fixture
def drop():
    return copy.deepcopy(DROP)
