"""Ask the page's own code, in node, what the library is asked in Python."""

import json
import shutil
import subprocess
from importlib.resources import files
from pathlib import Path

from stackbounce.explorer import LIMITS
from stackbounce.explorer.page.parts import KINDS, made_file

_ASK = Path(__file__).with_name("ask_page.mjs")


def lay_out(folder):
    """Write all files of the page to a folder, as node takes them."""
    shutil.copytree(str(files("stackbounce.explorer") / "static"), folder, dirs_exist_ok=True)
    (folder / "package.json").write_text('{"type": "module"}')
    (folder / "made").mkdir()
    for name in KINDS:
        (folder / "made" / name).write_bytes(made_file(name))
    return folder


def ask(page, questions, folder, events=LIMITS.events):
    """Return what the page answers, {answer} or {error} each; runs end after so many events."""
    asked, answered = folder / "asked.json", folder / "answered.json"
    asked.write_text(json.dumps(questions))
    command = ["node", _ASK, page, asked, answered, str(events)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    return json.loads(answered.read_text())
