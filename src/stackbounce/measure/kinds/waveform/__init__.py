"""Force waveforms: contact intervals, times, peaks and impulses."""

from stackbounce.measure.kinds.waveform.analysis import waveform
from stackbounce.measure.kinds.waveform.droop import drooped, undrooped
from stackbounce.measure.kinds.waveform.result import Contact, Waveform

__all__ = [
    "Contact",
    "Waveform",
    "drooped",
    "undrooped",
    "waveform",
]
