"""Sphinx extension: the explorer as one file among the pages, and links to what it shows.

``{explorer}`words <WHAT>` `` links to the explorer's drop WHAT: the name of one of its examples,
such as ``cannon``, or balls of the catalogue with commas, the lowest first, then ``key=value``
pairs. ``gap`` and ``height`` change the drop, in units; all others are settings that the address
has, such as ``view=line``.
"""

from pathlib import Path
from typing import Any
from urllib.parse import quote

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import ReferenceRole

NAME = "explorer.html"


def setup(app: Sphinx) -> dict[str, Any]:
    """Write the file once the pages are written, and add the role."""
    app.connect("build-finished", _write)
    app.add_role("explorer", ExplorerRole())
    return {"version": "1", "parallel_read_safe": True}


def _write(app: Sphinx, exception: Exception | None) -> None:
    from stackbounce.web.page.one_file import one_file

    if exception is None and app.builder.format == "html":
        (Path(app.outdir) / NAME).write_text(one_file(), "utf-8")


class ExplorerRole(ReferenceRole):
    """A link to a drop in the explorer."""

    def run(self) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        """Return the link; its address is relative to the page that it stands on."""
        up = "../" * self.env.docname.count("/")
        uri = f"{up}{NAME}#{fragment(self.target)}"
        return [nodes.reference("", self.title, refuri=uri, internal=True)], []


def fragment(what: str) -> str:
    """Return the part of the explorer's address after the ``#``."""
    names, settings = _read(what)
    drop = _drop(names, settings)
    settings.setdefault("view", "play")
    pairs = [("view", settings.pop("view"))]
    _flatten("", drop, pairs)
    pairs += settings.items()
    return "&".join(f"{key}={quote(str(value), safe='/')}" for key, value in pairs)


def _read(what: str) -> tuple[str, dict[str, str]]:
    """Return the balls or the example, and the pairs after them."""
    words = what.split()
    first = next((i for i, word in enumerate(words) if "=" in word), len(words))
    settings = dict(word.split("=", 1) for word in words[first:])
    return " ".join(words[:first]), settings


def _drop(names: str, settings: dict[str, str]) -> dict[str, Any]:
    from stackbounce.cross2007.cases import list_cases
    from stackbounce.model import Drop
    from stackbounce.model.catalogue import stack
    from stackbounce.units import quantity
    from stackbounce.web.answers.examples import list_examples

    cases = {case.name: case.drop for case in (*list_examples(), *list_cases())}
    if names in cases:
        return cases[names].to_mapping()
    chosen = stack([name.strip() for name in names.split(",")])
    gap = quantity(settings.pop("gap", "0 m"), "m", "gap")
    height = quantity(settings.pop("height", "1m"), "m", "height")
    gaps = [gap] * (len(chosen.balls) - 1)
    return Drop(chosen.balls, chosen.contacts, gaps, height=height).to_mapping()


def _flatten(path: str, value: Any, pairs: list[tuple[str, Any]]) -> None:
    members = value.items() if isinstance(value, dict) else enumerate(value)
    for key, member in members:
        place = f"{path}.{key}" if path else str(key)
        if isinstance(member, dict | list | tuple):
            _flatten(place, member, pairs)
        elif member is not None:
            pairs.append((place, member))
