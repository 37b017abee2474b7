"""How much one request may ask for, so that a class of fifty shares two cores."""

import dataclasses

__all__ = ["LIMITS", "Limits"]


@dataclasses.dataclass(frozen=True)
class Limits:
    """The bounds of one request, and of all together.

    Parameters
    ----------
    balls : int
        Of a drop.
    frames : int
        Times at which a drop is sampled.
    events : int
        Of a run, after which it is stopped with a status that says so.
    duration : float
        In s, of a run with gravity.
    map_points : int
        Of a map, both sides multiplied.
    varied : int
        Numbers that a fit varies.
    body_bytes : int
        Of a request without a file.
    upload_bytes : int
        Of a request with a file.
    held_bytes : int
        Of all requests that are being received or answered, together.
    upload_seconds : float
        In s, for a request to come in whole.
    job_seconds : float
        In s, for the computation of an answer.
    fit_seconds : float
        In s, for a fit.
    paper_seconds : float
        In s, for the paper's pages, which are computed once.
    waiting : int
        Jobs that may be under way or wait, before further ones are sent away.
    connections : int
        That may be open at once.
    workers : int
        Processes that compute.

    Examples
    --------
    >>> LIMITS.balls
    6
    """

    balls: int = 6
    frames: int = 3000
    events: int = 20_000
    duration: float = 60.0
    map_points: int = 40_000
    varied: int = 6
    body_bytes: int = 64 * 1024
    upload_bytes: int = 16 * 1024 * 1024
    held_bytes: int = 256 * 1024 * 1024
    upload_seconds: float = 30.0
    job_seconds: float = 20.0
    fit_seconds: float = 60.0
    paper_seconds: float = 600.0
    waiting: int = 200
    connections: int = 400
    workers: int = 2


LIMITS = Limits()
"""Those of ``stackbounce app``."""
