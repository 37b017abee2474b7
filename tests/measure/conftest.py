"""What the tests of measurements share."""

import pytest

import stackbounce as sb


@pytest.fixture
def read(tmp_path):
    """Read a content as a file of some name."""

    def reader(content, name="some file", **options):
        path = tmp_path / name
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return sb.read(path, **options)

    return reader
