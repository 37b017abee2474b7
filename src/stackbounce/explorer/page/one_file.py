"""The explorer as one HTML file, which needs no server, no network and no installation."""

import base64
import json

from stackbounce.explorer.page.assembly import assemble, digest, with_policy
from stackbounce.explorer.page.parts import made_file

_POLICY = (
    "default-src 'none'; script-src '{script}' 'wasm-unsafe-eval'; style-src '{style}'; "
    "worker-src blob:; img-src data: blob:; base-uri 'none'; form-action 'none'"
)


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
    html, styles, script = assemble("one_file")
    if "</script" in script or "<!--" in script or "</style" in styles:
        raise AssertionError("a text of the page would end its own element")
    policy = _POLICY.format(script=digest(script.encode()), style=digest(styles.encode()))
    page = with_policy(html, policy)
    page = page.replace("</head>", f"<style>{styles}</style>\n</head>")
    engine = base64.b64encode(made_file("engine.wasm")).decode()
    parts = [
        f'<script type="text/plain" id="engine">{engine}</script>',
        *(_data(name) for name in ("layout", "model")),
        f'<script id="program">{script}</script>',
    ]
    return page.replace("</body>", "\n".join([*parts, "</body>"]))


def _data(name: str) -> str:
    """Return an element with data in JSON, in which nothing can end the element."""
    text = json.dumps(
        json.loads(made_file(f"{name}.json")), ensure_ascii=False, separators=(",", ":")
    )
    inside = text.replace("<", "\\u003c")
    return f'<script type="application/json" id="{name}">{inside}</script>'
