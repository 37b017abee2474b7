"""Commands write what they are asked to write and nothing else, and unpickle nothing."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

# Reports what Python writes and unpickles, but for the caches of modules, which are Python's own.
WATCHED = """
import json, os, sys
seen = []
def watch(event, given):
    if event == "open":
        path, mode, flags = given
        written = flags & (os.O_WRONLY | os.O_RDWR | os.O_CREAT)
        if written and isinstance(path, str) and path != os.devnull:
            seen.append(path)
    elif event in ("os.mkdir", "os.rename", "os.link", "os.symlink"):
        seen.append(str(given[0]))
    elif event in ("pickle.find_class", "marshal.load"):
        seen.append(event)
sys.addaudithook(watch)
from stackbounce.cli import main
code = main(sys.argv[2:])
content = json.dumps(seen)
with open(sys.argv[1], "w") as report:
    report.write(content)
sys.exit(code)
"""
COMMANDS = [
    ["simulate", "basketball", "tennis", "--json"],
    ["measure", "--heights", "1, 0.6, 0.36 m", "--mass", "57g", "--save", "ball.toml"],
    ["balls"],
    ["simulate", "B1", "B2", "--plot", "bounce.svg"],
    ["sweep", "B1", "B2", "--over", "gaps.0=0mm:5mm:10", "--out", "gap.zarr"],
    [
        "fit", "basketball", "tennis", "--height", "63cm", "--save", "fitted.toml", "--measured",
        "rebound_ratios.1=1.64 ± 0.02", "--vary", "contacts.1.stiffness=0.7kN/m:2.5kN/m",
    ],
    ["highest", "basketball", "tennis", "B3", "--masses"],
    ["paper", "--out", "paper"],
]  # fmt: skip


@pytest.mark.fast_cases(1)
@pytest.mark.parametrize("command", COMMANDS, ids=lambda command: command[0])
def test_nothing_else_is_written_and_nothing_is_unpickled(tmp_path, command):
    work, report = tmp_path / "work", tmp_path / "report.json"
    work.mkdir()
    fonts = tmp_path / "fonts"  # matplotlib keeps a list of the fonts
    temporary = tmp_path / "temporary"  # Python tries whether it can write there
    temporary.mkdir()
    nowhere = "/proc/none"  # in which not even root can write
    own = dict.fromkeys(("HOME", "XDG_CACHE_HOME", "XDG_CONFIG_HOME"), nowhere)
    own |= {"MPLCONFIGDIR": str(fonts), "TMPDIR": str(temporary), "PYTHONDONTWRITEBYTECODE": "1"}
    done = subprocess.run(
        [sys.executable, "-c", WATCHED, str(report), *command],
        env=os.environ | own, cwd=work, capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip
    assert (done.returncode, "rror" in done.stderr) == (0, False), done.stderr
    written = {Path(work, path) for path in json.loads(report.read_text("utf-8"))}
    ours = {work, fonts, temporary}
    assert {path for path in written if not ours & {path, *path.parents}} == set()
    assert list(temporary.iterdir()) == []
