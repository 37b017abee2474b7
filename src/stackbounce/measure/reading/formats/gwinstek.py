"""Oscilloscopes of GW Instek."""

from stackbounce.errors import FileError
from stackbounce.measure.reading.headings import Heading
from stackbounce.measure.reading.layouts import Layout, first_row, layout
from stackbounce.measure.reading.roles import column
from stackbounce.measure.reading.text import Text


@layout
def gwinstek(text: Text) -> Layout | None:
    """Recognise GW Instek: keys and values, ``Waveform Data``, then pairs of time and voltage."""
    lines = {row[0]: k for k, row in enumerate(text.head) if row}
    if not {"Memory Length", "Sampling Period", "Waveform Data"} <= set(lines):
        return None
    keys = {name: text.head[k][1:] for name, k in lines.items()}
    if keys.get("Mode", [""])[0].casefold() == "fast":
        raise FileError(
            "it is a file of a GW Instek in the mode Fast, with counts instead of volts: save it "
            "in the mode Detail"
        )
    unit = _second(keys, "Horizontal Units") or "s"
    columns = [column(0, Heading("time", "time", unit), "time")]
    count = (
        sum(cell == "Source" for cell in [*text.head[lines["Source"]]]) if "Source" in keys else 1
    )
    for k in range(max(count, 1)):
        source = _at(keys.get("Source", []), 2 * k) or f"CH{k + 1}"
        volt = _at(keys.get("Vertical Units", []), 2 * k) or "V"
        columns.append(column(2 * k + 1, Heading(source, source, volt), "voltage"))
    why = "'Memory Length' … 'Waveform Data' over pairs of numbers are how a GW Instek writes"
    return Layout(
        "GW Instek oscilloscope", why, tuple(columns), first_row(text, lines["Waveform Data"] + 1)
    )


def _second(keys: dict[str, list[str]], name: str) -> str:
    return _at(keys.get(name, []), 0)


def _at(cells: list[str], index: int) -> str:
    return cells[index] if index < len(cells) else ""
