"""A sensor that rings: its resonance is seen after a contact, and its effect is taken off.

A sensor of a mass on a spring shows y of a force F, with ``F = y + (2 z/w) y' + y''/w**2``, where w
is its angular frequency and z its damping ratio. After a contact it rings freely, which shows both.
"""

from dataclasses import replace
from math import hypot, log
from typing import NamedTuple

import numpy as np

from stackbounce.measure.kinds.waveform.baseline import first_guess, scatter
from stackbounce.measure.kinds.waveform.hum import regression
from stackbounce.measure.kinds.waveform.record import Record
from stackbounce.measure.quantities import Array, Number, known_to
from stackbounce.measure.samples import runs

# Set by hand on made records of sensors that ring at 0.6 to 1.1 kHz (`benchmarks/coverage`).
_HIGH = 0.25  # of the largest value, above which a record is within a contact
_AFTER = 0.25  # of the length of that, after its end, until the sensor rings freely
_LASTS = 2.0  # such lengths of ringing that are fitted
_NEXT = 0.5  # of the largest value, from which the next contact is seen
_LEAST_PER_PERIOD = 10  # samples
_MOST_SAMPLES = 1000  # that are fitted; of more, some are left out
_LEAST_IN_CONTACT = 1.2  # periods, in the length above; slower ones move the whole contact
_FREQUENCIES, _DAMPINGS = 40, (0.003, 0.01, 0.03, 0.1)  # from which a fit starts
_LEAST_DAMPING, _MOST_DAMPING = 1e-4, 0.25  # beyond which no oscillation fades, or none is seen
_EXPLAINED = 0.5  # of the variance after the contact, at least, by the ringing
_LEAST_GAIN = 50.0  # decrease of chi squared by it, at least
_WINDOW = 0.25  # of a period, over which a polynomial of degree 3 gives the derivatives
_EARLY, _EARLY_SPREAD = 0.02, 0.012  # of a period, by which such a window lengthens each flank
_LEVEL = 1.4  # of the record's density of noise, in levels and areas
OWN_NOISE = 0.6
"""Of the errors of flanks and peaks, as the samples in a window share their noise."""


class Ringing(NamedTuple):
    """The resonance of a sensor: frequency in Hz, damping ratio, density of noise as in `Quiet`."""

    frequency: float
    damping: float
    density: float

    @property
    def level_density(self) -> float:
        """The density of noise of levels and areas of the force."""
        return _LEVEL * self.density

    def end(self, time: Number | None, sign: float) -> Number | None:
        """Return a touch (sign 1) or release (-1) in s without what the window adds."""
        if time is None:
            return None
        early, spread = _EARLY / self.frequency, _EARLY_SPREAD / self.frequency
        return known_to(time.nominal_value + sign * early, hypot(OWN_NOISE * time.std_dev, spread))

    def force(self, record: Record) -> tuple[Record, slice]:
        """Return the force that the record shows, without the ends, and which samples these are."""
        from scipy.signal import savgol_coeffs

        half = max(2, int(0.5 * _WINDOW / (self.frequency * record.step)))
        at = np.arange(-half, half + 1)
        tone = np.exp(2j * np.pi * self.frequency * record.step * at)
        slope, bend = (savgol_coeffs(len(at), 3, deriv=k, use="dot") for k in (1, 2))
        slope, bend = slope / (slope @ tone).imag, -bend / (bend @ tone).real  # exact for the tone
        kernel = (at == 0) + 2.0 * self.damping * slope + bend
        inner = slice(half, len(record.values) - half)
        force = np.convolve(record.values, kernel[::-1], "valid")
        return replace(record, times=record.times[inner], values=force), inner


def ringing_of(record: Record) -> Ringing | None:
    """Return how the sensor rings after the highest contact; None where it is not clear."""
    from scipy.optimize import minimize

    part, longest = _free(record)
    t, y = record.times[part], record.values[part]
    if len(t) < 2 * _LEAST_PER_PERIOD:
        return None
    t = t - t[0]
    low, high = max(1.0 / t[-1], 1.0 / longest), (len(t) - 1) / t[-1] / _LEAST_PER_PERIOD
    if low >= high:
        return None
    line = np.stack([np.ones_like(t), t], axis=1)

    def rest(unknown: Array) -> Array:
        frequency, damping = np.exp(unknown)
        fade = np.exp(2.0 * np.pi * frequency * (1j * np.sqrt(1.0 - damping**2) - damping) * t)
        return regression(np.column_stack([line, fade.real, fade.imag]), y)[1]

    def left(unknown: Array) -> float:
        return float(np.sum(rest(unknown) ** 2))

    tried = np.geomspace(low, high, _FREQUENCIES)
    start = min((np.log([f, z]) for f in tried for z in _DAMPINGS), key=left)
    limits = [(log(low), log(high)), (log(_LEAST_DAMPING), log(_MOST_DAMPING))]
    how = {"xatol": 1e-5, "fatol": 0.0}
    best = minimize(left, start, method="Nelder-Mead", bounds=limits, options=how).x
    frequency, damping = np.exp(best).tolist()
    share = min(1.0 - _EXPLAINED, 1.0 / (1.0 + _LEAST_GAIN / len(t)))
    clear = left(best) < share * float(np.sum(regression(line, y)[1] ** 2))
    if not clear or not 1.01 * low < frequency < 0.99 * high or damping > 0.99 * _MOST_DAMPING:
        return None
    return Ringing(frequency, damping, scatter(rest(best), 6, record.quantum)[1])


def _free(record: Record) -> tuple[slice, float]:
    """Return the samples after the highest contact, and the longest period to look for in s."""
    bare = np.abs(record.values - first_guess(record)[0])
    starts, ends = runs(bare >= _HIGH * bare.max())
    k = int(np.searchsorted(starts, np.argmax(bare), "right")) - 1
    length = int(ends[k] - starts[k]) + 1
    first = int(ends[k] + _AFTER * length)
    after = bare[first : first + int(_LASTS * length)]
    later = np.flatnonzero(after > _NEXT * bare.max())
    stop = first + (int(later[0]) if len(later) else len(after))
    thin = max(1, (stop - first) // _MOST_SAMPLES)
    return slice(first, stop, thin), length * record.step / _LEAST_IN_CONTACT
