"""The directive `measure-options`: the table of the options of a measurement."""

from typing import Any

from docutils.nodes import Element, Node
from docutils.statemachine import StringList
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from stackbounce.measure.kinds import KINDS, TYPED
from stackbounce.measure.options import OPTIONS, Option


def taken_by(option: Option) -> list[str]:
    """Return the kinds whose analysis takes an option; the reader's are for every file."""
    kinds = {**KINDS, **{kind.name: kind for kind in TYPED}}
    return [name for name, kind in kinds.items() if option.name in kind.options]


def row(option: Option) -> str:
    """Return an option's row: on the command line, in Python, what it tells, for which kinds."""
    kinds = "every file" if option.to == "read" else ", ".join(taken_by(option))
    told = f"{option.label}. {option.says}"
    return f"| `{option.on_command_line}` | `{option.name}` | {told} | {kinds} |"


class MeasureOptions(SphinxDirective):
    """Writes the table where it stands."""

    def run(self) -> list[Node]:
        """Return the table."""
        head = ["| Command line | Python | Tells | For |", "|---|---|---|---|"]
        lines = StringList([*head, *map(row, OPTIONS)], source="stackbounce.measure.options")
        holder = Element()
        self.state.nested_parse(lines, self.content_offset, holder)
        return holder.children


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directive."""
    app.add_directive("measure-options", MeasureOptions)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
