"""Each layout is read back: what it holds, all its values, its units."""

import numpy as np
import pytest

from measure import make_files as made
from refusals import refusal
from stackbounce.errors import FileError, InvalidType, InvalidValue


def same(got, wanted, tolerance=1e-12):
    np.testing.assert_allclose(got, wanted, rtol=tolerance, atol=1e-15)


def check(data, holds, form, units):
    assert data.attrs["holds"] == holds
    assert data.attrs["format"] == form
    assert data.attrs["why"]
    assert data.attrs["source"] == "some file"
    assert {name: data[name].attrs["units"] for name in data.data_vars} == units
    assert all(data[name].attrs["long_name"] for name in data.data_vars)
    if "time" in data.coords:
        assert data.time.attrs["units"] == "s"


SEPARATORS = pytest.mark.parametrize(("delimiter", "decimal"), made.VARIANTS.values())


@pytest.mark.parametrize(("delimiter", "decimal"), [*made.VARIANTS.values(), (" ", ".")])
def test_tracker(read, delimiter, decimal):
    one = read(made.tracker_one(delimiter, decimal))
    check(one, "track", "Tracker", {"x": "m", "y": "m"})
    assert one.track.values.tolist() == ["mass_A"]
    same(one.time, made.FRAMES, 1e-6)
    same(one.x[:, 0], made.AWAY, 1e-6)
    same(one.y[:, 0], made.FALL, 1e-6)
    if delimiter != " ":
        two = read(made.tracker_two(delimiter, decimal))
        assert two.track.values.tolist() == ["mass A", "mass B"]
        same(two.y[:, 0], made.FALL)
        assert np.isnan(two.y[:5, 1]).all()
        same(two.y[5:, 1], made.FALL[5:] + 0.1)


def test_tracker_says_that_it_has_no_units(read):
    assert "taken as m" in read(made.tracker_two()).attrs["doubt"]
    assert read(made.tracker_two(), units={"x": "cm", "y": "cm"}).attrs["doubt"] == ""


@SEPARATORS
def test_phyphox_collision(read, delimiter, decimal):
    names, cells = made.energy()
    for content in (
        made.phyphox_collision(6, delimiter, decimal),
        made.phyphox_csv(names, cells, delimiter, decimal),
    ):
        data = read(content)
        check(data, "knocks", "phyphox: (in)elastic collision", {"knock_time": "s"})
        same(data.knock_time, made.KNOCKS)
        assert data.attrs["doubt"] == ""


@pytest.mark.parametrize("heard", [1, 2, 3, 5])
def test_phyphox_collision_of_fewer_knocks_keeps_only_what_was_heard(read, heard):
    same(read(made.phyphox_collision(heard)).knock_time, made.KNOCKS[:heard])
    names, cells = made.energy()
    with pytest.raises(FileError, match="heard no knock"):
        read(made.phyphox_csv(names, [[0.0] for _ in cells]))


@SEPARATORS
@pytest.mark.parametrize("linear", ["", "Linear "])
def test_phyphox_acceleration(read, delimiter, decimal, linear):
    data = read(made.phyphox_acceleration(linear, delimiter, decimal))
    axes = [f"acceleration_{axis}" for axis in ("x", "y", "z", "absolute")]
    check(data, "acceleration", "phyphox", dict.fromkeys(axes, "m/s^2"))
    assert all(data[axis].attrs["long_name"].startswith(linear or "A") for axis in axes[:3])
    same(data.acceleration_y, 0.2 * made.PULSE, 1e-9)
    same(data.acceleration_absolute, np.sqrt(0.14) * made.PULSE, 1e-9)


@pytest.mark.parametrize("style", made.VERNIER)
def test_vernier(read, style):
    data = read(made.vernier(style))
    if style == "run":
        check(data, "track", "table of numbers", {"x": "m", "y": "m"})
        same(data.y[:, 0], made.FALL)
        assert np.isnan(data.x).all()
        assert "taken as the height" in data.attrs["doubt"]
    else:
        check(data, "waveform", "table of numbers", {"force": "N"})
        same(data.force, made.PULSE, 1e-5)
        assert data.attrs["doubt"] == ""


@pytest.mark.parametrize("preamble", ["", "A lab\nof springs;with a remark\n\n"])
@pytest.mark.parametrize(("delimiter", "decimal"), [(",", "."), (";", ","), ("\t", ".")])
def test_capstone(read, preamble, delimiter, decimal):
    content = made.capstone(delimiter, decimal, preamble)
    first = read(content)
    check(first, "waveform", "table of numbers", {"force": "N"})
    same(first.force, made.PULSE, 1e-6)
    assert "2 runs" in first.attrs["doubt"]
    for run in ("Run #2", "run #2", 2, "2"):
        second = read(content, run=run)
        same(second.force, 0.5 * made.PULSE[:25], 1e-6)
        assert second.attrs["doubt"] == ""
    with pytest.raises(InvalidValue, match="run must be one that is there, got 'Run #3'"):
        read(content, run="Run #3")


@pytest.mark.parametrize(
    ("units", "size"), [("(ms),(V)", (1e3, 1.0)), ("(us),(mV)", (1e6, 1e3)), ("(s),(V)", (1, 1))]
)
def test_picoscope(read, units, size):
    data = read(made.picoscope(units, size))
    check(data, "waveform", "table of numbers", {"voltage": "V"})
    same(data.time, made.TIMES, 1e-9)
    same(data.voltage, made.VOLTS)


def test_picoscope_beyond_its_range(read):
    highest = f",{made.VOLTS.max():.8f}".encode()
    data = read(made.picoscope().replace(highest, ",∞".encode()))
    assert np.isnan(data.voltage.values).nonzero()[0].tolist() == [np.argmax(made.VOLTS)]
    assert "1 numbers are beyond" in data.attrs["doubt"]


@pytest.mark.parametrize("header", [
    "Time (ms),Force (N)", "t [ms],Force / N", "time_ms,force_N", "Zeit in ms,Kraft in N",
    "# t (ms),F (N)", '"Time (ms)","Force (N)"', "time ms,force N", "t,F\nms,N", "t,F\n(ms),(N)\n",
    "a remark\n\nTime (msec),Load (newton)",
])  # fmt: skip
def test_units_in_headers(read, header):
    data = read(made.force_ms(header))
    check(data, "waveform", "table of numbers", {"force": "N"})
    assert data.attrs["doubt"] == ""
    same(data.time, made.TIMES, 1e-5)
    same(data.force, made.PULSE, 1e-5)


@pytest.mark.parametrize("delimiter", [",", "\t", ";", " "])
def test_press_curves(read, delimiter):
    data = read(made.press(f"Compression (mm){delimiter}Force (N)", delimiter))
    check(data, "press curve", "table of numbers", {"compression": "m", "force": "N"})
    same(data.compression, made.PRESSED / 1000.0, 1e-5)
    same(data.force, made.LOAD, 1e-4)


def test_press_curves_in_other_words(read):
    turned = read(made.press("Load [kN],Crosshead extension [mm]"))
    same(turned.force, made.PRESSED * 1000.0, 1e-5)
    bare = made.press("Compression,Force")
    assert "taken as m, N" in read(bare).attrs["doubt"]
    told = read(bare, units={"Compression": "mm", 2: "kN"})
    assert told.attrs["doubt"] == ""
    same(told.compression, made.PRESSED / 1000.0, 1e-5)
    same(told.force, made.LOAD * 1000.0, 1e-4)
    timed = read("Time (s),Extension (mm),Load (N)\n0,0,0\n1,0.5,3\n2,1,6\n")
    check(timed, "press curve", "table of numbers", {"time": "s", "compression": "m", "force": "N"})


def test_no_header(read):
    content = made.rows([made.TIMES**2, made.PULSE])
    data = read(content)
    check(data, "table", "table of numbers", {"column_1": "", "column_2": ""})
    assert "names={1: 'time', 2: 'force'}" in data.attrs["doubt"]
    told = read(content, names={1: "time", "2": "force"}, units={1: "ms"})
    assert told.attrs["holds"] == "waveform"
    same(told.time, made.TIMES**2 / 1000.0, 1e-6)
    assert set(read(content, holds="press curve").data_vars) == {"force", "compression"}


T, V, KNOCKS = made.TIMES, made.VOLTS, made.KNOCKS
V5 = np.array([float(f"{value:.5f}") for value in V])
RIGOL = {"time": -5.999998e-02 + 2e-5 * np.arange(40), "voltage": V, "voltage_2": -V}
STOPWATCH = {"knock_time": KNOCKS, "interval": np.diff(KNOCKS, prepend=np.nan)}
SIMPLE = {
    "phyphox": (made.phyphox_stopwatch, STOPWATCH, 1e-8),
    "table of numbers": (made.phyphox_scope, {"time": T, "sound": np.round(V / 2.0, 6)}, 1e-12),
    "Logger Pro": (made.logger_pro, {"time": T, "force": made.PULSE}, 1e-6),
    "Rigol oscilloscope": (made.rigol, RIGOL, 1e-6),
    "Tektronix MDO oscilloscope": (made.tek_mdo, {"time": T - 1e-3, "voltage": V}, 1e-6),
    "Tektronix TDS2000 oscilloscope": (made.tek_tds, {"time": T - 1e-3, "voltage": V5}, 1e-12),
}
HELD = {"knock_time": "knocks", "sound": "sound", "force": "waveform", "voltage": "waveform"}
UNITS = {"knock_time": "s", "interval": "s", "sound": "", "force": "N", "voltage": "V"}


@pytest.mark.parametrize("form", SIMPLE)
def test_simple_files(read, form):
    maker, wanted, tolerance = SIMPLE[form]
    names = [name for name in wanted if name != "time"]
    units = {name: UNITS[name.removesuffix("_2")] for name in names}
    for variant in made.VARIANTS.values() if names[0] in ("knock_time", "sound") else [()]:
        data = read(maker(*variant))
        check(data, HELD[names[0]], form, units)
        for name, values in wanted.items():
            same(data[name], values, 1e-12 if name == "time" else tolerance)


@pytest.mark.parametrize(("options", "error", "message"), [
    ({"holds": "sand"}, InvalidValue, "holds must be what a file holds, got 'sand'; did you mean"),
    ({"holds": "track"}, InvalidValue, "a track needs columns of time and y or x; it has t"),
    ({"holds": "acceleration"}, InvalidValue, "an acceleration needs columns"),
    ({"holds": 3}, InvalidValue, "holds must be what"),
    ({"names": {"z": "force"}}, InvalidValue, "names: there is no column 'z'; known: t "),
    ({"names": {3: "force"}}, InvalidValue, "names: there is no column 3"),
    ({"names": {"t": "a b"}}, InvalidValue, "such as 2=force, got 'a b'"),
    ({"names": "t"}, InvalidType, "names must be a mapping"),
    ({"names": {1.5: "x"}}, InvalidType, "names must map columns to text"),
    ({"names": {1: 2}}, InvalidType, "names must map columns to text"),
    ({"units": {"t": "px"}}, InvalidValue, "units: 'px' is no unit that is known"),
    ({"units": {"t": 3}}, InvalidType, "units must map columns to text"),
    ({"table": "x"}, InvalidValue, "table: there is one only"),
    ({"table": 3}, InvalidValue, "table: there is one only"),
    ({"run": 2}, InvalidValue, "run must be one of the 1 that there are, got 2"),
    ({"run": True}, InvalidValue, "run must be one of the 1 that there are, got True"),
    ({"decimal": ";"}, InvalidValue, "decimal must be"),
    ({"decimal": 1}, InvalidValue, "decimal must be"),
])  # fmt: skip
def test_options_that_make_no_sense(read, options, error, message):
    assert message in refusal(error, read, made.force_ms(), **options)
