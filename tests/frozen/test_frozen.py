"""No bit of the engine's answers has changed: ``make frozen`` shows which."""

import pytest

from frozen.kept import GROUPS, compare


@pytest.mark.slow
@pytest.mark.parametrize("name", GROUPS)
def test_nothing_has_changed(name):
    assert compare(name) == []
