"""What is said to wrong inputs: wording, which may be changed on purpose."""

import shlex
from collections.abc import Callable
from typing import Any

import stackbounce as sb
from frozen import commands, lab, web

LINES = commands.LINES.with_name("messages.txt")
_BALLS = [sb.Ball(0.1), sb.Ball(0.05)]
_SPRINGS = [sb.Spring(1e4)] * 2
CALLS: dict[str, Callable[[], Any]] = {
    "a negative mass": lambda: sb.Ball(-1.0),
    "a mass in words": lambda: sb.Ball("heavy"),  # type: ignore[arg-type]
    "no number": lambda: sb.Spring(float("nan")),
    "a gain": lambda: sb.Rigid(1.2),
    "no loss told": lambda: sb.Hysteretic(1e4),
    "too steep": lambda: sb.PowerLaw(1.0, 1e9),
    "too few contacts": lambda: sb.Drop(_BALLS, _SPRINGS[:1], impact_speed=1.0),
    "no speed": lambda: sb.Drop(_BALLS, _SPRINGS),
    "two speeds": lambda: sb.Drop(_BALLS, _SPRINGS, height=1.0, impact_speed=1.0),
    "a mixture": lambda: sb.Drop(_BALLS, [sb.Rigid(1.0), sb.Spring(1.0)], impact_speed=1.0),
    "a wrong key": lambda: sb.Drop.from_mapping({"ball": []}),
    "no path": lambda: sb.sweep(_pair(), {"balls.7.mass": [1.0]}),
    "no values": lambda: sb.sweep(_pair(), {"balls.0.mass": ["heavy"]}),
    "no tolerance": lambda: sb.simulate(_pair(), rtol=1.0),
    "no law": lambda: sb.calibrate(int, mass=1.0),
    "a loss of a spring": lambda: sb.calibrate(
        sb.Spring, mass=1.0, contact_time=1e-3, restitution=0.5
    ),
    "a missing speed": lambda: sb.restitution(sb.HuntCrossley(1.0, 1.5, 0.1)),
    "nothing to fit": lambda: sb.fit(_pair(), {}, ["balls.0.mass"]),
    "one ball apart": lambda: sb.transition(sb.Drop(_BALLS[:1], _SPRINGS[:1], impact_speed=1.0)),
    "unknown balls": lambda: sb.highest(["B7"]),
}


def _pair() -> sb.Drop:
    return sb.Drop(_BALLS, _SPRINGS, impact_speed=1.0)


def answers() -> dict[str, Any]:
    """Return what the command line, the library and the server say."""
    with lab.folder():
        told = {line: lab.run(shlex.split(line)) for line in commands.lines_of(LINES)}
        lines = {line: {"code": one.code, "err": one.err} for line, one in told.items()}
        return {
            "commands": lines,
            "calls": {name: _said(call) for name, call in CALLS.items()},
            "requests": web.refused(),
        }


def _said(call: Callable[[], Any]) -> str:
    """Return what a call raises; what raises nothing is an error of this list."""
    try:
        return f"returns {call()!r}"
    except sb.StackbounceError as error:
        return f"{type(error).__name__}: {error}"
