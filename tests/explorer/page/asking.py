"""Ask the page's own code, in node, what the library is asked in Python."""

import json
import shutil
import subprocess
from importlib.resources import files
from pathlib import Path

from page_build.assembly import made_modules

from stackbounce.explorer import LIMITS
from stackbounce.explorer.made import made_file


def lay_out(folder):
    """Write all files of the page to a folder, as node takes them."""
    shutil.copytree(str(files("stackbounce.explorer") / "static"), folder, dirs_exist_ok=True)
    (folder / "package.json").write_text('{"type": "module"}')
    (folder / "made").mkdir()
    for path, text in made_modules().items():
        (folder / path).write_text(text)
    for name in ("engine.wasm", "layout.json", "model.json"):
        (folder / "made" / name).write_bytes(made_file(name))
    return folder


def ask(page, questions, folder, events=LIMITS.events):
    """Return what the page answers, {answer} or {error} each; runs end after so many events."""
    return run_node("ask_page", page, questions, folder, events)


def run_node(script, page, questions, folder, *given):
    """Return what a script of this folder answers to questions about the page."""
    asked, answered = folder / "asked.json", folder / "answered.json"
    asked.write_text(json.dumps(questions))
    command = ["node", Path(__file__).with_name(f"{script}.mjs"), page, asked, answered]
    command += map(str, given)
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    return json.loads(answered.read_text("utf-8"))
