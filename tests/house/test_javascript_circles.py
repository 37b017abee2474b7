"""No two files of the page import each other, in whatever way round."""

import posixpath
import re
from importlib.resources import files
from pathlib import Path

SCRIPTS = Path(str(files("stackbounce.explorer") / "static" / "js"))
_NAMED = re.compile(
    r'^(?:import|export)\b[^;"]*?from "(\.[^"]+)";|\bimport\("(\.[^"]+)"\)',
    re.MULTILINE | re.DOTALL,
)


def imports():
    """Return the own files that each file of the page imports, at once or later."""
    found = {}
    for script in SCRIPTS.rglob("*.js"):
        own = script.relative_to(SCRIPTS)
        names = [one or later for one, later in _NAMED.findall(script.read_text("utf-8"))]
        paths = {posixpath.normpath(posixpath.join(own.parent.as_posix(), one)) for one in names}
        found[own.as_posix()] = {path for path in paths if not path.startswith("../")}
    return found


def test_every_file_imports_files_that_are_there():
    found = imports()
    assert len(found) > 50
    assert set().union(*found.values()) <= set(found)


def test_no_circles():
    left = imports()
    while free := [name for name, needed in left.items() if not needed & left.keys()]:
        for name in free:
            del left[name]
    assert not left
