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
    client_bytes : int
        That of the requests of one client.
    head_seconds : float
        Time in s in which the whole head of a request must arrive, from the opening of a connection
        or from the first bytes of a further head.
    upload_seconds : float
        Time in s in which a whole request must arrive.
    job_seconds : float
        Time limit of an ordinary job in s.
    fit_seconds : float
        Time limit of an analysis or a fit in s.
    paper_seconds : float
        Time limit in s of the job that computes the paper's pages.
    short_map : int
        Points of a map times the square of its number of balls, up to which it is a short job.
    waiting : int
        Jobs that may run or wait; further requests are refused.
    client_waiting : int
        Those of one client.
    connections : int
        Open connections.
    client_connections : int
        Those of one client.
    workers : int
        Worker processes for short jobs, and as many for long ones.
    worker_bytes : int
        Memory of a worker process, on Linux.

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
    client_bytes: int = 128 * 1024 * 1024
    head_seconds: float = 15.0
    upload_seconds: float = 30.0
    job_seconds: float = 20.0
    fit_seconds: float = 60.0
    paper_seconds: float = 600.0
    short_map: int = 60_000
    waiting: int = 200
    client_waiting: int = 100
    connections: int = 400
    client_connections: int = 200
    workers: int = 2
    worker_bytes: int = 2 * 1024**3


LIMITS = Limits()
"""The limits of ``stackbounce app``."""
