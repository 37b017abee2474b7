"""The report's pages: the template engine and the typesetting of symbols."""

import base64
import re
from typing import TYPE_CHECKING

from stackbounce.files import shipped_table

if TYPE_CHECKING:
    import jinja2
    from markupsafe import Markup

_SIGNS = shipped_table(__package__, "signs.toml")["signs"]


def typeset(text: str) -> "Markup":
    """Return a text as HTML, with indices, powers and signs typeset."""
    from markupsafe import Markup, escape

    html = str(escape(text))
    for pattern, replacement in _SIGNS:
        html = re.sub(pattern, replacement, html)
    return Markup(html)


def data_uri(svg: bytes) -> str:
    """Return an SVG picture as a data URI."""
    return "data:image/svg+xml;base64," + base64.b64encode(svg).decode()


def make_environment() -> "jinja2.Environment":
    """Return the template environment of the report's pages."""
    import jinja2

    found = jinja2.Environment(
        loader=jinja2.PackageLoader("stackbounce.cross2007"),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )
    found.filters["typeset"] = typeset
    return found
