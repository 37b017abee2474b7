"""A recording of a bouncing ball -> the times of its knocks."""

from typing import Any, NamedTuple

import numpy as np

from stackbounce.errors import InvalidValue, counted, positive
from stackbounce.measure.kinds.bounces.knocks import Dropped, Knocks
from stackbounce.measure.kinds.sound.alignment import aligned
from stackbounce.measure.kinds.sound.consistency import misjudgement
from stackbounce.measure.kinds.sound.loudness import Rises, find_rises
from stackbounce.measure.kinds.sound.onset import onsets
from stackbounce.measure.kinds.sound.plausibility import reason_against, tails
from stackbounce.measure.kinds.sound.sequence import Chain, find_chain
from stackbounce.measure.messages import PART, Message, OptionHint
from stackbounce.measure.quantities import Array, Pair, Samples
from stackbounce.measure.samples import columns, resolution, runs
from stackbounce.measure.statistics.ar_noise import whitened
from stackbounce.units import checked

_LEAST_RATE = 400  # samples per second: with fewer an onset lies between two samples
_DEAD_SECONDS = 8e-3  # s: two knocks closer than that are one impact
_LONGEST_FLIGHT = 2.02  # s: of a bounce of 5 m
_PRE_ECHO = 0.04  # of a knock's largest power: a codec's echo before it is fainter
_PRE_ECHO_SECONDS = 0.3e-3  # s by which it shifts a time at least
_FEW_KNOCKS = 5  # fewer do not tell how much their flights scatter: the shift is an error
_PRE_ECHO_FACTOR = 1.5  # by which errors of times without it are larger at most
_SAME_DELAY = 1.5e-3  # s by which the delays of one echo differ at most
_SECOND_SERIES = 4  # knocks of another series that is worth a note
_LOUDNESS_SECONDS = 10e-3  # s of a knock that tell how loud it is
_INTERVAL_SIGMA = 0.1  # of the interval between amplitudes: the error of a time within it
_AROUND = 0.1  # s before and after a series that is proposed as a part
_CLIPPED = 4  # samples in a row at the largest value
_ADVICE = ". Record one ball without other sounds, or choose its bounces by "


def knocks(
    data: Any, *, longest_flight: float = _LONGEST_FLIGHT, rate: float | None = None
) -> Knocks:
    """Return the times of a bouncing ball's knocks in a recording.

    A knock is a sudden large rise of the linear-prediction residual, which contains no hum and no
    stationary noise. The rises that one bouncing ball can have made are kept: each flight is
    shorter than the one before by a factor that changes slowly. Echoes, second sounds of one
    impact, speech and other noises are left out and listed.

    Parameters
    ----------
    data : Dataset or array_like
        A Dataset with `sound` (as `stackbounce.read` gives it, of which `start` and `stop` choose a
        part), or samples, (N,).
    longest_flight : float, optional
        Of a ball, in s; by default 2.02 s, in which it rises 5 m.
    rate : float, optional
        Samples per second, of plain samples.

    Returns
    -------
    Knocks

    Raises
    ------
    InvalidValue
        If there is no sound, no knock, or a number is out of its range.
    InvalidType
        If `data` is no recording.

    Notes
    -----
    The time of a single knock is where its wave rises out of the noise: see `onset.onsets`. Two
    and more are aligned with each other, `alignment.aligned`, and their errors are those of the
    alignment, as far as the flights do not show that they are larger or smaller:
    `consistency.misjudgement`. What all times have in common, which no flight contains, is not in
    the errors. Where no series is that of a bouncing ball, all sounds are returned, with the reason
    in `against`.

    Examples
    --------
    >>> import numpy as np
    >>> rate, times = 44_100, np.cumsum([0.2, 0.5, 0.4, 0.32, 0.256])  # s
    >>> sound = np.random.default_rng(1).normal(0.0, 1e-3, 2 * rate)
    >>> since = np.arange(2000) / rate
    >>> for loud, first in zip(0.8 ** np.arange(5), (times * rate).astype(int)):
    ...     sound[first : first + 2000] += loud * np.exp(-since / 5e-3) * np.sin(6000.0 * since)
    >>> found = knocks(sound, rate=rate)
    >>> len(found.times), len(found.dropped)
    (5, 0)
    """
    from uncertainties import ufloat

    longest_flight = checked(positive, "longest_flight", longest_flight, "seconds")
    heard, origin = _recording(data, rate)
    notes = _notes_on(heard.samples)
    rises = find_rises(heard.white, heard.rate, heard.rounded)
    if not len(rises.times):
        raise InvalidValue(
            "sound must hold a knock that rises above what precedes it, got none: "
            "record closer to the ball"
        )
    rises, doubles = _merged(rises)
    chain = find_chain(rises)
    delay = _echo_delay(chain, rises)
    chain, dropped = _without_echoes(chain, rises, delay)
    echoes = np.isin(rises.times, [sound.time for sound in dropped if sound.why == "echo"])
    against = reason_against(chain, rises, echoes, origin, longest_flight)
    if against:
        chain, dropped = _all_sounds(rises)
        notes.append(Message(f"This is no bouncing ball: {against}{_ADVICE}", PART, "."))
    else:
        if delay:
            notes.append(f"Each knock has an echo {1e3 * delay:.1f} ms later, which is left out.")
        _note_series(chain, rises, origin, notes)
    about = rises.times[list(chain.indices)]
    if len(about) < 2 or against:
        times, errors = heard.onsets(about)
    else:
        times, errors = _consistent(heard, about, chain.missed, notes)
    loudness = _loudness(heard, times)
    left_out = sorted([*doubles, *dropped], key=lambda sound: sound.time)
    return Knocks(
        tuple(map(ufloat, origin + times, errors)),
        loudness / loudness.max(),
        chain.missed,
        tuple(Dropped(origin + sound.time, sound.why) for sound in left_out),
        heard.rate,
        tuple(notes),
        against,
    )


def _all_sounds(rises: Rises) -> tuple[Chain, list[Dropped]]:
    """Return all sounds where no series of bounces is among them, and what is left out."""
    of_another = tails(rises)
    kept = tuple(map(int, np.flatnonzero(~of_another)))
    left_out = [Dropped(float(time), "tail of a sound") for time in rises.times[of_another]]
    return Chain(kept, (0,) * (len(kept) - 1)), left_out


class _Recording(NamedTuple):
    """Samples, (N,), whitened ones, the rate, and the variance of the samples' rounding."""

    samples: Samples
    white: Samples
    rate: float
    rounded: float

    def onsets(self, about: Array, faint: float = 0.0) -> Pair:
        """Return the onset of each knock; of a record of amplitudes where it is known about."""
        if self.samples.min() >= 0.0:
            return about, np.full(len(about), 1.0 / self.rate)
        return onsets(self.white, self.rate, about, self.rounded, faint)

    def aligned(self, about: Array, faint: float = 0.0) -> Pair:
        """Return times that are consistent with each other, as late on average as the onsets."""
        first, _ = self.onsets(about, faint)
        times, errors = aligned(self.samples, self.rate, first, self.rounded, faint)
        return times + np.median(first - times), errors


def _consistent(heard: _Recording, about: Array, missed: tuple[int, ...], notes: list[str]) -> Pair:
    """Return the times of a series of bounces and their errors.

    A codec (MP3, AAC, Opus) puts a faint echo before a knock. Times that do not look at what is so
    faint are returned where they differ from those that do, and the flights scatter hardly more.
    """
    times, errors = heard.aligned(about)
    errors = errors * misjudgement(times, errors, missed)
    later, sure = heard.aligned(about, _PRE_ECHO)
    off = np.abs(later - times - np.median(later - times))
    if (off > _PRE_ECHO_SECONDS).any():
        few = len(times) < _FEW_KNOCKS
        sure = np.hypot(sure, off) if few else sure * misjudgement(later, sure, missed)
        if few or np.median(sure) < _PRE_ECHO_FACTOR * np.median(errors):
            notes.append("A faint sound precedes some knocks, as of a codec: it is not looked at.")
            times, errors = later, sure
    if heard.samples.min() >= 0.0:  # each amplitude is of a whole interval
        errors = np.hypot(errors, _INTERVAL_SIGMA / heard.rate)
    return times, errors


def _recording(data: Any, rate: float | None) -> tuple[_Recording, float]:
    """Return a recording, and the time in s of its first sample."""
    (values,) = columns(data if hasattr(data, "data_vars") else [data], ("sound",))
    origin = 0.0
    if hasattr(data, "data_vars"):
        times = data["sound"].coords.get("time")
        rate = rate or data["sound"].attrs.get("rate") or data.attrs.get("rate")
        if times is not None and len(times) > 1:
            origin = float(times.values[0])
            rate = rate or (len(times) - 1) / (float(times.values[-1]) - origin)
    if rate is None:
        raise InvalidValue("rate must be given for plain samples, got None")
    rate = checked(positive, "rate", rate, "Hz")
    if rate < _LEAST_RATE:
        raise InvalidValue(
            f"sound must have {_LEAST_RATE} samples per second or more, got {rate:.3g}: "
            "are its times in another unit?"
        )
    samples = np.nan_to_num(values.astype(np.float32), nan=0.0, posinf=0.0, neginf=0.0)
    if not samples.any():
        raise InvalidValue("sound must hold more than silence, got only zeros")
    rounded = resolution(samples) ** 2 / 12.0  # of a step s it is s²/12
    white = samples if samples.min() >= 0.0 else whitened(samples, rounded)
    return _Recording(samples, white, rate, rounded), origin


def _notes_on(samples: Samples) -> list[str]:
    """Return a note on a recording that is clipped."""
    first, last = runs(np.abs(samples) >= 0.999 * np.abs(samples).max())
    if (last - first + 1 >= _CLIPPED).any():
        return ["The recording is clipped: loudness is wrong there, times are hardly touched."]
    return []


def _merged(rises: Rises) -> tuple[Rises, list[Dropped]]:
    """Return rises without those that follow a knock within the dead time.

    A faint one just before a far louder one is left out rather than the louder one.
    """
    kept: list[int] = []
    dropped = []
    for k in range(len(rises.times)):
        last = kept[-1] if kept else None
        if last is None or rises.times[k] - rises.times[last] >= _DEAD_SECONDS:
            kept.append(k)
            continue
        fainter = k
        if rises.amplitudes[k] > 5.0 * rises.amplitudes[last]:
            kept[-1], fainter = k, last
        dropped.append(Dropped(float(rises.times[fainter]), "second sound of one impact"))
    return Rises(*(column[kept] for column in rises)), dropped


def _without_echoes(chain: Chain, rises: Rises, delay: float) -> tuple[Chain, list[Dropped]]:
    """Return the series without echoes at its end, and why all other rises are left out."""
    indices, missed = list(chain.indices), list(chain.missed)
    while delay and len(indices) > 3:
        lag = rises.times[indices[-1]] - rises.times[indices[-2]]
        quieter = rises.amplitudes[indices[-1]] < rises.amplitudes[indices[-2]]
        if not (abs(lag - delay) < _SAME_DELAY and quieter):
            break
        indices.pop()
        missed.pop()
    dropped = []
    for k in np.setdiff1d(np.arange(len(rises.times)), indices):
        before = max((i for i in indices if i < k), default=None)
        why = "no bounce"
        if before is not None and rises.amplitudes[k] < rises.amplitudes[before]:
            lag = rises.times[k] - rises.times[before]
            why = "echo" if delay and abs(lag - delay) < _SAME_DELAY else why
        dropped.append(Dropped(float(rises.times[k]), why))
    return Chain(tuple(indices), tuple(missed), chain.score), dropped


def _echo_delay(chain: Chain, rises: Rises) -> float:
    """Return the delay in s that at least three sounds after knocks have in common, or 0."""
    others = np.setdiff1d(np.arange(chain.indices[0], len(rises.times)), chain.indices)
    before = np.array(chain.indices)[np.searchsorted(chain.indices, others) - 1]
    lags = rises.times[others] - rises.times[before]
    if len(lags) < 3:
        return 0.0
    near = np.abs(np.subtract.outer(lags, lags)) < _SAME_DELAY
    best = int(np.argmax(near.sum(axis=1)))
    return float(np.median(lags[near[best]])) if near[best].sum() > 2 else 0.0


def _note_series(chain: Chain, rises: Rises, origin: float, notes: list[str]) -> None:
    """Add notes on missing bounces, on too few knocks, and on further series of knocks."""
    times = origin + rises.times[list(chain.indices)]
    notes.extend(
        f"A bounce seems to be missing between {times[k]:.4g} s and {times[k + 1]:.4g} s."
        for k in np.flatnonzero(chain.missed)
    )
    if len(times) < 4:
        notes.append(
            f"Only {counted(len(times), 'knock')}: too few to tell bounces from other sounds."
        )
    sides = {"before": slice(0, chain.indices[0]), "after": slice(chain.indices[-1] + 1, None)}
    for side, left in sides.items():
        rest = Rises(*(column[left] for column in rises))
        if len(rest.times) < _SECOND_SERIES:
            continue
        other = find_chain(rest)
        faint = rest.amplitudes[list(other.indices)].max() < 0.2 * rises.amplitudes.max()
        if len(other.indices) >= _SECOND_SERIES and not faint:
            first, last = (origin + rest.times[other.indices[k]] for k in (0, -1))
            found = (
                f"There is another series of {len(other.indices)} knocks {side} this one, from "
                f"{first:.4g} s to {last:.4g} s: choose it by "
            )
            part = {"start": f"{first - _AROUND:.4g}s", "stop": f"{last + _AROUND:.4g}s"}
            notes.append(Message(found, OptionHint(part), "."))


def _loudness(heard: _Recording, times: Array) -> Array:
    """Return the root mean square of each knock."""
    count = max(1, round(_LOUDNESS_SECONDS * heard.rate))
    first = np.round(times * heard.rate).astype(np.int64)
    parts = [heard.white[at : at + count].astype(np.float64) for at in np.maximum(first, 0)]
    return np.array([np.sqrt((part**2).mean()) for part in parts])
