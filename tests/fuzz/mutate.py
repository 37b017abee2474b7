"""Files of measurements, changed at random: the same changes for the same seed and number."""

import re
from collections.abc import Callable
from typing import Any

import numpy as np

from measure.make_files import MAKERS

Random = np.random.Generator
MOST = 4  # changes of one file
_NUMBER = re.compile(r"[-+]?\d+(?:[.,]\d+)?(?:[eE][-+]?\d+)?")
_CELLS = (
    "", "nan", "inf", "-", "0", "-1", "1e300", "1e-300", "9" * 25, "text", "1,5", "1.5.2", '"',
)  # fmt: skip
_NAMES = (
    "time", "t", "bounce", "event time", "force", "F (N)", "x", "y", "height (cm)", "CH1", "sound",
    "acceleration x", "time (ms)", "frame", "compression", "", "1", "=", "a;b",
)  # fmt: skip
OPTIONS = (
    *((),) * 12, ("--holds", "waveform"), ("--holds", "track"), ("--holds", "sound"),
    ("--holds", "press-curve"), ("--holds", "acceleration"), ("--holds", "knocks"),
    ("--holds", "table"), ("--column", "time=1", "--column", "y=2"),
    ("--column", "1=time", "--column", "2=force"), ("--unit", "1=ms"), ("--height", "1m"),
    ("--mass", "57g", "--law", "hertz"), ("--run", "2"), ("--decimal", ","),
    ("--frame-rate", "60", "--scale", "1mm"), ("--time-constant", "1ms"), ("--table", "1"),
    ("--mass", "57g", "--speed", "3m/s", "--diameter", "66mm"), ("--floor", "10cm"),
    ("--mass", "57g", "--law", "viscoelastic", "--restitution", "0.7"),
    ("--gravity", "1.6m/s^2", "--contact-time", "5ms", "--mass", "1g"),
    ("--from", "10", "--to", "2s"), ("--from", "0.1s"),
)  # fmt: skip


def minimal_cases() -> dict[str, bytes]:
    """Return the files that tests make of each format, and a few that are hardly any."""
    cases = {name: make() for name, make in MAKERS.items()}
    ball = np.abs(np.sin(np.arange(90) / 15)) + np.arange(90) % 2 * 1e-3
    cases["ball.csv"] = _lines("t,x,y", np.arange(90) / 60, 0.1 * np.arange(90), ball)
    knocks = np.random.default_rng(1).normal(0, 9, 4000) * (np.arange(4000) % 1300 < 60)
    cases["sound in ms.csv"] = _lines("time,sound", np.arange(4000) / 8, knocks)
    cases["bounces.csv"] = _lines("bounce,e", np.arange(9), np.full(9, 0.7))
    cases["heights.csv"] = _lines("height (cm)", 100 * 0.6 ** np.arange(6))
    cases["phone.csv"] = _lines(
        "time,seconds_elapsed,z,y,x", 1.69e18 + 1e7 * np.arange(80), *[ball[:80]] * 4
    )
    return cases | _long_cases() | _short_cases()


def _long_cases() -> dict[str, bytes]:
    """Return files whose analysis takes memory and time: many pieces, many samples."""
    times = np.arange(1000) / 240.0
    noise = np.random.default_rng(2).normal(0.0, 0.01, 1000)
    return {
        "sine.csv": _lines("t,y", times, np.abs(np.sin(20.0 * times))),
        "drift.csv": _lines("time,force", times, 0.1 * times + noise),
        "spring.csv": _lines("time,force", times, np.sin(30.0 * times) + noise),
        "swing.csv": _lines("t,x,y", times, np.cos(3.0 * times), np.sin(3.0 * times) ** 2),
        "trace.csv": _lines(
            "time,acceleration", times, 9.81 * np.sign(np.sin(60.0 * times)) + noise
        ),
    }


def _short_cases() -> dict[str, bytes]:
    """Return files with hardly a row, of the kinds of all columns."""
    heads = (
        "t,y",
        "time,force",
        "time,sound",
        "time,acceleration",
        "compression,force",
        "bounce,e",
    )
    return {
        f"{rows} of {head}.csv": _lines(head, *[np.arange(rows) * 0.1] * 2)
        for head in heads
        for rows in (0, 1, 2, 3, 5)
    }


def _lines(head: str, *columns: np.ndarray) -> bytes:
    rows = zip(*columns, strict=True)
    return "\n".join([head, *(",".join(f"{cell:.6g}" for cell in row) for row in rows)]).encode()


def mutated(content: bytes, random: Random) -> bytes:
    for _ in range(int(random.integers(1, MOST + 1))):
        text = not content[:400].count(0) and random.random() < 0.9
        if text and content.count(b"\n") > 1:
            change = TEXT[int(random.integers(len(TEXT)))]
            lines = content.decode("utf-8", "replace").split("\n")
            content = "\n".join(change(lines, random)).encode()
        elif content:
            content = BYTES[int(random.integers(len(BYTES)))](content, random)
    return content


# --- bytes or lines of text


def _span(count: int, random: Random) -> slice:
    first, last = sorted(random.integers(0, count + 1, 2).tolist())
    return slice(first, last)


def _cut(parts: Any, random: Random) -> Any:
    span = _span(len(parts), random)
    return parts[: span.start] + parts[span.stop :]


def _double(parts: Any, random: Random) -> Any:
    span = _span(len(parts), random)
    return parts[: span.stop] + parts[span]


# --- bytes


def _flip(content: bytes, random: Random) -> bytes:
    changed = bytearray(content)
    for at in random.integers(0, len(content), int(random.integers(1, 30))):
        changed[at] = int(random.integers(256))
    return bytes(changed)


def _end(content: bytes, random: Random) -> bytes:
    return content[: int(random.integers(len(content)))]


def _encoded(content: bytes, random: Random) -> bytes:
    """Return a text in another encoding, or with other ends of lines."""
    text = content.decode("latin-1")
    match int(random.integers(4)):
        case 0:
            return text.encode("utf-16")
        case 1:
            return b"\xef\xbb\xbf" + content
        case 2:
            return content.replace(b"\n", b"\r")
        case _:
            return content.replace(b"\n", b"\n\0")


BYTES: tuple[Callable[[bytes, Random], bytes], ...] = (_flip, _cut, _end, _double, _encoded)


# --- lines of text


def _few(lines: list[str], random: Random) -> list[str]:
    first = int(random.integers(0, 4))
    return lines[: first + int(random.integers(0, 12))]


def _order(lines: list[str], random: Random) -> list[str]:
    body = lines[3:]
    if random.random() < 0.5:
        return lines[:3] + body[::-1]
    return lines[:3] + [body[k] for k in random.permutation(len(body))]


def _header(lines: list[str], random: Random) -> list[str]:
    mark = _mark(lines)
    line = int(random.integers(0, min(4, len(lines))))
    cells = [_NAMES[int(random.integers(len(_NAMES)))] for _ in lines[line].split(mark)]
    return [*lines[:line], mark.join(cells), *lines[line + 1 :]]


def _cells(lines: list[str], random: Random) -> list[str]:
    mark, changed = _mark(lines), list(lines)
    for at in random.integers(0, len(lines), int(random.integers(1, 20))):
        cells = changed[at].split(mark)
        cells[int(random.integers(len(cells)))] = _CELLS[int(random.integers(len(_CELLS)))]
        changed[at] = mark.join(cells)
    return changed


def _column(lines: list[str], random: Random) -> list[str]:
    """Change all numbers of a column: constant, counted, rounded, scaled, shifted, or gone."""
    mark = _mark(lines)
    place = int(random.integers(max(line.count(mark) for line in lines) + 1))
    what = int(random.integers(7))
    scale, digits = 10.0 ** int(random.integers(-9, 12)), int(random.integers(1, 6))
    changed = []
    for row, line in enumerate(lines):
        cells = line.split(mark)
        if place < len(cells) and _NUMBER.fullmatch(cells[place].strip()):
            value = float(cells[place].strip().replace(",", "."))
            single = float(np.float32(np.clip(value, -1e38, 1e38)))
            cells[place] = (
                "1", str(row), f"{value:.{digits}g}", repr(value * scale), repr(value + scale),
                repr(-value), repr(single),
            )[what]  # fmt: skip
        changed.append(mark.join(cells))
    return changed


def _no_column(lines: list[str], random: Random) -> list[str]:
    mark = _mark(lines)
    place = int(random.integers(max(line.count(mark) for line in lines) + 1))
    rows = [line.split(mark) for line in lines]
    return [mark.join(row[:place] + row[place + 1 :]) for row in rows]


def _marks(lines: list[str], random: Random) -> list[str]:
    mark = _mark(lines)
    other = ",;\t "[int(random.integers(4))]
    comma = random.random() < 0.5
    return [(line.replace(".", ",") if comma else line).replace(mark, other) for line in lines]


def _long(lines: list[str], random: Random) -> list[str]:
    """Repeat all lines, up to some thousands."""
    times = int(random.integers(2, 20))
    return lines[:3] + lines[3:] * min(times, 1 + 5000 // len(lines))


def _constant(lines: list[str], random: Random) -> list[str]:
    """Let all lines after one be like it, but for the first column."""
    mark, at = _mark(lines), int(random.integers(len(lines)))
    first, rest = lines[at].partition(mark)[::2]
    return lines[:at] + [
        f"{line.partition(mark)[0] if random.random() < 0.99 else first}{mark}{rest}"
        for line in lines[at:]
    ]


def _mark(lines: list[str]) -> str:
    """Return what stands between the cells."""
    return max("\t;, ", key=lambda mark: sum(line.count(mark) for line in lines[:50]))


TEXT: tuple[Callable[[list[str], Random], list[str]], ...] = (
    _few, _cut, _double, _order, _header, _cells, _column, _column, _column, _no_column, _marks,
    _long, _constant,
)  # fmt: skip
