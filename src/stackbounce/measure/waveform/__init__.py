"""Force waveforms: contact intervals, times, peaks, impulses, delays and gaps."""

from stackbounce.measure.waveform.analysis import waveform
from stackbounce.measure.waveform.droop import drooped, undrooped
from stackbounce.measure.waveform.found import Contact, Waveform

__all__ = ["Contact", "Waveform", "drooped", "undrooped", "waveform"]
