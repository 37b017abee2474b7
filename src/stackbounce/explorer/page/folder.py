"""The explorer as a folder for any web server, which works offline after the first visit."""

import hashlib
import json

from stackbounce.explorer.page.assembly import assemble, digest, read_static, with_policy
from stackbounce.explorer.page.parts import made_file
from stackbounce.explorer.page.policy import PAGE

_MADE = ("engine.wasm", "layout.json", "model.json")
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


def folder_files() -> dict[str, bytes]:
    """Return the files of the explorer by their paths in the folder.

    All addresses in them are relative. The service worker, ``offline.js``, keeps the files in the
    browser, under a name that is a digest of all of them.

    Raises
    ------
    FileError
        If the package was built without the engine for browsers.

    Examples
    --------
    >>> sorted(folder_files())[:3]
    ['explorer.css', 'explorer.js', 'explorer.webmanifest']
    """
    html, styles, script = assemble("folder")
    page = with_policy(html, PAGE).replace("</head>", _HEAD).replace(_OLD, _OLD + _DISK)
    files = {
        "index.html": page.encode(),
        "explorer.css": styles.encode(),
        "explorer.js": script.encode(),
        "explorer.webmanifest": json.dumps(_MANIFEST, indent=1).encode(),
        "icon.svg": read_static("icon.svg").encode(),
        **{f"made/{name}": made_file(name) for name in _MADE},
    }
    return files | {"offline.js": _offline(files)}


def _offline(files: dict[str, bytes]) -> bytes:
    """Return the service worker that keeps files; a server gives the page as the folder's own."""
    kept = {("./" if name == "index.html" else name): digest(files[name]) for name in files}
    listed = json.dumps(kept, indent=1)
    version = hashlib.sha256(listed.encode()).hexdigest()[:16]
    worker = read_static("js/origin/offline.js")
    return f'const VERSION = "{version}";\nconst FILES = {listed};\n\n{worker}'.encode()
