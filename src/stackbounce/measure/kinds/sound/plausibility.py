"""Whether sounds are the bounces of one ball, or why they cannot be."""

import numpy as np

from stackbounce.measure.kinds.sound.loudness import Rises
from stackbounce.measure.kinds.sound.sequence import Chain, find_chain
from stackbounce.measure.quantities import Array, Mask

# Set by hand on some 250 public recordings of other things, on the made ones of
# `tests/measure/test_no_ball.py`, and on recordings of bounces.
_FAINT = 0.1  # of the loudest amplitude: what is fainter is an echo
_SLIGHT = 1.5  # times the least amplitude of a rise, which an echo does not reach
_CLEARER = 4.0  # times clearer than its echoes is the sound
_SHRINK = 0.01  # by which intervals shrink at least on average: no ball keeps 99 % of its speed
_SHRINK_SIGMAS = 3.0  # standard deviations of its steps, by which a series shrinks at least in all
_FEW = 4  # bounces that other sounds can easily imitate
_FIRST_FLIGHT, _FIRST_OF_FEW = 0.06, 0.15  # s at least: of a drop from about 1 cm, and of few, 5 cm
_LOUDER, _LOUDER_OF_FEW = 3.0, 1.6  # times as loud as the one before is a bounce at most
_SHORT = 7  # bounces among which none is louder than that
_LEAST_RISE = 0.85  # of the last restitution of so few over the first: slow bounces retain more
_SIGMAS = 6.0  # standard deviations by which a series exceeds those of sounds in random order
_ORDERS = 19  # random orders
_LEAST_DEVIATION = 0.3  # of the scores of random orders
_TAIL_SECONDS, _TAIL = 0.25, 10.0  # after a sound so many times clearer, a rise belongs to it


def reason_against(chain: Chain, rises: Rises, echoes: Mask, origin: float, longest: float) -> str:
    """Return why a series of sounds is no bouncing ball; nothing if it may be one.

    A series that leaves nothing out is judged by itself. Out of many other sounds a shrinking
    series can always be picked: it must be far better than the best ones out of the same sounds in
    random order.

    Parameters
    ----------
    chain : Chain
        Which sounds are the series.
    rises : Rises
        All sounds.
    echoes : ndarray
        (N,) which of them are echoes of the series.
    origin : float
        The time in s that is 0 in `rises`.
    longest : float
        The longest flight in s of a ball.

    Returns
    -------
    str
        The end of a sentence that begins with "This is no bouncing ball: ".

    Examples
    --------
    >>> times = np.arange(4.0)
    >>> clicks = Rises(times, np.full(4, 1e-4), np.ones(4), np.full(4, 9.0))
    >>> reason_against(Chain((0, 1, 2, 3), (0, 0, 0)), clicks, np.zeros(4, bool), 0.0, 2.0)
    '4 sounds at equal intervals of 1 s, or nearly so, as of a metronome, of steps or claps'
    """
    at = list(chain.indices)
    if len(at) < 2:
        return ""
    heard = ~(echoes | tails(rises))
    heard[at] = True
    others = rises.amplitudes[np.setdiff1d(np.flatnonzero(heard), at)]
    rises_heard = Rises(*(column[heard] for column in rises))
    return (
        _one_sound(rises.times[at] + origin, rises.amplitudes[at], rises.ratios[at])
        or _against_flights(chain, rises, longest)
        or _against_loudness(rises.amplitudes[at])
        or _against_chance(chain, rises_heard, others)
    )


def _against_flights(chain: Chain, rises: Rises, longest: float) -> str:
    at = list(chain.indices)
    flights = np.diff(rises.times[at])
    single = flights / (1.0 + np.array(chain.missed))
    if flights[0] > longest:
        return f"the first interval, {flights[0]:.3g} s, is longer than a flight of {longest:.3g} s"
    if len(at) < 3:
        return ""
    logs, steps = np.diff(np.log(single)), len(flights) - 1 + sum(chain.missed)
    # flights become shorter, and by more than they vary
    if not -logs.sum() > max(_SHRINK * steps, _SHRINK_SIGMAS * float(np.std(logs))):
        return (
            f"{len(at)} sounds at equal intervals of {np.median(single):.3g} s, or nearly so, as "
            "of a metronome, of steps or claps"
        )
    if flights[0] < (_FIRST_OF_FEW if len(at) <= _FEW else _FIRST_FLIGHT):
        return f"the first interval of {len(at)} sounds, {1e3 * flights[0]:.3g} ms, is too short"
    kept = single[1:] / single[:-1]
    if (kept > 1.0 + 4.0 * rises.errors[at].max() / flights[1:]).any():
        return f"a restitution would be {kept.max():.3g}, above 1"
    if (before := single[0] / kept[0]) > longest:
        return f"the fall before the first sound would be that of a flight of {before:.3g} s"
    if len(at) <= _SHORT and kept[-1] < _LEAST_RISE * kept[0]:
        return (
            f"restitutions would fall from {kept[0]:.3g} to {kept[-1]:.3g} as the ball slows down"
        )
    return ""


def _against_loudness(amplitudes: Array) -> str:
    most = _LOUDER_OF_FEW if len(amplitudes) <= _FEW else _LOUDER
    louder = float((amplitudes[1:] / amplitudes[:-1]).max())
    if not 2 < len(amplitudes) <= _SHORT or louder <= most:
        return ""
    return f"a later sound is {louder:.2g} times as loud as the one before, not fainter"


def _against_chance(chain: Chain, heard: Rises, others: Array) -> str:
    count = len(chain.indices)
    unsure = count <= _SHORT and any(chain.missed)
    faint = (others < _FAINT * heard.amplitudes.max()).all()
    if not unsure and (faint or len(others) <= (0 if count <= _FEW else 1)):
        return ""
    if _sigmas_above_chance(chain, heard) > _SIGMAS:
        return ""
    return f"{len(heard.times)} sounds, which in random order give as good a series of bounces"


def tails(rises: Rises) -> Mask:
    """Return whether each rise lies within the tail of a clearer sound, (N,)."""
    times, _, _, ratios = rises
    since = times[:, None] - times
    follows = (since > 0.0) & (since < _TAIL_SECONDS) & (ratios > _TAIL * ratios[:, None])
    return np.asarray(follows.any(axis=1))


def _one_sound(times: Array, amplitudes: Array, ratios: Array) -> str:
    loudest = int(np.argmax(amplitudes))
    clearest = int(np.argmax(ratios))
    faint = bool((np.delete(amplitudes, loudest) < _FAINT * amplitudes[loudest]).all())
    others = np.delete(ratios, clearest)
    slight = bool((others < _SLIGHT).all() and ratios[clearest] > _CLEARER * others.max())
    if not (faint or slight):
        return ""
    what = "is fainter than a tenth of it" if faint else "hardly rises above what precedes it"
    first = times[loudest if faint else clearest]
    return f"one sound with echoes, at {first:.4g} s; the rest {what}"


def _sigmas_above_chance(chain: Chain, rises: Rises) -> float:
    """Return by how much a series is better than those of the same sounds in random order.

    Intervals and loudness are shuffled apart from each other. It ends early where the answer is
    clear.
    """
    random = np.random.default_rng(0)
    scores: list[float] = []
    sigmas = 0.0
    for _ in range(_ORDERS):
        steps = random.permutation(np.diff(rises.times))
        order = random.permutation(len(rises.times))
        times = rises.times[0] + np.concatenate([[0.0], np.cumsum(steps)])
        mixed = Rises(times, *(column[order] for column in rises[1:]))
        scores.append(find_chain(mixed).score)
        sigmas = (chain.score - np.mean(scores)) / np.fmax(np.std(scores), _LEAST_DEVIATION)
        if len(scores) > 4 and not _SIGMAS / 3.0 < sigmas < 2.0 * _SIGMAS:
            break
    return float(sigmas)
