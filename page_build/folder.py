"""The explorer as one HTML file, and as a folder for any web server.

The file needs no server, no network and no installation. The folder works offline after the first
visit.
"""

import base64
import hashlib
import json
from collections.abc import Mapping

from page_build.assembly import assemble, read_static, with_policy
from stackbounce.explorer.made import PAGE_POLICY, digest

_HEAD = """\
  <link rel="stylesheet" href="explorer.css">
  <link rel="manifest" href="explorer.webmanifest">
  <script defer src="explorer.js"></script>
</head>"""
_OLD = '<p id="old" class="banner" data-t>'  # shown until the script runs, from a disk for good
_DISK = (
    "As a folder the explorer opens from a web server only. “stackbounce app --export "
    "explorer.html” writes it as one file, which opens from a disk. "
)
_MANIFEST = {
    "name": "stackbounce: the explorer",
    "short_name": "stackbounce",
    "start_url": "./",
    "display": "standalone",
    "icons": [{"src": "icon.svg", "type": "image/svg+xml", "sizes": "any"}],
}
_POLICY = (
    "default-src 'none'; script-src '{script}' 'wasm-unsafe-eval'; style-src '{style}'; "
    "worker-src blob:; img-src data: blob:; base-uri 'none'; form-action 'none'"
)


def folder_files(made: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return the files of the explorer by their paths in the folder.

    All addresses in them are relative. The service worker, ``offline.js``, keeps the files in the
    browser, under a name that is a digest of all of them.

    Parameters
    ----------
    made : mapping
        The engine, its layout, ``model.json`` and ``laws.js``, by their names.
    """
    html, styles, script = assemble("folder", made)
    page = with_policy(html, PAGE_POLICY).replace("</head>", _HEAD).replace(_OLD, _OLD + _DISK)
    files = {
        "index.html": page.encode(),
        "explorer.css": styles.encode(),
        "explorer.js": script.encode(),
        "explorer.webmanifest": json.dumps(_MANIFEST, indent=1).encode(),
        "icon.svg": read_static("icon.svg").encode(),
        **{f"made/{name}": made[name] for name in ("engine.wasm", "layout.json", "model.json")},
    }
    return files | {"offline.js": _offline(files)}


def _offline(files: dict[str, bytes]) -> bytes:
    """Return the service worker that keeps files; a server gives the page as the folder's own."""
    kept = {("./" if name == "index.html" else name): digest(files[name]) for name in files}
    listed = json.dumps(kept, indent=1)
    version = hashlib.sha256(listed.encode()).hexdigest()[:16]
    worker = read_static("js/origin/offline.js")
    return f'const VERSION = "{version}";\nconst FILES = {listed};\n\n{worker}'.encode()


def one_file(made: Mapping[str, bytes]) -> str:
    """Return the HTML of the whole explorer: page, engine and data.

    It asks for nothing when it is opened, and its content security policy lets it ask for nothing.
    It measures and fits nothing, which needs Python.

    Parameters
    ----------
    made : mapping
        The engine, its layout, ``model.json`` and ``laws.js``, by their names.
    """
    html, styles, script = assemble("one_file", made)
    if "</script" in script or "<!--" in script or "</style" in styles:
        raise AssertionError("a text of the page would end its own element")
    policy = _POLICY.format(script=digest(script.encode()), style=digest(styles.encode()))
    page = with_policy(html, policy)
    page = page.replace("</head>", f"<style>{styles}</style>\n</head>")
    engine = base64.b64encode(made["engine.wasm"]).decode()
    parts = [
        f'<script type="text/plain" id="engine">{engine}</script>',
        *(_data(name, made[f"{name}.json"]) for name in ("layout", "model")),
        f'<script id="program">{script}</script>',
    ]
    return page.replace("</body>", "\n".join([*parts, "</body>"]))


def _data(name: str, content: bytes) -> str:
    """Return an element with data in JSON, in which nothing can end the element."""
    inside = content.decode().replace("<", "\\u003c")
    return f'<script type="application/json" id="{name}">{inside}</script>'
