"""Nothing that was kept has changed: ``python -m frozen`` shows more, and all groups."""

import pytest

from frozen.groups import GROUPS, changed, computed

QUICK = [name for name, group in GROUPS.items() if group.quick]


@pytest.mark.slow
@pytest.mark.parametrize("name", QUICK)
def test_nothing_has_changed(name):
    now = computed(name)
    assert now
    found = [str(one) for one in changed(name, now)]
    assert not found, "\n".join(found[:20])
