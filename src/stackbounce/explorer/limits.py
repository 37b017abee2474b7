"""Limits of a request, chosen so that a class of fifty can share two cores."""

import dataclasses


@dataclasses.dataclass(frozen=True)
class Limits:
    """Limits of one request, and of all requests together.

    Parameters
    ----------
    balls : int
        Balls of a drop.
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
    job_seconds : float
        Time limit of a job in s.
    paper_seconds : float
        Time limit in s of the job that computes the paper's pages.
    client_jobs : int
        Jobs of one client that may run or wait; further requests are refused.
    connections : int
        Open connections of all clients; further requests are refused.
    workers : int
        Worker processes.
    worker_bytes : int
        Memory of a worker process, on Linux.

    Examples
    --------
    >>> LIMITS.balls
    6
    """

    balls: int = 6
    events: int = 20_000
    duration: float = 60.0
    map_points: int = 40_000
    varied: int = 6
    body_bytes: int = 64 * 1024
    upload_bytes: int = 16 * 1024 * 1024
    job_seconds: float = 60.0
    paper_seconds: float = 600.0
    client_jobs: int = 100
    connections: int = 400
    workers: int = 2
    worker_bytes: int = 2 * 1024**3


RTOL = 1e-10
"""The tolerance of nonlinear contacts, which a picture does not show."""

LIMITS = Limits()
"""The limits of ``stackbounce app``."""
