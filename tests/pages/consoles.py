"""What the pages of the documentation show of a console."""

import re
import shlex
from pathlib import Path

from stackbounce.cli import main

DOCS = Path(__file__).parents[2] / "docs"
FENCE = re.compile(r"^```console\n(.*?)^```", re.MULTILINE | re.DOTALL)
TOML = re.compile(r"^```toml\n# (\S+)\n(.*?)^```", re.MULTILINE | re.DOTALL)


def read_page(name):
    return (DOCS / f"{name}.md").read_text(encoding="utf-8")


def write_files(text, folder):
    """Write the scenarios of a page to files, by the names that it gives them."""
    for name, content in TOML.findall(text):
        (folder / name).write_text(content, encoding="utf-8")


def steps(text):
    """Return each command of a page with the lines that it shows of what is printed."""
    found = []
    for fence in FENCE.findall(text):
        for block in fence.replace("\\\n", " ").split("$ ")[1:]:
            command, *lines = block.splitlines()
            found.append((shlex.split(command)[1:], lines))
    return found


def run_all(steps, capsys, whole=False):
    """Run commands in turn; each line shown begins one that is printed, or all are shown."""
    for command, shown in steps:
        assert main(command) == 0, command
        printed = capsys.readouterr().out.strip().splitlines()
        if whole:
            assert [line.rstrip() for line in printed] == shown, command
        printed = [" ".join(line.split()) for line in printed]
        for line in shown:
            own = " ".join(line.split())
            assert any(one.startswith(own) for one in printed), (command, line, printed)
