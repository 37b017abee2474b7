"""A part of a record is chosen by times, frames or rows, whatever the file counts."""

import io

import numpy as np
import pytest
from scipy.io import wavfile

from stackbounce.cli import main
from stackbounce.errors import InvalidValue
from stackbounce.explorer.answers import records
from stackbounce.measure import analyse

KNOCKS = "knock time (s)\n" + "".join(f"{t}\n" for t in (0.0, 0.8, 1.44, 1.952, 5.0, 6.0, 6.9))
MS = "Time (ms),Force (N)\n" + "".join(f"{k},{k % 7}\n" for k in range(100))
FRAMES = "Frame,X,Y\n" + "".join(f"{k},{3 * k},{100 + k * k}\n" for k in range(50))
PRESS = "Force (N),Extension (mm)\n" + "".join(f"{k * k},{k}\n" for k in range(30))


def two_drops():
    """Return a recording in which a ball is dropped twice, as a WAV file."""
    rate, random = 44100, np.random.default_rng(5)
    sound = random.normal(0.0, 1e-3, 9 * rate)
    for begin, e in ((0.5, 0.8), (5.0, 0.6)):
        for knock in range(6):
            at = int(rate * (begin + 0.8 * (1 - e**knock) / (1 - e)))
            sound[at : at + 400] += (
                0.6 * e**knock * np.exp(-np.arange(400) / 60) * random.normal(size=400)
            )
    file = io.BytesIO()
    wavfile.write(file, rate, np.int16(2e4 * np.clip(sound, -1.5, 1.5)))
    return file.getvalue()


@pytest.mark.parametrize(
    ("content", "options", "along", "ends", "count"),
    [
        (MS, {"start": "20 ms", "stop": 0.05}, "time", (0.02, 0.05), 31),
        (MS, {"start": "0.09"}, "time", (0.09, 0.099), 10),
        (FRAMES, {"start": 10, "stop": "20"}, "time", (10.0, 20.0), 11),
        (FRAMES, {"start": 10, "stop": 20, "frame_rate": 40.0}, "time", (0.25, 0.5), 11),
        (FRAMES, {"start": "0.25s", "stop": "0.5s", "frame_rate": 40.0}, "time", (0.25, 0.5), 11),
        (KNOCKS, {"stop": "2s"}, "knock_time", (0.0, 1.952), 4),
        (PRESS, {"start": 3, "stop": 12}, "point", (3, 12), 10),
    ],
)
def test_the_part_is_that_between_times_frames_or_rows(read, content, options, along, ends, count):
    found = read(content, **options)[along]
    assert found.size == count
    assert found[[0, -1]].values == pytest.approx(ends)


@pytest.mark.parametrize(
    ("content", "options", "words"),
    [
        (MS, {"start": 5, "stop": 9}, "which goes from 0 to 0.099 s, got 5 to 9"),
        (FRAMES, {"start": "1s"}, "start must be the number of a frame, as the file has no times"),
        (PRESS, {"stop": "1s"}, "stop must be the number of a row"),
        (MS, {"start": "5 mm"}, "start must be a time, such as 1.2s, or a frame"),
        (MS, {"stop": True}, "stop must be a time"),
        (MS, {"stop": "soon"}, "got 'soon'"),
    ],
)
def test_what_is_no_part_is_refused(read, content, options, words):
    with pytest.raises(InvalidValue, match=words):
        read(content, **options)


def test_each_of_two_drops_is_measured_by_itself(read):
    sound = two_drops()
    for options, e in (({"stop": "4.5s"}, 0.8), ({"start": 4.5}, 0.6)):
        found = analyse(read(sound, **options))[0]
        assert found.mean.nominal_value == pytest.approx(e, abs=0.01)


def test_command_and_page_have_it(tmp_path, capfd):
    path = tmp_path / "knocks.csv"
    path.write_text(KNOCKS, encoding="utf-8")
    assert main(["measure", str(path), "--from", "0", "--to", "2s"]) == 0
    assert "0.800" in capfd.readouterr().out
    assert main(["measure", str(path), "--from", "70"]) == 2
    assert "--from, --to must leave some of the record" in capfd.readouterr().err
    assert "0.8" in records.measure_record("k", KNOCKS.encode(), {"start": "0", "stop": "2 s"})
