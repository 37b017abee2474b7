"""Sound: WAV files, decoded by scipy once their sizes are right."""

import io
import struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

from stackbounce.errors import FileError
from stackbounce.library_types import Dataset
from stackbounce.measure.quantities import Array
from stackbounce.measure.reading.dataset import dataset_of
from stackbounce.measure.reading.limits import CELLS, refusing

_CHUNKS = 10_000  # that are looked at
_UNDECODED = (ValueError, TypeError, ArithmeticError, struct.error)
_STREAMED = (0, 0xFFFFFFFF)  # sizes that recorders write before they know the end


def is_wav(content: bytearray) -> bool:
    """Return whether bytes are a RIFF file of the kind WAVE."""
    riff = content.startswith((b"RIFF", b"RF64"))
    return riff and bytes(content[8:12]) in (b"WAVE", b"")


def read_wav(content: bytearray) -> tuple[Dataset, str, list[str]]:
    """Return the sound over time, the evidence for its format, and what is unsure.

    Channels are averaged, and full scale is 1. If the file is cut off, the samples that are there
    are read, and the doubt says how many are missing.

    Raises
    ------
    FileError
        If there is no sound in it, or one that is compressed, or too long.
    """
    form, start, size = _found(content)
    channels, rate, _, frame = struct.unpack_from("<HIIH", form, 2)
    if not 0 < channels <= frame or rate < 1:
        raise FileError(
            f"it is a WAV sound, but broken: {channels} channels in {frame} bytes at {rate} Hz"
        )
    there = len(content) - start
    frames = (there if size in _STREAMED else min(size, there)) // frame
    doubts = []
    if size not in _STREAMED and there < size:
        whole = size // frame / rate
        doubts.append(f"it is cut off: {frames / rate:.3f} s of {whole:.3f} s are there")
    if frames < 1:
        raise FileError("it is a WAV sound without a sample")
    if frames * channels > CELLS:
        raise FileError(f"it is a WAV sound of more than {CELLS} samples: cut out the bounces")
    part = memoryview(content)[start : start + frames * frame]
    samples = _decoded(form, part, frames)
    sound = _folded(samples)
    integers = samples.dtype.kind in "iu"
    bad = ~np.isfinite(sound)
    if bad.any():
        doubts.append(f"{int(bad.sum())} samples are no numbers: taken as 0")
        sound[bad] = 0.0
    depth = 8 * (frame // channels)
    if integers and float(np.abs(sound).max()) >= 1.0 - 2.0 ** (2 - depth):
        doubts.append("it reaches full scale: the loudest knocks may be clipped")
    said = {"units": "1", "long_name": "sound", "rate": float(rate)}
    time = ("time", np.arange(frames) / rate, {"units": "s", "long_name": "time"})
    data = dataset_of({"sound": ("time", sound, said)}, {"time": time})
    kind = "integers" if integers else "floating point"
    many = f"{channels} channels, averaged" if channels > 1 else "1 channel"
    return data, f"it begins as RIFF WAVE: {depth} bit {kind}, {many}, {rate} Hz", doubts


def _found(content: bytearray) -> tuple[bytearray, int, int]:
    """Return the format chunk, and where the samples start and their size as the file has it."""
    form, start = bytearray(), 20
    for _ in range(_CHUNKS):
        if start > len(content):
            break
        name, size = struct.unpack_from("<4sI", content, start - 8)
        if name == b"fmt ":
            form = content[start : start + size - size % 2]
            if len(form) < 16:
                raise FileError("it is a WAV sound, but broken: its format is cut off")
        elif name == b"data" and form:
            return form, start, size
        start += 8 + size + size % 2
    missing = "sound" if form else "the format of its sound"
    raise FileError(f"it is a WAV sound, but broken: {missing} is missing")


def _decoded(form: bytearray, samples: memoryview, frames: int) -> NDArray[Any]:
    """Return samples (frames, channels), from a WAV file of these two chunks with true sizes."""
    from scipy.io import wavfile

    rate, _, frame = struct.unpack_from("<IIH", form, 4)
    with refusing(_UNDECODED, "it is a WAV sound that cannot be read, save it as PCM: {}"):
        struct.pack_into("<I", form, 8, rate * frame)  # which some recorders get wrong
        head = b"RIFF" + struct.pack("<I", 20 + len(form) + len(samples)) + b"WAVEfmt "
        head += struct.pack("<I", len(form)) + form + b"data" + struct.pack("<I", len(samples))
        _, decoded = wavfile.read(io.BytesIO(b"".join([head, samples])))
        return np.asarray(decoded).reshape(frames, -1)


def _folded(samples: NDArray[Any]) -> Array:
    """Return the mean of the channels, (frames, channels), of full scale 1."""
    with np.errstate(all="ignore"):
        sound: Array = np.mean(samples, axis=1, dtype=np.float64)
    if samples.dtype.kind == "f":
        return sound
    full = 2.0 ** (8 * samples.dtype.itemsize - 1)  # scipy widens 24 bits to the upper ones of 32
    if samples.dtype == np.uint8:
        sound -= full
    return sound / full
