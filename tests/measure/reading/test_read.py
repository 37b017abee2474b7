"""Each layout is read back: what it holds, all its values, its units."""

import numpy as np
import pytest

import stackbounce as sb
from measure import make_files as made
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


SEPARATORS = pytest.mark.parametrize(
    ("delimiter", "decimal"), made.VARIANTS.values(), ids=made.VARIANTS.keys()
)


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


def test_tracker_says_that_it_has_no_units_and_can_be_told(read):
    assert "taken as m" in read(made.tracker_two()).attrs["doubt"]
    told = read(made.tracker_two(), units={"x": "cm", "y": "cm"})
    assert told.attrs["doubt"] == ""
    same(told.y[:, 0], made.FALL / 100.0)


@SEPARATORS
def test_phyphox_collision(read, delimiter, decimal):
    names, cells = made.energy()
    for content in (
        made.phyphox_collision(6, delimiter, decimal),
        made.phyphox_csv(names, cells, delimiter, decimal),
    ):
        data = read(content)
        units = {"knock_time": "s", "height": "m", "energy": "1"}
        check(data, "bounces", "phyphox: (in)elastic collision", units)
        same(data.knock_time, made.KNOCKS)
        flights = 9.81 * np.diff(made.KNOCKS) ** 2 / 8.0
        same(data.height[1:], flights, 1e-8)
        same(data.energy[1:], flights / flights[0], 1e-8)
        assert data.height[0] > data.height[1]
        assert "not measured" in data.attrs["doubt"]


@pytest.mark.parametrize("heard", [1, 2, 3, 5])
def test_phyphox_collision_of_fewer_knocks_keeps_only_what_was_heard(read, heard):
    data = read(made.phyphox_collision(heard))
    same(data.knock_time, made.KNOCKS[:heard])
    assert data.sizes == {"knock": heard, "bounce": heard}
    assert np.isfinite(data.height[1:]).all()
    assert np.isfinite(data.height[0]) == (heard > 2)


def test_phyphox_collision_without_a_knock(read):
    names, cells = made.energy()
    nothing = [[0.0] for _ in cells]
    with pytest.raises(FileError, match="heard no knock"):
        read(made.phyphox_csv(names, nothing))


@SEPARATORS
def test_phyphox_stopwatch(read, delimiter, decimal):
    data = read(made.phyphox_stopwatch(delimiter, decimal))
    check(data, "knocks", "phyphox: acoustic stopwatch", {"knock_time": "s", "interval": "s"})
    same(data.knock_time, made.KNOCKS, 1e-9)
    same(data.interval[1:], np.diff(made.KNOCKS), 1e-8)


@SEPARATORS
def test_phyphox_scope(read, delimiter, decimal):
    data = read(made.phyphox_scope(delimiter, decimal))
    check(data, "sound", "phyphox: audio scope", {"sound": "1"})
    same(data.time, made.TIMES)
    same(data.sound, np.round(made.VOLTS / 2.0, 6))
    assert data.sound.attrs["rate"] == pytest.approx(1e4)


@SEPARATORS
@pytest.mark.parametrize("linear", ["", "Linear "])
def test_phyphox_acceleration(read, delimiter, decimal, linear):
    data = read(made.phyphox_acceleration(linear, delimiter, decimal))
    axes = [f"acceleration_{axis}" for axis in ("x", "y", "z", "absolute")]
    form = f"phyphox: acceleration {'without' if linear else 'with'} g"
    check(data, "acceleration", form, dict.fromkeys(axes, "m/s^2"))
    same(data.acceleration_y, 0.2 * made.PULSE, 1e-9)
    same(data.acceleration_absolute, np.sqrt(0.14) * made.PULSE, 1e-9)


@pytest.mark.parametrize("style", made.VERNIER)
def test_vernier(read, style):
    data = read(made.vernier(style))
    if style == "run":
        check(data, "track", "Vernier", {"x": "m", "y": "m"})
        same(data.y[:, 0], made.FALL)
        assert np.isnan(data.x).all()
        assert "taken as the height" in data.attrs["doubt"]
    else:
        check(data, "waveform", "Vernier", {"force": "N"})
        same(data.force, made.PULSE, 1e-5)
        assert data.attrs["doubt"] == ""


def test_logger_pro(read):
    data = read(made.logger_pro())
    check(data, "waveform", "Logger Pro", {"force": "N"})
    same(data.time, made.TIMES, 1e-6)
    same(data.force, made.PULSE, 1e-6)
    assert data.force.attrs["long_name"] == "Force"


@pytest.mark.parametrize("preamble", ["", "A lab\nof springs;with a remark\n\n"])
@pytest.mark.parametrize(("delimiter", "decimal"), [(",", "."), (";", ","), ("\t", ".")])
def test_capstone(read, preamble, delimiter, decimal):
    content = made.capstone(delimiter, decimal, preamble)
    first = read(content)
    check(first, "waveform", "PASCO Capstone", {"force": "N"})
    same(first.force, made.PULSE, 1e-6)
    assert "2 runs" in first.attrs["doubt"]
    for run in ("Run #2", "run #2", 2, "2"):
        second = read(content, run=run)
        same(second.force, 0.5 * made.PULSE[:25], 1e-6)
        assert second.attrs["doubt"] == ""
    with pytest.raises(InvalidValue, match="run must be one that is there, got 'Run #3'"):
        read(content, run="Run #3")


def test_rigol(read):
    data = read(made.rigol())
    check(data, "waveform", "Rigol oscilloscope", {"voltage": "V", "voltage_2": "V"})
    same(data.time, -5.999998e-02 + 2e-5 * np.arange(40))
    same(data.voltage_2, -made.VOLTS, 1e-6)


@pytest.mark.parametrize(
    ("units", "size"), [("(ms),(V)", (1e3, 1.0)), ("(us),(mV)", (1e6, 1e3)), ("(s),(V)", (1, 1))]
)
def test_picoscope(read, units, size):
    data = read(made.picoscope(units, size))
    check(data, "waveform", "PicoScope", {"voltage": "V"})
    same(data.time, made.TIMES, 1e-9)
    same(data.voltage, made.VOLTS)


def test_picoscope_beyond_its_range(read):
    highest = f",{made.VOLTS.max():.8f}".encode()
    data = read(made.picoscope().replace(highest, ",∞".encode()))
    assert np.isnan(data.voltage.values).nonzero()[0].tolist() == [np.argmax(made.VOLTS)]
    assert "1 numbers are infinite" in data.attrs["doubt"]


@pytest.mark.parametrize(("maker", "name"), [("tek_mdo", "MDO"), ("tek_tds", "TDS2000")])
def test_tektronix(read, maker, name):
    data = read(getattr(made, maker)())
    check(data, "waveform", f"Tektronix {name} oscilloscope", {"voltage": "V"})
    same(data.time, made.TIMES - 1e-3)
    np.testing.assert_allclose(data.voltage, made.VOLTS, atol=1e-5)


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
    header = f"Compression (mm){delimiter}Force (N)"
    data = read(made.press(header, delimiter))
    check(data, "press curve", "table of numbers", {"compression": "m", "force": "N"})
    same(data.compression, made.PRESSED / 1000.0, 1e-5)
    same(data.force, made.LOAD, 1e-4)
    turned = read(made.press("Load [kN],Crosshead extension [mm]"))
    same(turned.force, made.PRESSED * 1000.0, 1e-5)


def test_press_curve_without_units(read):
    data = read(made.press("Compression,Force"))
    assert "taken as m, N" in data.attrs["doubt"]
    told = read(made.press("Compression,Force"), units={"Compression": "mm", 2: "kN"})
    assert told.attrs["doubt"] == ""
    same(told.compression, made.PRESSED / 1000.0, 1e-5)
    same(told.force, made.LOAD * 1000.0, 1e-4)


def test_a_press_that_tells_times_too(read):
    data = read("Time (s),Extension (mm),Load (N)\n0,0,0\n1,0.5,3\n2,1,6\n")
    check(data, "press curve", "table of numbers", {"time": "s", "compression": "m", "force": "N"})


def test_no_header(read):
    content = made.rows([made.TIMES**2, made.PULSE])
    data = read(content)
    check(data, "table", "table of numbers", {"column_1": "", "column_2": ""})
    assert "names={1: 'time', 2: 'force'}" in data.attrs["doubt"]
    told = read(content, names={1: "time", "2": "force"}, units={1: "ms"})
    assert told.attrs["holds"] == "waveform"
    same(told.time, made.TIMES**2 / 1000.0, 1e-6)
    meant = read(content, holds="press curve")
    assert set(meant.data_vars) == {"force", "compression"}


def test_names_that_are_told(read):
    data = read("a,b,c\n0,1,2\n1,2,3\n", names={"a": "time", "c": "y"}, units={"c": "cm"})
    assert data.attrs["holds"] == "track"
    same(data.y[:, 0], [0.02, 0.03])
    assert set(data.data_vars) == {"x", "y", "b"}


def test_every_file_is_read_without_being_told_anything(tmp_path):
    made.main(tmp_path)
    for name in made.MAKERS:
        data = sb.read(tmp_path / name)
        assert data.attrs["holds"] != "table", name
        assert data.attrs["source"] == name


@pytest.mark.parametrize(("options", "error", "message"), [
    ({"holds": "sand"}, InvalidValue, "holds must be what a file holds, got 'sand'; did you mean"),
    ({"holds": "track"}, InvalidValue, "a track needs columns of time and y or x; it has t"),
    ({"holds": "acceleration"}, InvalidValue, "an acceleration needs columns"),
    ({"holds": "bounces"}, InvalidValue, "only phyphox's"),
    ({"holds": 3}, InvalidValue, "holds must be what"),
    ({"names": {"z": "force"}}, InvalidValue, "names: there is no column 'z'; known: t "),
    ({"names": {3: "force"}}, InvalidValue, "names: there is no column 3"),
    ({"names": {"t": "a b"}}, InvalidValue, "names: 'a b' is no name"),
    ({"names": "t"}, InvalidType, "names must be a mapping"),
    ({"names": {1.5: "x"}}, InvalidType, "names must map columns to text"),
    ({"names": {1: 2}}, InvalidType, "names must map columns to text"),
    ({"units": {"t": "px"}}, InvalidValue, "units: 'px' is no unit that is known"),
    ({"units": {"t": 3}}, InvalidType, "units must map columns to text"),
    ({"table": "x"}, InvalidValue, "table: there is one only"),
    ({"table": 3}, InvalidType, "table must be a name"),
    ({"run": 2}, InvalidValue, "run must be one of the 1 that there are, got 2"),
    ({"run": True}, InvalidType, "run must be a name or a number"),
    ({"decimal": ";"}, InvalidValue, "decimal must be"),
    ({"decimal": 1}, InvalidType, "decimal must be"),
])  # fmt: skip
def test_options_that_make_no_sense(read, options, error, message):
    with pytest.raises(error) as caught:
        read(made.force_ms(), **options)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)
