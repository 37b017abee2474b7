"""The page in three texts: HTML, styles and script."""

import functools
import json
import re
from pathlib import Path

from page_build.bundle import bundle
from page_build.data import laws_js
from stackbounce import explorer

_STATIC = Path(explorer.__file__).parent / "static"
_ORIGIN = "js/origin/web.js"
_STYLE = re.compile(r'\s*<link rel="stylesheet" href="([^"]+)">')
_SCRIPT = re.compile(r'\s*<script type="module" src="([^"]+)"></script>')
_CHARSET = '<meta charset="utf-8">'


def assemble(origin: str) -> tuple[str, str, str]:
    """Return the page's HTML without its styles and its script, the styles, and one classic script.

    Parameters
    ----------
    origin : str
        The module of ``js/origin/`` by which the page comes: ``web`` or ``one_file``.

    Examples
    --------
    >>> assemble("one_file")[0][:15]
    '<!doctype html>'
    """
    page = read_static("index.html")
    begin = _SCRIPT.search(page)
    assert begin is not None
    styles = "".join(read_static(name) for name in _STYLE.findall(page))
    made = made_modules()
    script = bundle(functools.partial(_module, origin, made), begin[1], "js/engine/worker.js")
    return _SCRIPT.sub("", _STYLE.sub("", page)), styles, script


def made_modules() -> dict[str, str]:
    """Return the modules that are made of the package and of tables of words, by their paths.

    Examples
    --------
    >>> sorted(made_modules())
    ['made/languages.js', 'made/laws.js']
    """
    return {"made/laws.js": laws_js(), "made/languages.js": _language_module(_tables())}


def with_policy(html: str, policy: str) -> str:
    """Return a page with a content security policy in it.

    Examples
    --------
    >>> print(with_policy('<meta charset="utf-8">', "default-src 'none'"))
    <meta charset="utf-8">
      <meta http-equiv="Content-Security-Policy" content="default-src 'none'">
    """
    head = f'{_CHARSET}\n  <meta http-equiv="Content-Security-Policy" content="{policy}">'
    return html.replace(_CHARSET, head)


def read_static(name: str) -> str:
    """Return one of the page's files in ``static/``, a text.

    Examples
    --------
    >>> "caches.open" in read_static("js/origin/offline.js")
    True
    """
    return (_STATIC / name).read_text("utf-8")


def _module(origin: str, made: dict[str, str], path: str) -> str:
    """Return the text of a module."""
    if path in made:
        return made[path]
    return read_static(f"js/origin/{origin}.js" if path == _ORIGIN else path)


def _language_module(tables: dict[str, dict[str, str]]) -> str:
    """Return the module that exports the tables: the English sentences stand in it once."""
    keys = list(dict.fromkeys(key for table in tables.values() for key in table))
    said = {code: [table.get(key, 0) for key in keys] for code, table in tables.items()}
    return f"""const keys = {json.dumps(keys, ensure_ascii=False)};
const said = {json.dumps(said, ensure_ascii=False)};
const table = (texts) => texts.flatMap((text, i) => (text ? [[keys[i], text]] : []));
const all = Object.entries(said).map(([code, texts]) => [code, Object.fromEntries(table(texts))]);
export const tables = Object.fromEntries(all);"""


def _tables() -> dict[str, dict[str, str]]:
    """Return the page's sentences in each language, by the English ones."""
    found = sorted((_STATIC / "js" / "languages").glob("*.json"))
    return {path.stem: json.loads(path.read_text("utf-8")) for path in found}
