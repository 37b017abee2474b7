"""Tables as programs write them that people use: each in a few lines, with known numbers."""

import numpy as np
import pytest

from measure.make_files import rows as lines
from stackbounce.errors import FileError

STEP = 1e-4  # s
TIMES = STEP * np.arange(60)
VOLTS = np.round(np.where((TIMES > 1e-3) & (TIMES < 4e-3), 1.5, 0.01 * np.sin(9e4 * TIMES)), 4)


def is_waveform(data, program, name="voltage"):
    assert (data.attrs["holds"], data.attrs["format"]) == ("waveform", program)
    np.testing.assert_allclose(data.time.values - data.time.values[0], TIMES, atol=1e-9)
    np.testing.assert_allclose(data[name].values, VOLTS, atol=1e-6)
    assert data[name].attrs["units"] == "V"
    assert data.attrs["doubt"] == ""


def test_a_rigol_without_times_has_them_from_start_and_increment(read):
    head = f"CH1,CH2,Start,Increment,\nVolt,Volt,-2.000000e-03,{STEP:e},\n"
    data = read(head + lines([VOLTS, -VOLTS], end=",\n"))
    is_waveform(data, "Rigol oscilloscope")
    assert data.time.values[0] == -2e-3
    np.testing.assert_allclose(data.voltage_2.values, -VOLTS, atol=1e-6)
    with pytest.raises(FileError, match="no start and increment"):
        read("CH1,Start,Increment\nVolt,,\n1,\n2,\n3,\n")


def test_gw_instek(read):
    keys = (
        f"Memory Length,{len(TIMES)},\nTrigger Level,1.0mV,\nSource,CH2,\nVertical Units,V,\n"
        f"Horizontal Units,S,\nSampling Period,{STEP:e},\nTime,01-Jan-24 10:00:00,\n"
    )
    rows = lines([TIMES, VOLTS], end=",\n")
    is_waveform(read(f"{keys}Mode,Detail,\nWaveform Data,\n{rows}"), "GW Instek oscilloscope")
    with pytest.raises(FileError, match="in the mode Fast"):
        read(f"{keys}Mode,Fast,\nWaveform Data,\n{rows}")
    each = ("Memory Length,60", "Source,CH1", "Vertical Units,V", "Sampling Period,1e-4")
    beside = "".join(f"{one},{one}\n" for one in each)  # two channels
    data = read(f"{beside}Waveform Data,\n" + lines([TIMES, VOLTS, TIMES, -VOLTS]))
    is_waveform(data, "GW Instek oscilloscope")
    np.testing.assert_allclose(data.voltage_2.values, -VOLTS, atol=1e-6)


def test_siglent_beside_keys_and_below_them(read):
    keys = [
        "Record Length,60,",
        "Sample Interval,CH1:1e-4 CH2:1e-4,",
        "Vertical Units,CH1:V CH2:V,",
    ]
    beside = ["Source,CH1,CH2", "Second,Volt,Volt", *lines([TIMES, VOLTS, -VOLTS]).splitlines()]
    rows = [f"{keys[k] if k < len(keys) else ',,'},{row}" for k, row in enumerate(beside)]
    data = read("\n".join(rows))
    is_waveform(data, "Siglent oscilloscope")
    np.testing.assert_allclose(data.voltage_2.values, -VOLTS, atol=1e-6)
    below = "Record Length,60\nModel Number,SDS1104X-E\nSource,CH1\nSecond,Value\n"
    is_waveform(read(below + lines([TIMES, VOLTS])), "Siglent oscilloscope")


def test_lecroy_and_its_segments(read):
    head = (
        "LECROYWS3024,0,Waveform\nSegments,2,SegmentSize,60\nSegment,TrigTime,TimeSinceSegment1\n"
        "#1,01-Jan-2024 10:00:00,0\n#2,01-Jan-2024 10:00:01,1.0\nTime,Ampl\n"
    )
    is_waveform(read(head + lines([TIMES, VOLTS])), "LeCroy oscilloscope")
    two = read(head + lines([TIMES, VOLTS]) + lines([TIMES, 2.0 * VOLTS]), run=2)
    np.testing.assert_allclose(two.voltage.values, 2.0 * VOLTS, atol=1e-6)


@pytest.mark.parametrize(
    "head", ["Time [s],Channel 0", "Time[s], Channel 0", "sec,Volt1", "x-axis,1\nsecond,Volt"]
)
def test_saleae_and_keysight_by_their_headers(read, head):
    data = read(f"{head}\n" + lines([TIMES, VOLTS]))
    np.testing.assert_allclose(data.voltage.values, VOLTS, atol=1e-6)
    assert data.attrs["holds"] == "waveform"
    assert data.voltage.attrs["units"] == ("V" if "Volt" in head else "")


@pytest.mark.parametrize("decimal", [".", ","])
@pytest.mark.parametrize("timed", [True, False], ids=["times", "step"])
def test_labview(read, timed, decimal):
    head = (
        "LabVIEW Measurement\t\nSeparator\tTab\nDecimal_Separator\t.\nX_Columns\tOne\n"
        "***End_of_Header***\t\n\t\nChannels\t1\nSamples\t60\nY_Unit_Label\tVolts\n"
        "X_Dimension\tTime\nX0\t0.0000000000000000E+0\nDelta_X\t1.000000E-4\n"
        "***End_of_Header***\t\nX_Value\tVoltage_0\tComment\n"
    )
    rows = lines([TIMES, VOLTS], delimiter="\t") if timed else lines([VOLTS], form="\t{:.6e}")
    is_waveform(read((head + rows).replace(".", decimal), "file.lvm"), "LabVIEW")
    with pytest.raises(FileError, match="without their step"):
        read("LabVIEW Measurement\nX_Dimension\tTime\nX_Value\tVoltage\n\t1\n\t2\n")


def test_pasco_with_automatic_times_and_decimal_commas(read):
    head = "Time (s) Auto;Force (N) Run #1\n"
    data = read(head + "0;-7,10E-15\n0,05;0\n0,1;0,5\n0,15;0,25\n")
    assert data.time.values.tolist() == [0.0, 0.05, 0.1, 0.15]
    assert data.force.values[1:].tolist() == [0.0, 0.5, 0.25]
    assert data.time.attrs["long_name"] == "Time (s) Auto"


def test_avimeca_with_its_line_of_units(read):
    table = "\nt;x;y\n(ms);(cm);(cm)\n0;0;0,5\n40;4,5;0,25\n"
    data = read("Pointages Aviméca" + table)
    assert data.attrs["holds"] == "track"
    np.testing.assert_allclose(data.time.values, [0.0, 0.04])
    np.testing.assert_allclose(data.y.values[:, 0], [0.005, 0.0025])
    assert data.attrs["doubt"] == ""
    np.testing.assert_allclose(read("Ball" + table).time.values, [0.0, 0.04])  # not Tracker's


def test_sensor_logger_with_and_without_g_by_the_name_of_the_file(read):
    table = "time,seconds_elapsed,z,y,x\n" + "".join(
        f"{1691674088430198800 + 10**7 * k},{0.03 + 0.01 * k},{k},{2 * k},{3 * k}\n"
        for k in range(5)
    )
    plain = read(table, "Accelerometer.csv")
    assert plain.attrs["format"] == "Sensor Logger: acceleration without g"
    np.testing.assert_allclose(plain.time.values, 0.03 + 0.01 * np.arange(5))
    assert plain.acceleration_x.values.tolist() == [0.0, 3.0, 6.0, 9.0, 12.0]
    assert plain.acceleration_z.attrs["units"] == "m/s^2"
    assert "linear" in plain.acceleration_z.attrs["long_name"].casefold()
    total = read(table, "TotalAcceleration.csv")
    assert total.attrs["format"] == "Sensor Logger: acceleration with g"
    assert "linear" not in total.acceleration_z.attrs["long_name"].casefold()
    with pytest.raises(FileError, match=r"gyroscope of Sensor Logger: take its Accelerometer\.csv"):
        read(table, "Gyroscope.csv")


@pytest.mark.parametrize(
    "names",
    [
        ("X (m/s^2)", "Y (m/s^2)", "Z (m/s^2)"),
        ("Accelerometer x (m/s^2)", "Accelerometer y (m/s^2)", "Accelerometer z (m/s^2)"),
        ("Linear Accelerometer x (m/s²)", "Linear Accelerometer y (m/s²)", "acc_z (m/s²)"),
        ("ax (m/s^2)", "ay (m/s^2)", "az (m/s^2)"),
    ],
)
def test_three_axes_are_three_accelerations(read, names):
    data = read(f"Time (s),{','.join(names)}\n0,1,2,3\n0.01,1,2,3\n0.02,1,2,3\n")
    assert data.attrs["holds"] == "acceleration"
    assert [data[f"acceleration_{axis}"][0] for axis in "xyz"] == [1.0, 2.0, 3.0]


@pytest.mark.parametrize(
    ("names", "units"),
    [
        ("Tiempo;Extensión;Carga", "(s);(mm);(N)"),
        ("Tempo;Extensão;Força", "(s);(mm);(kN)"),
        ("Time;Strain gauge 7;Load", "(s);(mm);(N)"),
    ],
)
def test_millimetres_beside_newtons_are_a_press_curve_in_any_language(read, names, units):
    rows = "".join(f"{k},0;0,{k};{k},5\n" for k in range(9))
    data = read(f"{names}\n{units}\n{rows}")
    assert data.attrs["holds"] == "press curve"
    np.testing.assert_allclose(data.compression.values, 1e-4 * np.arange(9), atol=1e-12)


def test_a_position_beside_a_force_and_times_is_no_press_curve(read):
    data = read("Time (s),Force (N),Position (m)\n0,1,0.1\n0.1,2,0.2\n0.2,0,0.3\n")
    assert data.attrs["holds"] == "waveform"


def test_the_largest_component_is_the_force_of_a_contact(read):
    data = read("time,Fx,Fy,Fz\n0,1,0,-9\n0.1,2,0,-8\n0.2,0,0,-9\n")
    assert data.force.attrs["long_name"] == "Fz"


def test_bare_columns_of_a_scope(read):
    data = read(lines([TIMES, VOLTS]))
    assert data.attrs["holds"] == "waveform"
    np.testing.assert_allclose(data.voltage.values, VOLTS, atol=1e-6)
    assert "taken as time in s, the other as the voltage of a scope" in data.attrs["doubt"]


def test_bare_columns_that_may_be_anything_stay_a_table(read):
    assert read(lines([TIMES, VOLTS, VOLTS])).attrs["holds"] == "table"
    assert read(lines([TIMES**2, VOLTS])).attrs["holds"] == "table"
    drops = read(lines([np.arange(9) + 1, 0.6 ** np.arange(9), 0.6 ** np.arange(1, 10)]))
    assert drops.attrs["holds"] == "table"  # nine counted rows are no frames
    told = read(lines([TIMES, VOLTS, VOLTS]), names={1: "time", 3: "force"})
    assert told.attrs["holds"] == "waveform"


def test_bare_columns_of_a_video_are_a_track(read):
    times = 0.04 * np.arange(12)
    data = read(lines([times, times, 1.0 - times], form="{:.3f}", delimiter=" "))
    assert data.attrs["holds"] == "track"
    np.testing.assert_allclose(data.y.values[:, 0], 1.0 - times)


def test_labels_of_audacity_are_knocks_and_times_of_kinovea_have_hours(read):
    labels = "".join(f"{k + 1:.6f}\t{k + 1.2:.6f}\t{'hit' * (k % 2)}\n" for k in range(6))
    data = read(labels)
    assert (data.attrs["format"], data.attrs["holds"]) == ("Audacity: labels", "knocks")
    assert data.knock_time.values == pytest.approx(np.arange(1, 7))
    points = "".join(f"{k / 30:.6f}\t{1 + k * k / 99:.6f}\t{k:.6f}\n" for k in range(9))
    assert read(points).attrs["holds"] == "track"
    lines = "".join(f"0:00:{k / 25:05.2f} {k} {k * k}\n" for k in range(40))
    data = read(f"#Kinovea Trajectory data export\n#T X Y\n{lines}", holds="track")
    assert data.time.values == pytest.approx(np.arange(40) / 25)


@pytest.mark.parametrize(
    "names", ["Čas (s);Położenie (mm);a (m/s^2)", "Tiempo (s);Posición (m);Aceleración (m/s²)"]
)
def test_names_in_other_code_pages_and_a_computed_acceleration(read, names):
    code = "cp1250" if "Č" in names else "latin-1"
    data = read((names + "\n0;1;1\n1;2;1\n2;5;1\n").encode(code))
    assert data.attrs["holds"] == "track"
    assert f"{data.time.long_name};{data.y.long_name}" in names
