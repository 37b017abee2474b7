"""The compiled kernels: each worker process loads or compiles them as it starts."""

import threading
from typing import Any

import numpy as np

from stackbounce.model import Ball, Drop, Hertz, Rigid, Spring
from stackbounce.run.driver import simulate
from stackbounce.sweeps import sweep

__all__ = ["check_ready", "load_kernels", "run_engines", "start_process"]

_MANY = 100  # smaller sweeps are run as plain Python
_LAWS = (Spring(1.0), Hertz(1.0), Rigid(1.0))  # one law for each engine
_LOADING = 10.0  # s, the longest wait for this process to load what another one has compiled
_COMPILING = 180.0  # s, after which the process that compiles is assumed to have ended
_loaded = threading.Event()
_any_process: list[Any] = []  # the event that is set once some process has the kernels


def run_engines() -> None:
    """Run each engine once, for one drop and for several."""
    for law in _LAWS:
        drop = Drop([Ball(1.0), Ball(0.5)], [law, law], impact_speed=1.0)
        simulate(drop, compiled=True).sample([0.0])
        sweep(drop, {"balls.0.mass": np.linspace(1.0, 2.0, _MANY)})


def check_ready(*, wait: bool = False) -> bool:
    """Return whether this worker process has loaded the compiled kernels.

    Parameters
    ----------
    wait : bool, optional
        Wait for them, if another process has compiled them already.

    Returns
    -------
    bool
    """
    if wait and any(event.is_set() for event in _any_process):
        _loaded.wait(_LOADING)
    return _loaded.is_set()


def start_process(one_at_a_time: Any, ready: Any) -> None:
    """Load the kernels in a thread: until they are there, jobs run as plain Python."""
    _any_process.append(ready)
    threading.Thread(target=load_kernels, args=(one_at_a_time, ready), daemon=True).start()


def load_kernels(one_at_a_time: Any, ready: Any) -> None:
    """Load the kernels, one process at a time, and set the event `ready`."""
    # The first process compiles, the others load from the cache; if it ends early, the next does.
    first = one_at_a_time.acquire(timeout=_COMPILING)
    try:
        run_engines()
    finally:
        if first:
            one_at_a_time.release()
    _loaded.set()
    ready.set()
