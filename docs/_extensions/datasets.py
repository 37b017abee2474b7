"""The directive `datasets`: the table of the published measurements."""

from typing import Any

from docutils.nodes import Element, Node
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from stackbounce.datasets import Description, describe, names


def row(about: Description) -> str:
    """Return a dataset's row: its name, what it is, what was read of which source."""
    link = f"[{about.source}]({about.address})"
    quoted = f", quoted by {about.quoted_by}" if about.quoted_by else ""
    return f"| `{about.name}` | {about.title} | {link}{quoted} | {about.seen} |"


class Datasets(SphinxDirective):
    """Writes the table where it stands."""

    def run(self) -> list[Node]:
        """Return the table."""
        head = ["| Name | What | Source | Read |", "|---|---|---|---|"]
        rows = [row(describe(name)) for name in names()]
        lines = StringList([*head, *rows], source="stackbounce.datasets")
        holder = Element()
        self.state.nested_parse(lines, self.content_offset, holder)
        return holder.children


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directive."""
    app.add_directive("datasets", Datasets)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
