"""Send generated and hand-made requests to the page's server: each gets an answer in words.

Run `python -m adversary.requests [--count 5000] [--seed 1]` in `tests/`. Two thirds of the requests
are generated from the server's own description (OpenAPI) or are valid ones with some values
replaced; the others break HTTP, its limits or a form. No answer may have the status 500 or hang,
and the server must live, write no traceback, and keep its memory.
"""

import argparse
import asyncio
import contextlib
import json
import sys
import tempfile
from collections import Counter
from collections.abc import Callable
from time import perf_counter
from typing import Any, NamedTuple

import httpx
import numpy as np
from rich.console import Console

from adversary.requests_server import Server, make_drop, make_map, serving

__all__ = ["Answer", "attack"]

_Random = np.random.Generator

MOST_SECONDS = 90.0
"""An answer that takes longer counts as none: a fit may take 60 s."""

MOST_MEBIBYTES = 800.0
"""Memory that the server itself may have, without its workers."""

_PAUSE = 2.0  # s
_SPRING = {"law": "Spring", "stiffness": 2500.0}
_HOSTILE: list[Any] = [
    *(None, True, 0, -1, 3, 1e-320, 1e308, -1e308, float("nan"), float("inf"), 2**63, 10**400),
    *("", " ", "\0", "\ud800", "\n", "nan", "1e999 kg", "57 m", "57 g ± inf", "9" * 5000, "💥"),
    *("../../etc/passwd", "__proto__", "balls.0.mass", "balls.99.mass", "gravity", "$\\frac{$"),
    *([], {}, [[]], {"": None}, ["a"] * 50, [0.0] * 3000, {"mass": {"mass": 1}}),
    json.loads("[" * 500 + "]" * 500),
]
_BASES: dict[str, list[dict[str, Any]]] = {
    "/api/stack": [{"balls": ["B1", "B2"], "height": 0.2}],
    "/api/law": [{"law": "Dashpot", "mass": 0.057, "restitution": 0.75, "contact_time": 5e-3}],
    "/api/like": [{"contact": _SPRING, "to": "Hertz", "mass": 0.1, "impact_speed": 2.0}],
    "/api/simulate": [
        {"drop": make_drop(2, _SPRING), "frames": 50},
        {"drop": make_drop(3, _SPRING, gravity=9.81), "until": 0.5, "frames": 50},
    ],
    "/api/predict": [{"drop": make_drop(2, _SPRING), "errors": {"balls.0.mass": "1 g"}}],
    "/api/map": [make_map(2, _SPRING, 5), make_map(3, _SPRING, 5) | {"show": "collisions.1"}],
    "/api/map/paths": [{"drop": make_drop(2, _SPRING)}],
    "/api/export/csv": [{"drop": make_drop(2, _SPRING)}],
    "/api/export/svg": [{"drop": make_drop(2, _SPRING)}],
    "/api/export/python": [{"drop": make_drop(2, _SPRING), "until": 0.5}],
}
_FORMS: dict[str, dict[str, Any]] = {
    "/api/measure": {"options": {"mass": "57 g"}},
    "/api/fit": {
        "drop": make_drop(2, _SPRING),
        "vary": ["contacts.0.stiffness"],
        "measured": {"rebound_ratios.1": "1.6 ± 0.1"},
        "options": {},
    },
}
_FILES = [
    b"",
    b"\0" * 100,
    b"PK\x03\x04" + b"\xff" * 60,
    b"RIFF\xff\xff\xff\xffWAVEfmt \x10\0\0\0" + b"\xff" * 40,
    b"time (s),force (N)\n" + b"".join(b"%d,%d\n" % (i, i % 7) for i in range(60)),
    b"time (s),y (m)\n" + b"".join(b"%de-2,%f\n" % (i, abs(np.sin(i / 9))) for i in range(200)),
    b",".join(b"9" * 500 for _ in range(100)),
]


class Request(NamedTuple):
    """A request as it is sent, whether its head is HTTP, and what it is about."""

    sent: bytes
    sound: bool
    about: str


class Answer(NamedTuple):
    """What came back: the status, 0 for none; the time in s; what is wrong with it."""

    index: int
    about: str
    status: int
    seconds: float
    wrong: str


def _pick(random: _Random, values: Any) -> Any:
    return values[int(random.integers(len(values)))]


def _made(random: _Random, schema: dict[str, Any], parts: dict[str, Any], depth: int = 0) -> Any:
    """Return a value as a schema has it, or now and then one that is hostile."""
    if random.random() < 0.03 or depth > 6:
        return _pick(random, _HOSTILE)
    if "$ref" in schema:
        schema = parts[schema["$ref"].rpartition("/")[2]]
    for several in ("anyOf", "oneOf", "allOf"):
        if several in schema:
            return _made(random, _pick(random, schema[several]), parts, depth + 1)
    if "enum" in schema:
        return _pick(random, schema["enum"])
    match schema.get("type"):
        case "object":
            known = schema.get("properties", {})
            needed = schema.get("required", [])
            names = [name for name in known if name in needed or random.random() < 0.5]
            return {name: _made(random, known[name], parts, depth + 1) for name in names}
        case "array":
            count = int(random.integers(schema.get("minItems", 0), schema.get("maxItems", 3) + 1))
            return [_made(random, schema.get("items", {}), parts, depth + 1) for _ in range(count)]
        case "integer":
            least = schema.get("minimum", -5)
            return int(random.integers(least, min(schema.get("maximum", 60), least + 60) + 1))
        case "number":
            return float(10.0 ** random.uniform(-4, 4))
        case "boolean":
            return bool(random.random() < 0.5)
        case "string":
            return _pick(
                random, ["Spring", "Dashpot", "Rigid", "B1", "mass_ratio", "57 g", "gaps.0"]
            )
    return _pick(random, _HOSTILE)


def _changed(random: _Random, value: Any) -> Any:
    """Return a value with one of its parts replaced, left out or repeated."""
    if isinstance(value, dict) and value and random.random() < 0.85:
        name = _pick(random, sorted(value))
        rest = {one: part for one, part in value.items() if one != name}
        how = random.random()
        if how < 0.1:
            return rest
        if how < 0.2:
            return value | {str(_pick(random, _HOSTILE))[:50]: value[name]}
        return rest | {name: _changed(random, value[name])}
    if isinstance(value, list) and value and random.random() < 0.85:
        i = int(random.integers(len(value)))
        if random.random() < 0.2:
            return value[:i] + [value[i]] * int(random.integers(4)) + value[i + 1 :]
        return [*value[:i], _changed(random, value[i]), *value[i + 1 :]]
    if isinstance(value, float) and random.random() < 0.6:
        return value * 10.0 ** random.uniform(-4, 4)
    return _pick(random, _HOSTILE)


def _post(path: str, body: bytes, kind: str = "application/json") -> bytes:
    head = f"POST {path} HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: {kind}\r\n"
    return (head + f"Content-Length: {len(body)}\r\nConnection: close\r\n\r\n").encode() + body


def _get(target: str, *more: str, method: str = "GET", host: str = "127.0.0.1") -> bytes:
    lines = [f"{method} {target} HTTP/1.1", f"Host: {host}", "Connection: close", *more]
    return "\r\n".join([*lines, "", ""]).encode("utf-8", "surrogateescape")


def _described(random: _Random, parts: dict[str, Any]) -> Request:
    path = _pick(random, sorted(_BASES))
    plain = path if not path.startswith("/api/export") else "/api/export/{kind}"
    schema = parts["paths"][plain]["post"]["requestBody"]["content"]["application/json"]["schema"]
    value = _made(random, schema, parts["components"]["schemas"])
    return Request(_post(path, json.dumps(value).encode()), True, f"described {path}")


def _mutated(random: _Random, _: dict[str, Any]) -> Request:
    path = _pick(random, sorted(_BASES))
    value: Any = _pick(random, _BASES[path])
    for _time in range(int(random.integers(3))):
        value = _changed(random, value)
    return Request(_post(path, json.dumps(value).encode()), True, f"mutated {path}")


def _form(random: _Random, _: dict[str, Any]) -> Request:
    path = _pick(random, ["/api/measure"] * 4 + ["/api/fit"])
    fields: dict[str, Any] = _FORMS[path]
    if random.random() < 0.8:
        fields = {name: _changed(random, value) for name, value in fields.items()}
    parts = [
        f'Content-Disposition: form-data; name="{name}"\r\n\r\n{json.dumps(value)}'.encode()
        for name, value in fields.items()
    ]
    file = bytearray(_pick(random, _FILES))
    for _time in range(int(random.integers(5)) if file else 0):
        file[int(random.integers(len(file)))] = int(random.integers(256))
    named = _pick(random, ["a.csv", "", "..\\..\\a", "a\0b", "é💥" * 40, 'a"; name="b'])
    parts.append(
        f'Content-Disposition: form-data; name="file"; filename="{named}"\r\n\r\n'.encode() + file
    )
    ends = _pick(random, [b"--cut--\r\n"] * 8 + [b"", b"--cut", b"\r\n\r\n--cut--"])
    body = b"".join(b"--cut\r\n" + part + b"\r\n" for part in parts) + ends
    cut = _pick(random, ["cut"] * 8 + ["", "a" * 300, 'c"ut'])
    return Request(_post(path, body, f"multipart/form-data; boundary={cut}"), True, f"form {path}")


_TARGETS = [
    *"/paper/%00 /%00 /paper/%2e%2e%2f%2e%2e%2fetc/passwd /..%5c..%5cetc/passwd /%ff * //a".split(),
    *"/js/%00.js /paper// /api/openapi.json /api/status?x=%00 /api/export/%00 /api/none /~".split(),
    *"/favicon.ico/ http://127.0.0.1/api/status /paper/%ed%a0%80 /style.css/%2e /con /.git".split(),
    *("/paper/" + "a" * 5000, "/" + "a/" * 3000, "/?" + "&" * 9000),
]
_HEADERS = [
    *("Range: bytes=0-99999999999999999999", "Range: bytes=-1", "Range: bytes=5-2,a-b", "Range: x"),
    *("If-Modified-Since: Thu, 99 Foo 99999 99:99:99", "If-None-Match: " + '"a",' * 900),
    *("Origin: null", "Origin: http://evil.example", "Sec-Fetch-Site: cross-site", "Accept: \xff"),
    *("X-Forwarded-For: 1.2.3.4", "Transfer-Encoding: chunked", "Expect: 100-continue"),
    *("Upgrade: websocket", "Content-Length: -1", "Content-Length: 99999999999999", "Cookie: \x7f"),
    *("Content-Length: 1, 2", "X: " + "a" * 70_000),
]
_METHODS = "GET GET GET GET GET GET HEAD PUT DELETE OPTIONS TRACE CONNECT X".split()
_HOSTS = ["127.0.0.1"] * 6 + [
    "evil.example",
    "localhost:1",
    "[::1",
    "",
    "a" * 9000,
    "127.1",
    "\xff",
]
_BODIES = [
    *(b"", b"[", b"\xff", b"NaN", b"1e999", b"\0", b"9" * 60_000, b"[" * 60_000, b"x" * 70_000),
    *(b'{"a":' * 9000, b'{"drop": ' + b"[" * 30_000 + b"]" * 30_000 + b"}", b'"' + b"a" * 60_000),
]
_KINDS = ["application/json"] * 4 + ["text/plain", "multipart/form-data", "multipart/x; boundary=a"]


def _page(random: _Random, _: dict[str, Any]) -> Request:
    headers = [_pick(random, _HEADERS) for _time in range(int(random.integers(3)))]
    method, host = _pick(random, _METHODS), _pick(random, _HOSTS)
    sent = _get(_pick(random, _TARGETS), *headers, method=method, host=host)
    return Request(sent, False, "page")


def _body(random: _Random, _: dict[str, Any]) -> Request:
    path = _pick(random, sorted([*_BASES, *_FORMS]))
    sent = _post(path, _pick(random, _BODIES), _pick(random, _KINDS))
    return Request(sent, True, f"body {path}")


def _broken(random: _Random, _: dict[str, Any]) -> Request:
    sent = bytearray(_post(_pick(random, sorted(_BASES)), b'{"balls": ["B1"]}'))
    for _time in range(int(random.integers(1, 8))):
        sent[int(random.integers(len(sent)))] = int(random.integers(256))
    if random.random() < 0.2:
        sent = sent[: int(random.integers(len(sent)))]
    if random.random() < 0.1:
        sent *= 20  # one after another on the same connection
    return Request(bytes(sent), False, "broken")


_MAKERS: list[tuple[float, Callable[[_Random, dict[str, Any]], Request]]] = [
    (0.25, _described),
    (0.40, _mutated),
    (0.10, _form),
    (0.12, _page),
    (0.05, _body),
    (0.08, _broken),
]


def make(seed: int, index: int, description: dict[str, Any]) -> Request:
    """Return a request, always the same for a seed and an index."""
    random = np.random.default_rng([seed, index])
    weights = [weight for weight, _ in _MAKERS]
    return _MAKERS[int(random.choice(len(_MAKERS), p=weights))][1](random, description)


async def _ask(place: tuple[str, int], request: Request) -> tuple[int, str]:
    """Send a request; return its status, and what is wrong with the answer."""
    reader, writer = await asyncio.open_connection(*place)
    try:
        writer.write(request.sent)
        whole = b""
        if not request.sound:  # it may be unfinished: then no more comes after a while
            with contextlib.suppress(TimeoutError):
                async with asyncio.timeout(_PAUSE):
                    whole = await reader.read(1 << 16)
            writer.write_eof()
        whole += await reader.read()
    except OSError:
        return 0, ""  # a server may close a connection at any time
    finally:
        writer.close()
    if not whole:
        return 0, "no answer" if request.sound else ""
    head, _, body = whole.partition(b"\r\n\r\n")
    status = int(head.split()[1])
    if status >= 500 and status != 503:
        return status, body[:200].decode(errors="replace")
    if status >= 400 and b"application/json" in head and body:
        detail = json.loads(body)["detail"]
        if "\n" in detail or "Traceback" in detail:
            return status, f"not one line: {detail!r}"
    return status, ""


async def attack(server: Server, count: int, seed: int, connections: int = 6) -> list[Answer]:
    """Send so many requests; return their answers."""
    description = httpx.get(f"{server.address}api/openapi.json", timeout=60.0).json()
    left, answers = iter(range(count)), []

    async def send() -> None:
        for index in left:
            request = make(seed, index, description)
            start = perf_counter()
            try:
                async with asyncio.timeout(MOST_SECONDS):
                    status, wrong = await _ask(server.place, request)
            except TimeoutError:
                status, wrong = 0, f"no answer within {MOST_SECONDS:g} s"
            seconds = perf_counter() - start
            answers.append(Answer(index, request.about, status, seconds, wrong))

    await asyncio.gather(*(send() for _ in range(connections)))
    return answers


def judge(server: Server, written: str, answers: list[Answer]) -> list[str]:
    """Return what is wrong with a server that was attacked, or with its answers."""
    wrong = [f"request {one.index} ({one.about}): {one.wrong}" for one in answers if one.wrong]
    if server.process.poll() is not None:
        wrong.append("the server has ended")
    elif httpx.get(f"{server.address}api/status", timeout=10.0).status_code != 200:
        wrong.append("the server does not answer")
    if "Traceback" in written:
        wrong.append(f"the server wrote: {written[-2000:]}")
    if server.own_memory() > MOST_MEBIBYTES:
        wrong.append(f"the server has {server.own_memory():.0f} MiB")
    return wrong


def main() -> int:
    """Attack a server; return 1 if anything was wrong."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--count", type=int, default=5000)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    with tempfile.TemporaryFile("w+") as errors, serving(stderr=errors) as server:
        answers = asyncio.run(attack(server, arguments.count, arguments.seed))
        errors.seek(0)
        wrong = judge(server, errors.read(), answers)
        memory = server.own_memory(), server.memory()
    counts = Counter(answer.status for answer in answers)
    statuses = ", ".join(
        f"{count} × {status or 'none'}" for status, count in sorted(counts.items())
    )
    slowest = max(answers, key=lambda answer: answer.seconds)
    lines = [
        f"{len(answers)} requests with the seed {arguments.seed}; statuses: {statuses}",
        f"the slowest took {slowest.seconds:.1f} s: request {slowest.index} ({slowest.about})",
        f"memory: {memory[0]:.0f} MiB, with all processes {memory[1]:.0f} MiB",
        *(wrong or ["nothing is wrong"]),
    ]
    Console(soft_wrap=True, markup=False, highlight=False).print("\n".join(lines))
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main())
