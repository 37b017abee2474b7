"""What the pages of the documentation show of a console."""

import re
import shlex

from stackbounce.cli import main

__all__ = ["run_all", "steps"]

FENCE = re.compile(r"^```console\n(.*?)^```", re.MULTILINE | re.DOTALL)


def steps(text):
    """Return each command of a page with the lines that it shows of what is printed."""
    found = []
    for fence in FENCE.findall(text):
        for block in fence.replace("\\\n", " ").split("$ ")[1:]:
            command, *lines = block.splitlines()
            found.append((shlex.split(command)[1:], [" ".join(line.split()) for line in lines]))
    return found


def run_all(text, capsys):
    """Run the commands of a page in turn; each line that it shows begins one that is printed."""
    for command, shown in steps(text):
        assert main(command) == 0, command
        printed = [" ".join(line.split()) for line in capsys.readouterr().out.splitlines()]
        for line in shown:
            assert any(own.startswith(line) for own in printed), (command, line, printed)
