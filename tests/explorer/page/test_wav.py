"""The WAV file that the page makes of a recording, read by Python and by stackbounce."""

import subprocess
import wave
from pathlib import Path

import numpy as np
import pytest

import stackbounce as sb
from stackbounce.measure import bounces, knocks
from synthetic.falls import falls
from synthetic.sound import sound

_WRITE = Path(__file__).with_name("write_wav.mjs")


@pytest.fixture
def written(page, tmp_path):
    def write(samples, rate):
        given, file = tmp_path / "samples", tmp_path / "recording.wav"
        np.asarray(samples, dtype=np.float64).tofile(given)
        command = ["node", _WRITE, page, given, str(rate), file]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert (done.returncode, done.stderr) == (0, "")
        return file

    return write


@pytest.mark.parametrize(
    ("given", "expected"),
    [
        ([0.0, 1.0, -1.0, 0.5, -0.25, 3.0, -3.0], [0, 32767, -32767, 16384, -8192, 32767, -32767]),
        ([], []),
    ],
)
def test_its_samples_are_those_that_were_given(written, given, expected):
    with wave.open(str(written(given, 48000))) as file:
        assert file.getparams()[:4] == (1, 2, 48000, len(given))
        assert np.frombuffer(file.readframes(len(given)), "<i2").tolist() == expected


def test_stackbounce_finds_the_bounces_in_it(written):
    recording = sound(falls(0.2, lambda _: 0.8, bounces=5), noise=0.002, seed=1)
    loudest = 0.9 / np.abs(recording.sound.values).max()
    rate = round(float(recording.sound.attrs["rate"]))
    read = sb.read(written(loudest * recording.sound.values, rate))
    assert (read.attrs["format"], read.attrs["doubt"]) == ("WAV", "")
    found, expected = (
        [one.nominal_value for one in bounces(knocks(each)).restitutions]
        for each in (read, recording)
    )
    assert found == pytest.approx(expected, abs=1e-3)
