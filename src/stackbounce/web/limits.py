"""Limits of a request, chosen so that a class of fifty can share two cores."""

import dataclasses

__all__ = ["LIMITS", "Limits"]


@dataclasses.dataclass(frozen=True)
class Limits:
    """Limits of one request, and of all requests together.

    Parameters
    ----------
    balls : int
        Balls of a drop.
    frames : int
        Sample times of a drop.
    events : int
        Events of a run; then it stops with the status EVENT_LIMIT.
    duration : float
        Duration of a run in s.
    map_points : int
        Points of a map.
    varied : int
        Numbers that a fit varies.
    body_bytes : int
        Size of a request without a file.
    upload_bytes : int
        Size of a request with a file.
    held_bytes : int
        Total size of all requests that are being received or answered.
    upload_seconds : float
        Time in s in which a whole request must arrive.
    job_seconds : float
        Time limit of an ordinary job in s.
    fit_seconds : float
        Time limit of an analysis or a fit in s.
    paper_seconds : float
        Time limit in s of the job that computes the paper's pages.
    waiting : int
        Jobs that may run or wait; further requests are refused.
    connections : int
        Open connections.
    workers : int
        Worker processes.

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
"""The limits of ``stackbounce app``."""
