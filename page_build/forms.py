"""The explorer as files for web servers, and as one HTML file.

The server of stackbounce gives the page that also measures and fits. Any other has the page in a
folder, which works offline after the first visit. The one file needs no server, no network and no
installation.
"""

import base64
import hashlib
import json
from collections.abc import Mapping

from page_build.assembly import assemble, read_static, with_policy
from stackbounce.explorer.made import FOLDER_PAGE, OF_FOLDER, PAGE, PAGE_POLICY, digest

_HEAD = """\
  <link rel="stylesheet" href="explorer.css">
  <script defer src="explorer.js"></script>
</head>"""
_MANIFEST_LINK = '  <link rel="manifest" href="explorer.webmanifest">\n</head>'
_ROOT = '<html lang="en"'
_AS_THEY_ARE = (
    "icon.svg",
    "js/views/measure/microphone_worklet.js",
    "examples/floor-force.csv",
    "examples/two-tracks.csv",
)
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


def web_files(data: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return the files of the explorer for web servers, by their names.

    All addresses in them are relative. The service worker, ``offline.js``, keeps the files of the
    folder in the browser, under a name that is a digest of all of them.

    Parameters
    ----------
    data : mapping
        The engine, its layout, ``model.json`` and ``options.json``, by their names.
    """
    html, styles, script = assemble("web")
    page = html.replace("</head>", _HEAD)
    folder = with_policy(page, PAGE_POLICY).replace(_ROOT, f'{_ROOT} data-form="folder"')
    folder = folder.replace("</head>", _MANIFEST_LINK).replace(_OLD, _OLD + _DISK)
    texts = {
        PAGE: page,
        FOLDER_PAGE: folder,
        "explorer.css": styles,
        "explorer.js": script,
        "explorer.webmanifest": json.dumps(_MANIFEST, indent=1),
        **{path.rpartition("/")[2]: read_static(path) for path in _AS_THEY_ARE},
    }
    files = {name: text.encode() for name, text in texts.items()} | dict(data)
    return files | {"offline.js": _offline(files)}


def _offline(files: dict[str, bytes]) -> bytes:
    """Return the service worker that keeps files; a server gives the page as the folder's own."""
    kept = {name: digest(files[name]) for name in OF_FOLDER if name in files}
    kept["./"] = digest(files[FOLDER_PAGE])
    listed = json.dumps(kept, indent=1)
    version = hashlib.sha256(listed.encode()).hexdigest()[:16]
    worker = read_static("js/origin/offline.js")
    return f'const VERSION = "{version}";\nconst FILES = {listed};\n\n{worker}'.encode()


def one_file(data: Mapping[str, bytes]) -> str:
    """Return the HTML of the whole explorer: page, engine and data.

    It asks for nothing when it is opened, and its content security policy lets it ask for nothing.
    It measures and fits nothing, which needs Python.

    Parameters
    ----------
    data : mapping
        As for `web_files`.
    """
    html, styles, script = assemble("one_file")
    if "</script" in script or "<!--" in script or "</style" in styles:
        raise AssertionError("a text of the page would end its own element")
    policy = _POLICY.format(script=digest(script.encode()), style=digest(styles.encode()))
    page = with_policy(html, policy)
    page = page.replace("</head>", f"<style>{styles}</style>\n</head>")
    engine = base64.b64encode(data["engine.wasm"]).decode()
    parts = [
        f'<script type="text/plain" id="engine">{engine}</script>',
        *(_element(name, data[f"{name}.json"]) for name in ("layout", "model")),
        f'<script id="program">{script}</script>',
    ]
    return page.replace("</body>", "\n".join([*parts, "</body>"]))


def _element(name: str, content: bytes) -> str:
    """Return an element with data in JSON, in which nothing can end the element."""
    inside = content.decode().replace("<", "\\u003c")
    return f'<script type="application/json" id="{name}">{inside}</script>'
