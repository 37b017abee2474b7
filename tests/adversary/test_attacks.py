"""A small part of each attack; `make attack` makes all of them in great number."""

import contextlib
import os
import subprocess
import sys
from pathlib import Path

import pytest

from adversary.table import begin, expect, row

TESTS = Path(__file__).parents[1]
COUNTS = {"signals": 1, "kills": 2, "pairs": 3, "stores": 2, "disks": 1}


@pytest.mark.slow
@pytest.mark.parametrize(("name", "count"), COUNTS.items())
def test_an_attack_fails(name, count):
    paths = [str(TESTS), *filter(None, [os.environ.get("PYTHONPATH")])]
    done = subprocess.run(
        [sys.executable, "-m", f"adversary.{name}", "--count", str(count)],
        cwd=TESTS,
        env=os.environ | {"PYTHONPATH": os.pathsep.join(paths)},
        capture_output=True,
        text=True,
        timeout=280,
        check=False,
    )
    if "| skipped |" in done.stdout:
        pytest.skip(done.stdout)
    assert (done.stdout, done.returncode) == (row(name, count, []), 0), done.stderr


def test_a_failure_is_told_by_the_exit_status(monkeypatch, capsys):
    @contextlib.contextmanager
    def harm(_):
        yield lambda index, *_: expect(index < 2, "harm", "what was said")

    monkeypatch.setattr(sys, "argv", ["attack", "--count", "3"])
    assert begin("harm", harm, 1) == 1
    assert capsys.readouterr() == ("| harm | 3 | 1 harm |\n", "harm: 2 what was said\n")
