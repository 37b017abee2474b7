"""ES modules to one classic script: what a file opened from a disk can run.

A browser loads no modules from a disk. Here each module becomes a function that fills in its
exports, and is called when it is first needed. Only the forms of import and export that the page's
modules have are known.
"""

import posixpath
import re
from collections.abc import Callable

from stackbounce.errors import InvalidValue

_IMPORT = re.compile(r'^import\s+(\w+|\*\s*as\s+\w+|\{[^}]*\})\s*from\s*"([^"]+)";$', re.MULTILINE)
_PASSED = re.compile(r'^export\s*\{([^}]*)\}(?:\s*from\s*"([^"]+)")?;$', re.MULTILINE)
_DECLARED = re.compile(
    r"^export ((?:async )?function\*?|class|const|let) (\{[^}]*\}|\w+)", re.MULTILINE
)
_COMMENT = re.compile(r"^\s*(?://.*|/\*(?:(?!Copyright)[^*]|\*(?!/))*\*/)[^\S\n]*\n", re.MULTILINE)
_LEFT = re.compile(r"^\s*(?:import|export)\b|\bimport\b\s*[.(]", re.MULTILINE)


def bundle(read: Callable[[str], str], page: str, worker: str) -> str:
    """Return one classic script of modules: it runs one in the page, and another in a worker.

    Parameters
    ----------
    read : callable
        Returns the text of a module by its path, such as ``js/main.js``.
    page, worker : str
        The paths of the modules that begin.

    Raises
    ------
    InvalidValue
        If a module has an import or export of another form.

    Examples
    --------
    >>> texts = {"a.js": 'import { b } from "./b.js";', "b.js": "export const b = 1;"}
    >>> "const { b } = use(" in bundle(texts.__getitem__, "a.js", "b.js")
    True
    """
    made: dict[str, str] = {}
    waiting = [page, worker]
    while waiting:
        path = waiting.pop()
        if path not in made:
            made[path], needed = _rewritten(path, read(path))
            waiting += needed
    texts = [f'modules["{path}"] = (exports) => {{\n{made[path]}}};' for path in sorted(made)]
    return "\n".join([
        '"use strict";',
        "(() => {",
        "const modules = {};",
        "const known = {};",
        "const use = (path) => {",
        "  if (!known[path]) modules[path]((known[path] = {}));",
        "  return known[path];",
        "};",
        *texts,
        f'use(typeof document === "undefined" ? "{worker}" : "{page}");',
        "})();",
        "",
    ])  # fmt: skip


def _rewritten(path: str, text: str) -> tuple[str, list[str]]:
    """Return a module as the body of a function, and the paths of the modules that it needs."""
    needed: list[str] = []
    exported: dict[str, str] = {}

    def used(other: str) -> str:
        found = posixpath.normpath(posixpath.join(posixpath.dirname(path), other))
        needed.append(found)
        return f'use("{found}")'

    def imported(match: re.Match[str]) -> str:
        names, other = match.groups()
        if names.startswith("{"):
            return f"const {names.replace(' as ', ': ')} = {used(other)};"
        if names.startswith("*"):
            return f"const {names.rpartition(' ')[2]} = {used(other)};"
        return f"const {names} = {used(other)}.default;"

    def passed(match: re.Match[str]) -> str:
        names, other = match.groups()
        for name in filter(None, (part.strip() for part in names.split(","))):
            own, _, outer = name.partition(" as ")
            exported[outer or own] = f"{used(other)}.{own}" if other else own
        return ""

    def declared(match: re.Match[str]) -> str:
        kind, name = match.groups()
        for part in name.strip("{} ").split(","):
            exported[part.strip()] = part.strip()
        return f"{kind} {name}"

    text = _IMPORT.sub(imported, _COMMENT.sub("", text))  # an export in a comment is none
    text = _DECLARED.sub(declared, _PASSED.sub(passed, text))
    left = _LEFT.search(text)
    if left:
        raise InvalidValue(f"{path} must have plain imports and exports, got {left[0].strip()}")
    pairs = ", ".join(f"{outer}: {own}" for outer, own in exported.items())
    return f"{text}\nObject.assign(exports, {{ {pairs} }});\n", needed
