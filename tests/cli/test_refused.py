"""Commands that are refused in one line: ``refused.toml`` lists them."""

import shlex
import shutil
import tomllib
from pathlib import Path

import pytest

from measure import make_files as made

LAB = Path(__file__).parents[2] / "docs" / "lab"
TABLE = tomllib.loads(Path(__file__).with_name("refused.toml").read_text(encoding="utf-8"))
LINES = [
    (f"{group['command']} {words}", line)
    for group in TABLE["refused"]
    for words, line in group["lines"]
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("refused")
    shutil.copytree(LAB, folder, dirs_exist_ok=True)
    made.main(folder / "made")
    (folder / "folder.svg").mkdir()
    for name, text in TABLE["files"].items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


def files(folder):
    return {path: path.stat().st_mtime_ns for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize(("command", "line"), LINES)
def test_it_says_why_and_writes_nothing(refused, folder, monkeypatch, command, line):
    monkeypatch.chdir(folder)
    before = files(folder)
    err = refused(*shlex.split(command)).removesuffix("\n")
    assert err.startswith(line.removesuffix("…"))
    assert line.endswith("…") or err == line
    assert files(folder) == before
