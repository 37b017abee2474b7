"""Whether sounds can be the bounces of a ball: what sounds otherwise is refused."""

import numpy as np

from stackbounce.errors import InvalidValue
from stackbounce.measure.kinds.sound.loudness import Rises
from stackbounce.measure.kinds.sound.sequence import Chain
from stackbounce.measure.quantities import Array

# Set by hand on one sound with echoes and on metronomes (`tests/measure/test_sound_alignment.py`).
_FAINT = 0.1  # of the loudest amplitude: what is fainter is an echo
_SLIGHT = 1.5  # times the least amplitude of a rise, which an echo does not reach
_CLEARER = 4.0  # times clearer than its echoes is the sound
_SHRINK = 0.01  # by which intervals shrink at least on average: no ball keeps 99 % of its speed
_UNEVEN = 0.05  # by which neighbouring intervals of a metronome may differ


def refuse_other_series(chain: Chain, rises: Rises, origin: float) -> None:
    """Raise an error if a series of sounds is one sound with echoes, or a metronome.

    Parameters
    ----------
    chain : Chain
        Which sounds are the series.
    rises : Rises
        All sounds.
    origin : float
        The time in s that is 0 in `rises`.

    Raises
    ------
    InvalidValue
        If the series is no bouncing ball.

    Examples
    --------
    >>> times = np.arange(4.0)
    >>> clicks = Rises(times, np.full(4, 1e-4), np.ones(4), np.full(4, 9.0))
    >>> try:
    ...     refuse_other_series(Chain((0, 1, 2, 3), (0, 0, 0)), clicks, 0.0)
    ... except InvalidValue as error:
    ...     print(error)
    sound must hold bounces, whose intervals shrink, got 4 sounds at equal intervals of 1 s: a \
metronome or a clock?
    """
    at = list(chain.indices)
    if len(at) < 2:
        return
    _refuse_echoes(rises.times[at] + origin, rises.amplitudes[at], rises.ratios[at])
    if len(at) > 2 and not any(chain.missed):
        _refuse_equal(np.diff(rises.times[at]))


def _refuse_echoes(times: Array, amplitudes: Array, ratios: Array) -> None:
    loudest = int(np.argmax(amplitudes))
    clearest = int(np.argmax(ratios))
    faint = bool((np.delete(amplitudes, loudest) < _FAINT * amplitudes[loudest]).all())
    others = np.delete(ratios, clearest)
    slight = bool((others < _SLIGHT).all() and ratios[clearest] > _CLEARER * others.max())
    if faint or slight:
        one = loudest if faint else clearest
        what = "is fainter than a tenth of it" if faint else "hardly rises above what precedes it"
        raise InvalidValue(
            f"sound must hold bounces, got one sound with echoes, at {times[one]:.4g} s: "
            f"all that follows {what}"
        )


def _refuse_equal(intervals: Array) -> None:
    steps = np.diff(np.log(intervals))
    if steps.mean() > -_SHRINK and np.abs(steps).max() < _UNEVEN:
        raise InvalidValue(
            f"sound must hold bounces, whose intervals shrink, got {len(intervals) + 1} sounds at "
            f"equal intervals of {intervals.mean():.3g} s: a metronome or a clock?"
        )
