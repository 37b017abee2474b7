"""Captions of lists of pages are headings, and say of which level, as ARIA asks of them."""

from typing import Any

from sphinx.application import Sphinx

AFTER_THEME = 900
"""Sphinx's usual priority is 500, at which the theme makes its list of pages."""


def _add_level(
    _app: Sphinx, _page: str, _template: str, context: dict[str, Any], _tree: Any
) -> None:
    for part in {"body", "furo_navigation_tree"} & context.keys():
        context[part] = context[part].replace('role="heading"', 'role="heading" aria-level="2"')


def setup(app: Sphinx) -> dict[str, bool]:
    """Look at each page before it is written."""
    app.connect("html-page-context", _add_level, priority=AFTER_THEME)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
