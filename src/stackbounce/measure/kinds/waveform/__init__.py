"""Force waveforms: contact intervals, times, peaks and impulses."""

from stackbounce.measure.kind import Kind

WAVEFORM = Kind(
    "waveform",
    "contacts, contact times, peaks, impulse, stiffness, gaps",
    f"{__name__}.kind",
    options=(
        *("mass", "contact_time", "law", "exponent", "height", "measured_to"),
        *("diameter", "speed", "time_constant", "gravity"),
    ),
    columns=(("time",), ("force", "voltage")),
)
