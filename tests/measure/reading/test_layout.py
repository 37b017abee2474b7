"""A layout is one place: a function that is registered makes its files readable."""

from stackbounce.measure.reading.layouts import LAYOUTS, Layout, first_row, layout
from stackbounce.measure.reading.roles import column, heading
from stackbounce.measure.reading.text import Text

FILE = "TOYLOGGER 3\nms kN\n0 0\n1 0.5\n2 0.25\n"


def toy_logger(text: Text) -> Layout | None:
    """A program that writes units alone, of times and forces."""
    if text.head[0][:1] != ["TOYLOGGER"]:
        return None
    columns = tuple(
        column(k, heading(name, text.head[1][k]), name) for k, name in enumerate(("time", "force"))
    )
    return Layout("Toy Logger", "it begins with TOYLOGGER", columns, first_row(text, 2))


def test_a_registered_layout_is_all_that_a_format_takes(read):
    assert read(FILE).attrs["format"] == "table of numbers"
    layout(toy_logger)
    try:
        data = read(FILE)
    finally:
        LAYOUTS.remove(toy_logger)
    assert (data.attrs["format"], data.attrs["holds"]) == ("Toy Logger", "waveform")
    assert data.attrs["why"] == "it begins with TOYLOGGER"
    assert data.time.values.tolist() == [0.0, 1e-3, 2e-3]
    assert data.force.values.tolist() == [0.0, 500.0, 250.0]
