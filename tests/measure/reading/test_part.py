"""A part of a record is chosen by times, frames or rows, whatever the file counts."""

import pytest

from stackbounce.cli import main
from stackbounce.errors import InvalidValue
from stackbounce.explorer.answers import records

KNOCKS = "knock time (s)\n" + "".join(f"{t}\n" for t in (0.0, 0.8, 1.44, 1.952, 5.0, 6.0, 6.9))
MS = "Time (ms),Force (N)\n" + "".join(f"{k},{k % 7}\n" for k in range(100))
FRAMES = "Frame,X,Y\n" + "".join(f"{k},{3 * k},{100 + k * k}\n" for k in range(50))
PRESS = "Force (N),Extension (mm)\n" + "".join(f"{k * k},{k}\n" for k in range(30))


@pytest.mark.parametrize(
    ("content", "options", "along", "ends", "count"),
    [
        (MS, {"start": "20 ms", "stop": 0.05}, "time", (0.02, 0.05), 31),
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
        (MS, {"stop": "soon"}, "got 'soon'"),
    ],
)
def test_what_is_no_part_is_refused(read, content, options, words):
    with pytest.raises(InvalidValue, match=words):
        read(content, **options)


def test_command_and_page_have_it(tmp_path, capfd):
    path = tmp_path / "knocks.csv"
    path.write_text(KNOCKS, encoding="utf-8")
    assert main(["measure", str(path), "--from", "0", "--to", "2s"]) == 0
    assert "0.800" in capfd.readouterr().out
    assert main(["measure", str(path), "--from", "70"]) == 2
    assert "--from, --to must leave some of the record" in capfd.readouterr().err
    assert "0.8" in records.measure_record("k", KNOCKS.encode(), {"start": "0", "stop": "2 s"})
