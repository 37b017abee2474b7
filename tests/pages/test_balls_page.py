"""The page on balls: its table is the catalogue's."""

import re

from pages.consoles import read_page
from stackbounce.model.catalogue import CLASS_BALLS

TEXT = read_page("balls")
MARKS = {"measured": "", "rule": " (r)", "estimate": " (e)"}


def test_the_table_is_that_of_the_catalogue():
    rows = re.findall(r"^\| `(.*?)` \| (.*) \|$", TEXT, re.MULTILINE)
    wanted = []
    for entry in CLASS_BALLS:
        figures = {
            "mass": f"{1e3 * entry.ball.mass:.4g} g",
            "diameter": f"{1e3 * entry.ball.diameter:.4g} mm",
            "restitution": f"{entry.restitution:.2f}",
            "contact_time": f"{1e3 * entry.contact_time:.2g} ms",
        }
        cells = [text + MARKS[entry.kind_of(name)] for name, text in figures.items()]
        wanted.append((entry.ball.name.replace(" ", "-"), " | ".join(cells)))
    assert rows == wanted
