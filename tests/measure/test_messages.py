"""Hints in messages: each interface words them as it accepts them."""

import pickle
import re
import shlex

import numpy as np
import pytest

import stackbounce as sb
from stackbounce.cli import main
from stackbounce.errors import InvalidValue
from stackbounce.explorer.answers.records import measure_record
from stackbounce.measure import measurement
from stackbounce.measure.kinds import KINDS
from stackbounce.measure.messages import Message, OptionHint

TRACK = "t;x;y\n" + "".join(f"{k / 50};0;{4.9 * (k / 50 - 0.5) ** 2:.4f}\n" for k in range(40))


def table(head, *columns):
    rows = zip(*columns, strict=True)
    return "\n".join([head] * bool(head) + [",".join(map(str, row)) for row in rows])


def wave(count):
    return np.round(np.sin(np.arange(count)) + 2.0, 3)


TIMES, WAVE = np.arange(40) / 25, wave(40)


@pytest.fixture
def refusal(tmp_path, monkeypatch, capfd):
    """Return the one line with which the command line refuses a table."""
    monkeypatch.chdir(tmp_path)

    def refuse(content, *arguments):
        (tmp_path / "a file.csv").write_text(content)
        assert main(["measure", "a file.csv", *arguments]) == 2
        out, err = capfd.readouterr()
        assert (out, err.count("\n")) == ("", 1)
        return err

    return refuse


def test_a_message_keeps_its_hints_through_all_that_is_done_with_it():
    second = Message("one; ", OptionHint({"units": {"x": "cm"}}))
    message = Message("; ").join(["first", second])
    error = InvalidValue(Message.of(InvalidValue(message)).of_file("a.csv"))
    assert str(error) == "a.csv: first; one; units={'x': 'cm'}"
    again = Message.of(pickle.loads(pickle.dumps(error)))
    assert again.worded(lambda hint: str(list(hint.options))) == "a.csv: first; one; ['units']"
    assert pickle.loads(pickle.dumps(second)) == str(second)


def test_what_is_not_recognised_is_described_with_a_command_that_is_accepted(refusal, capfd):
    said = refusal(table("when,level", np.arange(40) / 25, wave(40)))
    assert "its columns do not tell a kind of measurement: 'when' (0, 0.04, 0.08), 'level'" in said
    command = "--holds track --column 1=time --column 2=y"
    assert f": stackbounce measure 'a file.csv' {command}" in said
    typed = said.partition("stackbounce measure ")[2].partition("; other kinds")[0]
    assert main(["measure", *shlex.split(typed)]) in (0, 2)
    told = capfd.readouterr().err
    assert not any(words in told for words in ("do not tell a kind", "unexpected", "--"))


@pytest.mark.parametrize(
    ("header", "columns", "hint"),
    [
        ("Tiempo,posi_x,posi_z", (TIMES, WAVE, WAVE), "track --column 1=time --column 3=y;"),
        (
            "Zeit (s),B (T),Höhenlage (mm)",
            (TIMES, WAVE, WAVE),
            "track --column 1=time --column 3=y;",
        ),
        ("id,time,px,py", (WAVE, TIMES, WAVE, WAVE), "track --column 2=time --column 4=y;"),
        ("frame,ypix", (range(40), WAVE), "track --column 1=time --column 2=y;"),
        ("", (TIMES, WAVE), "track --column 1=time --column 2=y;"),
        ("Time (s),Bx (µT),By (µT)", (TIMES, WAVE, WAVE), ""),
        ("a (s),b (s),c (s)", (TIMES, WAVE, WAVE), ""),
        ("Distance (m),Mass (kg),Error (kg)", (TIMES, WAVE, WAVE), ""),
        ("Time (s),Altitude (m)", (range(40), WAVE), ""),
        ("h (cm),t (s)", (range(20, 120, 20), (0.20, 0.28, 0.35, 0.40, 0.45)), ""),
        ("Lap,Time (s)", (range(9), WAVE[:9]), ""),
        ("n,interval (s)", (range(9), 0.8 ** np.arange(9)), ""),
        ("sample,adc", (range(40), WAVE), ""),
        ("t,adc", (TIMES / 1e3, WAVE), ""),
        ("Time shift (s),Autocorrelation", (TIMES, WAVE), ""),
        ("", (np.cumsum(0.9 ** np.arange(40)), WAVE), ""),
    ],
)
def test_a_hint_is_one_that_names_units_and_times_leave_possible(refusal, header, columns, hint):
    said = refusal(table(header, *columns))
    assert "do not tell a kind" in said
    assert (f"--holds {hint}" if hint else "--holds, --column tell so") in said


def test_a_refusal_says_what_has_words_no_fitting_unit_or_uneven_times(refusal):
    said = refusal("Time (s);Force (N);y\n0.1;a 2;3\n0.2;3 N;4\n")
    assert "in line 3 the cell '3 N' is no number" in said
    said = refusal(table("a (s),b (µT)", np.arange(9), wave(9)), "--holds", "track")
    assert "by their units none of them is y or x" in said
    said = refusal(table("Count,Time", np.arange(9), np.round(np.cumsum(0.8 ** np.arange(9)), 3)))
    assert "--holds knocks --column 2=knock_time" in said


def test_doubts_are_said_as_the_interface_in_use_says_them(refusal, read):
    content = TRACK.replace(";", ",")
    python = "taken as s, m; units={'t': 'ms', 'x': 'cm', 'y': 'cm'} tells another"
    assert python in read(content, holds="track").attrs["doubt"]
    with pytest.raises(InvalidValue, match=re.escape("holds must be what a file holds")):
        read(content, holds="gold")
    assert "--run must be one of the 1" in refusal(content, "--run", "7")
    assert "--holds must be what a file holds, got 'gold'" in refusal(content, "--holds", "gold")
    assert "--column: there is no column 'z'" in refusal(content, "--column", "z=force")
    with pytest.raises(InvalidValue, match="“Run” must be one of the 1"):
        measure_record("a.csv", content.encode(), {"run": "7"})
    unknown = table("", wave(40), wave(40)[::-1], wave(40)).encode()
    with pytest.raises(InvalidValue, match="“Kind of measurement” and “Columns” tell so"):
        measure_record("a.csv", unknown, {})


def test_a_doubt_on_the_command_line_is_typed(tmp_path, capfd):
    force = np.maximum(0.0, np.sin(np.arange(400) / 20.0)) ** 2
    path = tmp_path / "a.csv"
    path.write_text(table("t,F", np.arange(400) / 1e4, np.round(force, 4)))
    assert main(["measure", str(path)]) == 0
    told = " ".join(capfd.readouterr().out.split())
    assert "taken as s, N; --unit t=ms --unit F=kN tells another" in told


@pytest.mark.parametrize("name", [*KINDS, "press-curve", "Press", "press_curve"])
def test_every_kind_that_is_offered_is_accepted(name, read):
    content = table("", np.arange(9) / 100, wave(9))
    wanted = "press curve" if name.casefold().startswith("press") else name
    assert read(content, holds=name).attrs["holds"] == wanted


def test_a_column_with_the_name_of_a_role_can_have_any_other_name(read):
    data = read(table("time,x,y", range(9), wave(9), wave(9)), names={"x": "aside"})
    assert list(data.data_vars) == ["x", "y", "aside"]


def test_a_named_time_and_a_named_channel_come_before_those_of_the_header(read):
    content = table("time,CH1,CH2,t2", range(9), wave(9), wave(9) + 5, np.arange(9) / 1e3)
    data = read(content, names={"t2": "time", "CH2": "voltage"})
    assert float(data.time[-1]) == 8e-3
    assert float(data.voltage[0]) == 7.0
    assert float(data.voltage_2[0]) == 2.0


@pytest.mark.parametrize("head", ["bounce", "Bounce", "impact", "event"])
def test_a_column_that_counts_bounces_is_no_time_of_them(refusal, read, head):
    counts = range(1, 10)
    assert f"{head!r} (1, 2, 3)" in refusal(table(f"{head},e", counts, wave(9)))
    assert f"{head!r} (1, 2, 3)" in refusal(table(head, counts))
    (found,) = sb.measure.analyse(read(table(f"{head},height (m)", counts, 0.5 ** np.arange(9))))
    assert found.restitutions[0].nominal_value == pytest.approx(0.5**0.5)
    assert read(table(f"{head} (s),e", counts, wave(9))).attrs["holds"] == "knocks"


def test_a_bug_of_an_analysis_is_no_refusal_and_is_logged_with_its_cause(monkeypatch, caplog):
    def broken(*_, **__):
        raise np.linalg.LinAlgError("SVD did not converge")

    monkeypatch.setattr(measurement, "analyse", broken)
    content = table("time (s),force (N)", np.arange(9) / 100, wave(9)).encode()
    with pytest.raises(np.linalg.LinAlgError, match="SVD"):
        measurement.measure_file(("a.csv", content), {})
    (record,) = caplog.records
    assert record.getMessage() == "the analysis of a.csv as waveform has a bug"
    assert "broken" in caplog.text
