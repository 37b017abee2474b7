"""Compile, or load from numba's cache, all kernels that answers need, as a process begins."""

import threading
from typing import Any

import numpy as np

from stackbounce.model import Ball, Drop, Hertz, Rigid, Spring
from stackbounce.run.driver import simulate
from stackbounce.sweeps import sweep

__all__ = ["begin", "prepare", "prepared", "warm"]

_MANY = 100  # fewer drops are run as plain Python
_LAWS = (Spring(1.0), Hertz(1.0), Rigid(1.0))  # one for each engine
_LOADING = 10.0  # s, that a process may take to load what another one has compiled
_COMPILING = 180.0  # s, after which the process that compiles is taken for ended
_prepared = threading.Event()
_elsewhere: list[Any] = []  # the event that tells that some process has compiled the kernels


def warm() -> None:
    """Run each engine once, for one drop and for several."""
    for law in _LAWS:
        drop = Drop([Ball(1.0), Ball(0.5)], [law, law], impact_speed=1.0)
        simulate(drop, compiled=True).sample([0.0])
        sweep(drop, {"balls.0.mass": np.linspace(1.0, 2.0, _MANY)})


def prepared(*, wait: bool = False) -> bool:
    """Tell, in a process that computes, whether the compiled kernels are at hand.

    Parameters
    ----------
    wait : bool, optional
        For them to be loaded, if another process has compiled them already.

    Returns
    -------
    bool
    """
    if wait and any(event.is_set() for event in _elsewhere):
        _prepared.wait(_LOADING)
    return _prepared.is_set()


def begin(one_at_a_time: Any, ready: Any) -> None:
    """Begin a process: load the kernels while the first jobs run as plain Python."""
    _elsewhere.append(ready)
    threading.Thread(target=prepare, args=(one_at_a_time, ready), daemon=True).start()


def prepare(one_at_a_time: Any, ready: Any) -> None:
    """Load the kernels; tell by an event that they are there."""
    # The first process compiles, others find it in numba's cache; if it was ended, the next does.
    first = one_at_a_time.acquire(timeout=_COMPILING)
    try:
        warm()
    finally:
        if first:
            one_at_a_time.release()
    _prepared.set()
    ready.set()
