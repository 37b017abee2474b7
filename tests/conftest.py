"""Settings shared by all tests."""

import collections
import os
import subprocess
import sys

# The tests run side by side: threads of linear algebra that wait for a processor take ten times as
# long as one thread.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import matplotlib as mpl
import pytest
from hypothesis import settings

mpl.use("Agg")

# The same examples in every run. `make test` takes a few of them; `pytest
# --hypothesis-profile=explore` looks for new ones.
settings.register_profile("steady", derandomize=True, deadline=None)
settings.register_profile("quick", settings.get_profile("steady"), max_examples=15)
settings.register_profile("explore", deadline=None, max_examples=2000)
settings.load_profile("steady")


@pytest.fixture
def little_work(monkeypatch):
    """Let a run cost a fifth of the work that it may by default."""
    monkeypatch.setattr("stackbounce.run.options.WORK_LIMIT", 30_000_000)


def pytest_configure(config):
    """Make the page of the present sources, once for all processes."""
    if not hasattr(config, "workerinput"):
        own = {"cwd": config.rootpath, "env": {**os.environ, "PYTHONPATH": "src"}}
        subprocess.run([sys.executable, "-m", "page_build"], **own, check=False)


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """Mark as slow what `fast_cases` says: the cases of a test after its first few."""
    seen = collections.Counter()
    for item in items:
        mark = item.get_closest_marker("fast_cases")
        if mark is not None:
            seen[item.location[0], item.originalname] += 1
            if seen[item.location[0], item.originalname] > mark.args[0]:
                item.add_marker(pytest.mark.slow)
