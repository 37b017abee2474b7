"""What the explorer's server answers, asked by HTTP alone: it runs as the command starts it."""

import contextlib
import csv
import io
import json
import subprocess
import sys
import time
from collections.abc import Iterator
from typing import Any

import httpx

import stackbounce as sb
from frozen import commands, lab
from frozen.laws import LAWS

_FRAMES = 24
_TRIES = 3  # of a request, where the server is busy
_SECONDS = 300.0
_MEASURED = {  # files, and what is told of each
    "tennis.wav": {"height": "1 m"},
    "basketball.wav": {"height": "1 m", "mass": "150 g"},
    "tennis-force.csv": {"mass": "57 g", "law": "hysteretic", "restitution": 0.75},
    "basketball-press.csv": {},
    "stack-video.txt": {"gravity": "9.80665 m/s^2"},
    "floor-force.csv": {"mass": "150 g"},
    "two-tracks.csv": {},
}
PAIR = {
    "balls": [{"mass": "150 g", "name": "basketball"}, {"mass": "57 g"}],
    "contacts": [{"law": "Spring", "stiffness": 2500.0}, {"law": "Spring", "stiffness": 1000.0}],
    "impact_speed": 3.53,
}
_X = {"path": "mass_ratio", "low": 0.1, "high": 10, "count": 6, "log": True}
_Y = {"path": "stiffness_ratio", "low": 0.5, "high": 8, "count": 5, "log": True}


@contextlib.contextmanager
def served() -> Iterator[httpx.Client]:
    """Run the explorer at a free port, and yield a client of it."""
    command = [sys.executable, "-m", "stackbounce", "app", "--no-browser", "--port", "0"]
    with subprocess.Popen(
        [*command, "--workers", "1", "--json"], stdout=subprocess.PIPE, text=True
    ) as process:
        try:
            assert process.stdout is not None
            told = ""
            while not told.rstrip().endswith("}"):
                line = process.stdout.readline()
                assert line, "the server did not start"
                told += line
            with httpx.Client(base_url=json.loads(told)["address"], timeout=_SECONDS) as client:
                yield client
        finally:
            process.terminate()


def answers() -> dict[str, Any]:
    """Return what each address answers."""
    with served() as client, lab.folder() as place:
        found = {"catalogue": client.get("/api/catalogue").json()}
        found["measure"] = {
            f"{name} {json.dumps(told)}": _upload(
                client, "measure", (place / name).read_bytes(), name, options=told
            )
            for name, known in _MEASURED.items()
            for told in ({}, known)
        }
        force = (place / "floor-force.csv").read_bytes()
        found["fit"] = _fits(client, force)
        return found | {
            "simulate": {name: _posted(client, "simulate", **one) for name, one in _plays()},
            "map": {name: _posted(client, "map", **one) for name, one in _maps()},
            "map/paths": {name: _paths(client, drop) for name, drop in _drops()},
            "stack": {
                " ".join(balls): _posted(client, "stack", balls=balls, height=0.5)
                for balls in (["B1"], ["B1", "B2"], ["basketball", "tennis"], ["B3", "B2", "B1"])
            },
            "law": {name: _posted(client, "law", **one) for name, one in _measured_laws()},
            "like": {name: _posted(client, "like", **one) for name, one in _like()},
            "export": {name: _exports(client, drop) for name, drop in _drops()},
        }


def _drops() -> list[tuple[str, dict[str, Any]]]:
    """Return a drop of each law, and one without a floor."""
    drops = []
    for name, pair in LAWS.items():
        drop = sb.Drop([sb.Ball(0.1, name="a"), sb.Ball(0.05)], pair, [1e-3], impact_speed=1.0)
        drops.append((name, drop.to_mapping()))
    free = sb.Drop([sb.Ball(0.1)] * 2, [None, sb.Spring(1e4)], velocities=[1.0, 0.0])
    return [*drops, ("no floor", free.to_mapping()), ("pair", dict(PAIR))]


def _plays() -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield drops to be played, some of them with gravity."""
    for name, drop in _drops():
        yield name, {"drop": drop, "frames": _FRAMES}
    falling = PAIR | {"gravity": 9.81}
    yield "gravity", {"drop": falling, "frames": _FRAMES}
    yield "until 0.5 s", {"drop": falling, "frames": _FRAMES, "until": 0.5}


def _maps() -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield maps: a number of the outcome each, over ratios and over single numbers."""
    for show in ("rebound_ratio.1", "rebound_height.0", "energy_retained", "collisions.1"):
        yield show, {"drop": PAIR, "x": _X, "y": _Y, "show": show}
    gap = {"path": "gaps.0", "low": 0.0, "high": 0.01, "count": 6}
    for name, drop in _drops():
        if name not in ("no floor", "pair"):
            side = {"path": "balls.1.mass", "low": 0.01, "high": 0.2, "count": 5}
            asked = {"drop": drop, "x": gap, "y": side, "show": "rebound_ratio.1"}
            yield f"{name} over gap and mass", asked


def _measured_laws() -> Iterator[tuple[str, dict[str, Any]]]:
    asked = {"mass": 0.057, "restitution": 0.75, "contact_time": 5e-3, "impact_speed": 3.0}
    for law in LAWS:
        if "," not in law:
            lossless = law in ("Spring", "Hertz", "PowerLaw")
            yield (
                law,
                {"law": law, "exponent": 1.3 if law == "PowerLaw" else None}
                | asked
                | ({"restitution": None} if lossless else {}),
            )


def _like() -> Iterator[tuple[str, dict[str, Any]]]:
    contact = {"law": "HuntCrossley", "stiffness": 1e6, "exponent": 1.5, "dissipation": 0.1}
    for law in LAWS:
        if "," not in law:
            yield law, {"contact": contact, "to": law, "mass": 0.1, "impact_speed": 2.0}


def _posted(client: httpx.Client, path: str, **asked: Any) -> Any:
    return _answer(lambda: client.post(f"/api/{path}", json=asked))


def _answer(ask: Any) -> Any:
    """Return an answer; of what is refused, the status and the detail."""
    response = ask()
    for _ in range(_TRIES):
        if response.status_code != httpx.codes.SERVICE_UNAVAILABLE:
            break
        time.sleep(2.0)
        response = ask()
    told = response.json()
    return told if response.is_success else {"status": response.status_code, **told}


def _upload(client: httpx.Client, path: str, content: bytes, name: str, **asked: Any) -> Any:
    data = {key: json.dumps(value) for key, value in asked.items()}
    file = {"file": (name, content)} if name else None
    return _answer(lambda: client.post(f"/api/{path}", files=file, data=data))


def _fits(client: httpx.Client, force: bytes) -> dict[str, Any]:
    """Return a drop fitted to a record, and to a typed number."""
    vary = ["contacts.0.stiffness", "contacts.1.stiffness"]
    record = {"drop": PAIR, "vary": vary, "measured": {"force.0": "force"}}
    typed = record | {"vary": vary[1:], "measured": {"rebound_ratios.1": "1.64 ± 0.02"}}
    return {
        "record": _upload(client, "fit", force, "floor-force.csv", **record),
        "number": _upload(client, "fit", b"", "", **typed),
    }


def _paths(client: httpx.Client, drop: dict[str, Any]) -> Any:
    """Return what can vary and be shown, by its path."""
    told = _posted(client, "map/paths", drop=drop)
    return {"paths": {one["path"]: one for one in told["paths"]}, "shows": told["shows"]}


def _exports(client: httpx.Client, drop: dict[str, Any]) -> dict[str, Any]:
    """Return the texts that a drop is exported to; of its data, columns of numbers."""
    texts = {}
    for kind in ("csv", "toml", "python"):
        response = client.post(f"/api/export/{kind}", json={"drop": drop})
        texts[kind] = response.text
        texts[f"{kind}, file"] = response.headers.get("content-disposition", "")
    rows = list(csv.reader(io.StringIO(texts.pop("csv"))))
    columns = [[float(cell) for cell in column] for column in zip(*rows[1:], strict=True)]
    return texts | {"csv": dict(zip(rows[0], columns, strict=True))}


def refused() -> dict[str, Any]:
    """Return what the server answers to requests that make no sense."""
    with served() as client:
        found = {}
        for line in commands.lines_of(commands.LINES.with_name("requests.txt")):
            path, _, asked = line.partition(" ")
            body = json.loads(asked.replace("PAIR", json.dumps(PAIR)))
            found[line] = _posted(client, path, **body)
        return found
