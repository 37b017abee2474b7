"""Formulas as MathML, written while the pages are built: no script and no font to fetch."""

import re
from xml.etree import ElementTree as ET

from docutils import nodes
from latex2mathml.converter import convert
from sphinx.application import Sphinx
from sphinx.util import logging
from sphinx.util.math import get_node_equation_number
from sphinx.writers.html5 import HTML5Translator

logger = logging.getLogger(__name__)

CHILDREN = {"mfrac": 2, "mover": 2, "mroot": 2, "msub": 2, "msubsup": 3, "msup": 2, "munder": 2}
UPRIGHT = re.compile(r"<mi>(&#x000[4-7][0-9A-F];)</mi>")  # how latex2mathml writes \mathrm{d}


def mathml(latex: str, display: bool) -> str:
    """Return a formula as MathML.

    Raises
    ------
    ValueError
        If latex2mathml did not understand the formula, which it says by its output only.
    """
    latex = re.sub(r"\{aligned\}", "{split}", latex)
    if r"\\" in latex and r"\begin" not in latex:
        latex = rf"\begin{{split}} {latex} \end{{split}}"
    try:
        text = convert(latex, display="block" if display else "inline")
        root = ET.fromstring(text)
    except Exception as error:
        raise ValueError(f"{type(error).__name__} {error}") from error
    for element in root.iter():
        name = element.tag.rpartition("}")[2]
        if "\\" in (element.text or ""):
            raise ValueError(f"unknown command {element.text}")
        if name == "mspace" and "linebreak" in element.attrib:
            raise ValueError("unknown environment")
        if name in CHILDREN and len(element) != CHILDREN[name]:
            raise ValueError(f"{name} of {len(element)} parts instead of {CHILDREN[name]}")
    return UPRIGHT.sub(r'<mi mathvariant="normal">\1</mi>', text)


def _formula(self: HTML5Translator, node: nodes.Element, display: bool) -> str:
    try:
        return mathml(node.astext(), display)
    except ValueError as error:
        logger.warning("formula %r: %s", node.astext(), error, location=node)
        return f"<code>{self.encode(node.astext())}</code>"


def visit_math(self: HTML5Translator, node: nodes.math) -> None:
    """Write a formula in the line."""
    self.body.append(_formula(self, node, display=False))
    raise nodes.SkipNode


def visit_displaymath(self: HTML5Translator, node: nodes.math_block) -> None:
    """Write a formula on a line of its own, with its number where it has one."""
    self.body.append(self.starttag(node, "div", CLASS="math"))
    self.body.append(_formula(self, node, display=True))
    if node["number"]:
        self.body.append(f'<span class="eqno">({get_node_equation_number(self, node)})')
        self.add_permalink_ref(node, "Link to this equation")
        self.body.append("</span>")
    self.body.append("</div>\n")
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the renderer under the name ``mathml``."""
    app.add_html_math_renderer("mathml", (visit_math, None), (visit_displaymath, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
