"""Sphinx extension: the explorer as one file among the pages, and links to what it shows.

``{explorer}`words <WHAT>` `` links to the explorer's drop WHAT, as
`page_build.lessons.lesson` reads it.
"""

from pathlib import Path
from typing import Any

from docutils import nodes
from page_build.lessons.lesson import explorer_fragment
from sphinx.application import Sphinx
from sphinx.util.docutils import ReferenceRole

NAME = "explorer.html"


def setup(app: Sphinx) -> dict[str, Any]:
    """Write the file once the pages are written, and add the role."""
    app.connect("build-finished", _write)
    app.add_role("explorer", ExplorerRole())
    return {"version": "1", "parallel_read_safe": True}


def _write(app: Sphinx, exception: Exception | None) -> None:
    from stackbounce.explorer.made import one_file

    if exception is None and app.builder.format == "html":
        (Path(app.outdir) / NAME).write_text(one_file(), "utf-8")


class ExplorerRole(ReferenceRole):
    """A link to a drop in the explorer."""

    def run(self) -> tuple[list[nodes.Node], list[nodes.system_message]]:
        """Return the link; its address is relative to the page that it stands on."""
        up = "../" * self.env.docname.count("/")
        uri = f"{up}{NAME}#{explorer_fragment(self.target)}"
        return [nodes.reference("", self.title, refuri=uri, internal=True)], []
