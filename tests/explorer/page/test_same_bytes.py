"""The explorer as one file is the same, byte for byte, each time that it is written."""

import os
import subprocess
import sys

WRITE = """import sys
from stackbounce.explorer.page.folder import one_file
sys.stdout.write(one_file())"""


def written(seed):
    """Return the file as a process writes it whose sets have an order of their own."""
    environment = {**os.environ, "PYTHONHASHSEED": seed, "PYTHONIOENCODING": "utf-8"}
    command = [sys.executable, "-c", WRITE]
    return subprocess.run(command, env=environment, capture_output=True, check=True).stdout


def test_the_file_does_not_depend_on_the_order_of_sets():
    one = written("1")
    assert one.startswith(b"<!doctype html>")
    assert one == written("2")
