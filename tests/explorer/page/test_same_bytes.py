"""The explorer as one file is the same, byte for byte, each time that it is made."""

import os
import subprocess
import sys
from pathlib import Path

from stackbounce.explorer.made import one_file

ROOT = Path(__file__).parents[3]
WRITE = """import sys
from pathlib import Path
from page_build.build import list_files
from stackbounce.engine.native import FOLDER
sys.stdout.write(list_files(Path(FOLDER))["explorer.html"].decode())"""


def written(seed):
    """Return the file as a process writes it whose sets have an order of their own."""
    environment = {**os.environ, "PYTHONHASHSEED": seed, "PYTHONIOENCODING": "utf-8"}
    command = [sys.executable, "-c", WRITE]
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, check=True)
    return done.stdout.decode()


def test_the_file_does_not_depend_on_the_order_of_sets():
    assert written("1") == written("2") == one_file()
