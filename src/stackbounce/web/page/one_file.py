"""The explorer as one HTML file, which needs no server, no network and no installation."""

import base64
import hashlib
import json
import re
from pathlib import Path

from stackbounce.web.page.bundle import bundle
from stackbounce.web.page.parts import made_file

__all__ = ["one_file"]

_STATIC = Path(__file__).parent.parent / "static"
_SERVED, _ALONE = "js/origin/served.js", "js/origin/one_file.js"
_POLICY = (
    "default-src 'none'; script-src '{script}' 'wasm-unsafe-eval'; style-src '{style}'; "
    "worker-src blob:; img-src data: blob:; base-uri 'none'; form-action 'none'"
)
_STYLE = re.compile(r'\s*<link rel="stylesheet" href="([^"]+)">')
_SCRIPT = re.compile(r'\s*<script type="module" src="([^"]+)"></script>')
_CHARSET = '<meta charset="utf-8">'


def one_file() -> str:
    """Return the HTML of the whole explorer: page, engine and data.

    It asks for nothing when it is opened, and its content security policy lets it ask for nothing.
    It measures and fits nothing, which needs Python.

    Raises
    ------
    FileError
        If the package was built without the engine for browsers.

    Examples
    --------
    >>> one_file()[:15]
    '<!doctype html>'
    """
    page = (_STATIC / "index.html").read_text("utf-8")
    begin = _SCRIPT.search(page)
    assert begin is not None
    styles = "".join(_read(name) for name in _STYLE.findall(page))
    script = bundle(_module, begin[1], "js/engine/worker.js")
    if "</script" in script or "<!--" in script or "</style" in styles:
        raise AssertionError("a text of the page would end its own element")
    policy = _POLICY.format(script=_digest(script), style=_digest(styles))
    head = f'{_CHARSET}\n  <meta http-equiv="Content-Security-Policy" content="{policy}">'
    icon = base64.b64encode((_STATIC / "icon.svg").read_bytes()).decode()
    page = _SCRIPT.sub("", _STYLE.sub("", page)).replace(_CHARSET, head)
    page = page.replace('href="icon.svg"', f'href="data:image/svg+xml;base64,{icon}"')
    page = page.replace("</head>", f"<style>{styles}</style>\n</head>")
    engine = base64.b64encode(made_file("engine.wasm")).decode()
    parts = [
        f'<script type="text/plain" id="engine">{engine}</script>',
        *(_data(name) for name in ("layout", "model")),
        f'<script id="program">{script}</script>',
    ]
    return page.replace("</body>", "\n".join([*parts, "</body>"]))


def _read(name: str) -> str:
    return (_STATIC / name).read_text("utf-8")


def _module(path: str) -> str:
    """Return the text of a module of the one file."""
    folder, _, name = path.partition("/")
    if folder == "made":
        return made_file(name).decode()
    return _read(_ALONE if path == _SERVED else path)


def _data(name: str) -> str:
    """Return an element with data in JSON, in which nothing can end the element."""
    text = json.dumps(
        json.loads(made_file(f"{name}.json")), ensure_ascii=False, separators=(",", ":")
    )
    inside = text.replace("<", "\\u003c")
    return f'<script type="application/json" id="{name}">{inside}</script>'


def _digest(text: str) -> str:
    """Return what a content security policy calls an inline text."""
    return f"sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}"
