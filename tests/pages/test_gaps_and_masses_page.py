"""The page on gaps, stacks and masses: its commands print what stands there, and draw."""

import re
import shlex
from pathlib import Path

import pytest

from stackbounce.cli import main

DOCS = Path(__file__).parents[2] / "docs"
TEXT = (DOCS / "gaps-and-masses.md").read_text(encoding="utf-8")
FENCE = r"^```console\n\$ (stackbounce (?:.*\\\n)*.*)\n((?:.*\n)*?)```"
RUNS = [
    (shlex.split(command.replace("\\\n", " "))[1:], printed)
    for command, printed in re.findall(FENCE, TEXT, re.MULTILINE)
]


@pytest.fixture(autouse=True)
def _in_a_folder_with_its_files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    files = re.findall(r"^```toml\n# (\S+)\n(.*?)^```", TEXT, re.MULTILINE | re.DOTALL)
    for name, text in files:
        Path(name).write_text(text, encoding="utf-8")


@pytest.mark.fast_cases(1)
@pytest.mark.parametrize(
    ("command", "printed"), RUNS, ids=[" ".join(words[:2]) for words, _ in RUNS]
)
def test_a_command_prints_what_stands_there(command, printed, capsys):
    assert main(command) == 0
    out = capsys.readouterr().out.strip().splitlines()
    assert [line.rstrip() for line in out] == printed.splitlines()
    if "--plot" in command:
        assert Path(command[command.index("--plot") + 1]).stat().st_size > 10_000
    if "--save" in command:
        saved = command[command.index("--save") + 1]
        assert main(["simulate", saved]) == 0


def test_all_commands_of_the_page_are_run():
    assert len(RUNS) == TEXT.count("$ stackbounce") == 5
    assert TEXT.count("--plot") == 2
