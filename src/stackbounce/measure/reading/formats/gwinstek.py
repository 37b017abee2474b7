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
    if (keys.get("Mode") or [""])[0].casefold() == "fast":
        raise FileError(
            "it is a file of a GW Instek in the mode Fast, with counts instead of volts: save it "
            "in the mode Detail"
        )
    unit = _cell(keys, "Horizontal Units", 0) or "s"
    columns = [column(0, Heading("time", "time", unit), "time")]
    for k in range(1 + keys.get("Source", []).count("Source")):  # channels beside each other
        source = _cell(keys, "Source", 2 * k) or f"CH{k + 1}"
        volt = _cell(keys, "Vertical Units", 2 * k) or "V"
        columns.append(column(2 * k + 1, Heading(source, source, volt), "voltage"))
    why = "'Memory Length' … 'Waveform Data' over pairs of numbers are how a GW Instek writes"
    first = first_row(text, lines["Waveform Data"] + 1)
    return Layout("GW Instek oscilloscope", why, tuple(columns), first)


def _cell(keys: dict[str, list[str]], name: str, index: int) -> str:
    cells = keys.get(name, [])
    return cells[index] if index < len(cells) else ""
