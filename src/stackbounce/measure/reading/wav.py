"""Sound: WAV files of 8, 16, 24 or 32 bits or floating point, read chunk by chunk."""

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import FileError
from stackbounce.measure.reading.limits import CELLS

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["is_wav", "read_wav"]

_INTEGER, _FLOAT, _EXTENSIBLE = 1, 3, 0xFFFE
_CODES = {2: "ADPCM", 6: "A-law", 7: "µ-law", 0x11: "IMA ADPCM", 0x31: "GSM", 0x55: "MP3"}
_KINDS = {
    (_INTEGER, 1): "u1", (_INTEGER, 2): "<i2", (_INTEGER, 3): "u1", (_INTEGER, 4): "<i4",
    (_FLOAT, 4): "<f4", (_FLOAT, 8): "<f8",
}  # fmt: skip


@dataclass(frozen=True)
class _Form:
    code: int
    channels: int
    rate: int
    size: int  # bytes of a number


def is_wav(content: bytearray) -> bool:
    """Tell whether bytes are a RIFF file of the kind WAVE."""
    return content.startswith((b"RIFF", b"RF64", b"RIFX")) and bytes(content[8:12]) in (
        b"WAVE",
        b"",
    )


def read_wav(content: bytearray) -> tuple["xr.Dataset", str, list[str]]:
    """Return the sound over time, why it is one, and what is unsure.

    Channels are averaged, and full scale is 1. Of a file that is cut off, what is there is read,
    and the doubt tells how much.

    Raises
    ------
    FileError
        If there is no sound in it, or one that is compressed, or too long.
    """
    import xarray as xr

    if content[:4] == b"RIFX":
        raise FileError("it is a WAV sound with the high byte first: save it as an ordinary one")
    form, start, size = _found(content)
    frame = form.channels * form.size
    streamed = size in (0, 0xFFFFFFFF)  # written without knowing the end
    there = len(content) - start
    frames = (there if streamed else min(size, there)) // frame
    doubts = []
    if not streamed and there < size:
        whole = size // frame / form.rate
        doubts.append(f"it is cut off: {frames / form.rate:.3f} s of {whole:.3f} s are there")
    if frames < 1:
        raise FileError("it is a WAV sound without a sample")
    if frames * form.channels > CELLS:
        raise FileError(f"it is a WAV sound of more than {CELLS} samples: cut out the bounces")
    sound = _folded(content[start : start + frames * frame], form)
    bad = ~np.isfinite(sound)
    if bad.any():
        doubts.append(f"{int(bad.sum())} samples are no numbers: taken as 0")
        sound[bad] = 0.0
    peak = float(np.abs(sound).max())
    if form.code == _INTEGER and peak >= 1.0 - 2.0 ** (2 - 8 * form.size):
        doubts.append("it reaches full scale: the loudest knocks may be clipped")
    time = np.arange(frames) / form.rate
    kind = "floating point" if form.code == _FLOAT else "integers"
    many = f"{form.channels} channels, averaged" if form.channels > 1 else "1 channel"
    said = {"units": "1", "long_name": "sound", "rate": float(form.rate)}
    data = xr.Dataset(
        {"sound": ("time", sound, said)},
        coords={"time": ("time", time, {"units": "s", "long_name": "time"})},
    )
    why = f"it begins as RIFF WAVE: {8 * form.size} bit {kind}, {many}, {form.rate} Hz"
    return data, why, doubts


def _chunks(content: bytearray) -> Iterator[tuple[bytes, int, int]]:
    """Yield name, start and size of each chunk, a limited number of them."""
    start = 12
    for _ in range(10_000):
        if start + 8 > len(content):
            return
        name, size = struct.unpack_from("<4sI", content, start)
        yield name, start + 8, size
        start += 8 + size + size % 2


def _found(content: bytearray) -> tuple[_Form, int, int]:
    form = None
    for name, start, size in _chunks(content):
        if name == b"fmt ":
            form = _form(content[start : start + size])
        elif name == b"data":
            if form is None:
                break
            return form, start, size
    missing = "sound" if form else "the format of its sound"
    raise FileError(f"it is a WAV sound, but broken: {missing} is missing")


def _form(chunk: bytearray) -> _Form:
    if len(chunk) < 16:
        raise FileError("it is a WAV sound, but broken: its format is cut off")
    code, channels, rate, _, frame, bits = struct.unpack_from("<HHIIHH", chunk)
    if code == _EXTENSIBLE and len(chunk) >= 26:
        (code,) = struct.unpack_from("<H", chunk, 24)
    size = frame // channels if channels else 0
    if code not in (_INTEGER, _FLOAT):
        name = _CODES.get(code, f"in a format of number {code:#x}")
        raise FileError(f"it is a WAV sound compressed as {name}: save it as PCM")
    if (code, size) not in _KINDS or frame != size * channels or not 0 < bits <= 8 * size:
        raise FileError(
            f"it is a WAV sound of {channels} channels with {bits} bits in {frame} bytes: "
            "8, 16, 24 or 32 bits, or floating point, can be read"
        )
    if rate < 1:
        raise FileError("it is a WAV sound of 0 Hz")
    return _Form(code, channels, rate, size)


def _folded(samples: bytearray, form: _Form) -> NDArray[np.float64]:
    """Return the mean of the channels, of full scale 1."""
    raw = np.frombuffer(samples, dtype=_KINDS[form.code, form.size])
    full = 1.0
    if form.size == 3:
        wide = np.zeros((raw.size // 3, 4), dtype=np.uint8)
        wide[:, 1:] = raw.reshape(-1, 3)  # the highest byte carries the sign
        raw = wide.view("<i4").ravel()
        full = 2.0**31
    elif form.code == _INTEGER:
        full = 2.0 ** (8 * form.size - 1)
    with np.errstate(all="ignore"):
        sound = np.zeros(raw.size // form.channels)
        for k in range(form.channels):
            sound += raw[k :: form.channels]
        sound /= form.channels
        if raw.dtype == np.uint8:
            sound -= full
        sound /= full
    return sound
