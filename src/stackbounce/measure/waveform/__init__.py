"""Force waveforms: contact intervals, times, peaks, impulses, delays and gaps."""

from stackbounce.measure.waveform.analysis import waveform
from stackbounce.measure.waveform.droop import drooped, undrooped
from stackbounce.measure.waveform.found import Contact, Waveform
from stackbounce.measure.waveform.gap import delay, delay_from_gap, gap_from_delay

__all__ = [
    "Contact",
    "Waveform",
    "delay",
    "delay_from_gap",
    "drooped",
    "gap_from_delay",
    "undrooped",
    "waveform",
]
