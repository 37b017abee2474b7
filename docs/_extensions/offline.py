"""The build fails if a page would fetch a script, style, image or font from somewhere else."""

import re
from collections.abc import Iterator
from html.parser import HTMLParser
from pathlib import Path

from sphinx.application import Sphinx
from sphinx.errors import ExtensionError

ELSEWHERE = re.compile(r"\s*(?:[a-z][a-z0-9+.-]*:)?//", re.IGNORECASE)
IN_STYLES = re.compile(r"(?:url\(|@import)\s*['\"]?\s*((?:https?:)?//[^'\")\s;]+)", re.IGNORECASE)
LOADS = {"data", "href", "poster", "src", "srcset", "xlink:href"}
ONLY_LINKS = {"a", "area", "base"}
LINKS_IN_HEAD = {"author", "canonical", "license", "next", "prev"}


class _Page(HTMLParser):
    """Collects the addresses elsewhere that a page loads from, links to follow left out."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.found: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = dict(attrs)
        if tag in ONLY_LINKS or set((given.get("rel") or "").split()) & LINKS_IN_HEAD:
            return
        self.found += [v for k, v in attrs if k in LOADS and v and ELSEWHERE.match(v)]


def fetched(folder: Path) -> Iterator[tuple[Path, str]]:
    """Yield each file below `folder` with each address elsewhere that it loads from."""
    for path in sorted(folder.rglob("*")):
        if path.suffix not in {".css", ".html", ".svg"}:
            continue
        text = path.read_text(encoding="utf-8")
        found = [] if path.suffix == ".css" else _Page(text).found
        for address in found + IN_STYLES.findall(text):
            yield path, address


def _check(app: Sphinx, failure: Exception | None) -> None:
    if failure is None and app.builder.format == "html":
        found = [f"{path.name} loads {address}" for path, address in fetched(Path(app.outdir))]
        if found:
            raise ExtensionError("the pages do not work offline: " + ", ".join(found))


def setup(app: Sphinx) -> dict[str, bool]:
    """Look at the pages once they are written."""
    app.connect("build-finished", _check)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
