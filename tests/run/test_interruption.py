"""Ctrl+C ends long work at once, whatever is computed and in however many threads."""

import os
import signal
import sys
import threading
import time

import numpy as np
import pytest

import stackbounce as sb
from stackbounce.__main__ import interrupt_again

SOON = 0.3  # s from the start of the work to the interruption
ANSWERED = 5.0  # s from there to the end, on a busy machine; the work itself takes far longer

HERTZ = sb.Drop([sb.Ball(0.6), sb.Ball(0.06)], [sb.Hertz(2e7), sb.Hertz(1e7)], height=0.63)
SLOW = sb.Drop(  # a run of two seconds
    [sb.Ball(1.0), sb.Ball(1e-12)], [sb.Dashpot(1e4, 20.0)] * 2, impact_speed=1.0
)
RIGID = sb.Drop(
    [sb.Ball(1.0), sb.Ball(1.0)], [sb.Rigid(1.0)] * 2, [1e-3], impact_speed=1.0, gravity=9.81
)
STACK = sb.Drop([sb.Ball(0.1)] * 30, [sb.Hertz(1e7)] * 30, impact_speed=1.0)
MASSES = np.linspace(0.5, 0.7, 100_000)
GAPS = np.linspace(0.0, 1e-3, 30)
WORK = {
    "one run": lambda: [sb.simulate(SLOW) for _ in range(10)],
    "many drops": lambda: sb.sweep(HERTZ, {"balls.0.mass": MASSES, "gaps.0": GAPS}, rtol=1e-12),
    "many slow drops": lambda: sb.sweep(SLOW, {"balls.0.mass": MASSES}),
    "a few slow drops": lambda: sb.sweep(SLOW, {"balls.0.mass": MASSES[:10]}),
    "collisions": lambda: sb.sweep(RIGID, {"balls.0.mass": MASSES}, until=1e9),
    "draws": lambda: sb.predict(SLOW, {"balls.0.mass": (1.0, 0.1)}),
    "an error too large": lambda: sb.predict(HERTZ, {"balls.0.mass": (0.6, 1e9)}),
    "conditioning": lambda: [sb.simulate(STACK).known_until for _ in range(100)],
}


@pytest.fixture(scope="module", autouse=True)
def _imported():
    """What is imported late would be what is interrupted."""
    sb.sweep(HERTZ, {"balls.0.mass": [0.6]})
    sb.predict(HERTZ, {"balls.0.mass": (0.6, 0.01)})


@pytest.mark.parametrize("name", WORK)
def test_an_interruption_is_answered_at_once(name, monkeypatch, request):
    # a job in the background has none
    usual = signal.signal(signal.SIGINT, signal.default_int_handler)
    request.addfinalizer(lambda: signal.signal(signal.SIGINT, usual))
    monkeypatch.setattr(sys, "unraisablehook", interrupt_again)  # as in the program
    before = threading.active_count()
    timer = threading.Timer(SOON, os.kill, (os.getpid(), signal.SIGINT))
    request.addfinalizer(timer.cancel)  # work that ended too soon fails this test, and no other
    started = time.monotonic()
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        WORK[name]()
    assert time.monotonic() - started < SOON + ANSWERED
    timer.join()
    assert threading.active_count() <= before  # no thread works on
