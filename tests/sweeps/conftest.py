"""A store that is complete, and where another one of the same sweep may be written."""

import pytest

from stackbounce.sweeps import write
from stopped_sweep import DROP, VALUES


@pytest.fixture(scope="session")
def whole(tmp_path_factory):
    return write(tmp_path_factory.mktemp("whole") / "map.zarr", DROP, VALUES, block=64)


@pytest.fixture
def out(tmp_path):
    return tmp_path / "map.zarr"
