"""Force waveforms: contact intervals, times, peaks and impulses."""
