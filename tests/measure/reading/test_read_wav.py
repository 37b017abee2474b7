"""Sound of every kind of WAV."""

import struct

import numpy as np
import pytest

from measure import make_files as made
from stackbounce.errors import FileError, InvalidValue


@pytest.mark.parametrize("channels", [1, 2, 5])
@pytest.mark.parametrize("extensible", [False, True])
@pytest.mark.parametrize(
    ("bits", "floating"), [(8, 0), (16, 0), (24, 0), (32, 0), (32, 1), (64, 1)]
)
def test_every_kind(read, bits, floating, extensible, channels):
    data = read(made.wav(bits, channels, floating, extensible))
    assert (data.attrs["holds"], data.attrs["format"], data.attrs["doubt"]) == ("sound", "WAV", "")
    assert f"{bits} bit" in data.attrs["why"]
    mean = made.sound() * np.mean(1.0 / np.arange(1, channels + 1))
    step = 1e-7 if floating else 1.5 * 2.0 ** (1 - bits)
    np.testing.assert_allclose(data.sound, mean, rtol=0, atol=1.01 * step)
    np.testing.assert_array_equal(data.time, np.arange(800) / 8000)
    assert data.sound.attrs == {"units": "1", "long_name": "sound", "rate": 8000.0}


def test_cut_off_is_read_as_far_as_it_goes(read):
    data = read(made.wav()[:-801])  # in the midst of a sample
    assert data.sizes == {"time": 399}
    assert data.attrs["doubt"] == "it is cut off: 0.050 s of 0.100 s are there"


@pytest.mark.parametrize("size", [0, 0xFFFFFFFF])
def test_a_stream_does_not_know_its_end(read, size):
    data = read(made.wav(size=size))
    assert data.sizes == {"time": 800}
    assert data.attrs["doubt"] == ""


def test_clipping_and_samples_that_are_no_numbers_are_told(read):
    content = bytearray(made.wav(8))
    content[-3] = 255
    assert "full scale" in read(bytes(content)).attrs["doubt"]
    data = read(made.wav(32, floating=True)[:-4] + struct.pack("<f", np.nan))
    assert data.sound[-1] == 0.0
    assert "1 samples are no numbers" in data.attrs["doubt"]


def changed(offset, kind, value):
    content = bytearray(made.wav())
    struct.pack_into(kind, content, offset, value)
    return bytes(content)


@pytest.mark.parametrize(("content", "message"), [
    (made.wav()[:4] + made.wav()[4:12], "the format of its sound is missing"),
    (made.wav()[:30], "its format is cut off"),
    (made.wav()[:40], "sound is missing"),
    (made.wav()[:58], "without a sample"),
    (changed(20, "<H", 0x11), "save it as PCM: Unknown wave file format: DVI_ADPCM"),
    (changed(20, "<H", 0x1234), "Unknown wave file format: 0x1234"),
    (changed(22, "<H", 0), "0 channels"),
    (changed(24, "<I", 0), "1 channels in 2 bytes at 0 Hz"),
    (changed(34, "<H", 99), "99-bit integer"),
    (changed(16, "<I", 2**32 - 1), "sound is missing"),
    (changed(16, "<I", 17), "is missing"),
    (b"RIFF\0\0\0\0AVI LIST", "a video"),
])  # fmt: skip
def test_broken(read, content, message):
    with pytest.raises(FileError, match=message) as caught:
        read(content)
    assert "\n" not in str(caught.value)


def test_a_sound_is_no_track(read):
    with pytest.raises(InvalidValue, match="the file is a sound, got 'track'"):
        read(made.wav(), holds="track")
    assert read(made.wav(), holds="sound").sizes == {"time": 800}
