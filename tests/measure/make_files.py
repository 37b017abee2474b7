"""Files as the programs of this field write them, with known numbers in them, as bytes."""

import io
import struct
import zipfile
from functools import partial

import numpy as np

TIMES = np.arange(40) * 1e-4  # s
PULSE = np.round(1500.0 * np.sin(np.pi * np.clip((TIMES - 5e-4) / 2e-3, 0.0, 1.0)), 3)  # N
VOLTS = np.round(PULSE / 1000.0, 6)  # V
FRAMES = np.arange(30) / 100.0  # s
FALL = np.round(np.maximum(1.0 - 4.903325 * FRAMES**2, 0.56), 6)  # m
AWAY = np.round(0.012 + 0.1 * FRAMES, 6)  # m
KNOCKS = np.array([0.5104, 1.1423, 1.6481, 2.0531, 2.3772, 2.6365])  # s
PRESSED = np.round(np.concatenate([np.linspace(0, 5, 21), np.linspace(5, 0.6, 18)]), 4)  # mm
LOAD = np.round(8.0 * PRESSED**1.2 * np.where(np.arange(39) < 21, 1.0, 0.8), 3)  # N
MAKERS = {}


def makes(name):
    def register(maker):
        MAKERS[name] = maker
        return maker

    return register


def rows(columns, form="{:.6E}", delimiter=",", decimal=".", end="\n"):
    """Return columns of numbers as lines; NaN is a blank cell."""
    lines = []
    for row in zip(*columns, strict=True):
        cells = ["" if value != value else form.format(value) for value in row]
        lines.append(delimiter.join(cells).replace(".", decimal) + end)
    return "".join(lines)


@makes("tracker_one.txt")
def tracker_one(delimiter="\t", decimal="."):
    head = f"mass_A\n{delimiter.join('txy')}\n"
    return (head + rows([FRAMES, AWAY, FALL], delimiter=delimiter, decimal=decimal)).encode()


@makes("tracker_two.csv")
def tracker_two(delimiter=",", decimal="."):
    head = "#multi:\n,mass A,,mass B,,\nt,x,y,x,y,\n".replace(",", delimiter)
    late = np.where(FRAMES < 0.05, np.nan, FALL + 0.1)  # the second track begins later
    columns = [FRAMES, AWAY, FALL, np.where(np.isnan(late), np.nan, AWAY), late]
    return (head + rows(columns, "{:.8E}", delimiter, decimal, delimiter + "\n")).encode()


VARIANTS = {"comma": (",", "."), "tab": ("\t", "."), "semicolon": (";", "."),
            "tab, decimal comma": ("\t", ","), "semicolon, decimal comma": (";", ",")}  # fmt: skip


def phyphox_csv(names, columns, delimiter=",", decimal="."):
    lines = [delimiter.join(f'"{name}"' for name in names)]
    for row in zip(*columns, strict=True):
        cells = ["NaN" if value != value else f"{value:.9E}" for value in row]
        lines.append(delimiter.join(cells).replace(".", decimal))
    return ("\n".join(lines) + "\n").encode()


def archive(files, method=zipfile.ZIP_DEFLATED):
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", method) as out:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name, (2024, 1, 1, 0, 0, 0))  # tests are named by the bytes
            entry.compress_type = method
            out.writestr(entry, data)
    return content.getvalue()


def phyphox_zip(tables, delimiter=",", decimal="."):
    files = {name: phyphox_csv(*table, delimiter, decimal) for name, table in tables.items()}
    device = '"property","value"\n"version","1.1.16"\n"deviceModel","Phone"\n'
    time = (
        '"event","experiment time","system time","system time text"\n'
        '"START",0.000000000E0,1704067200.000,"2024-01-01 00:00:00.000"\n'
    )
    return archive(files | {"meta/device.csv": device, "meta/time.csv": time})


def energy(heard=6):
    """Return names and numbers of Energy.csv, as phyphox computes them from the knocks heard."""
    flights = np.diff(KNOCKS)
    heights = 9.81 * flights**2 / 8.0
    kept = heights[1:] / heights[:-1]
    names, cells = ["Bounce 0 (s)", "Height 0 (m)"], [KNOCKS[0], heights[0] / kept.mean()]
    for k in range(1, 6):
        names += [f"Bounce {k} (s)", f"Height {k} (m)", f"Energy {k}"]
        late = k >= heard
        now = 9.81 * (3.0 - KNOCKS[heard - 1]) ** 2 / 8.0  # what it has of a knock still to come
        cells += [0.0, now if k == heard else 0.0, 0.7] if late else (
            [KNOCKS[k], heights[k - 1], heights[k - 1] / heights[0]]
        )  # fmt: skip
    return names, [[cell] for cell in cells]


@makes("phyphox_collision.zip")
def phyphox_collision(heard=6, delimiter=",", decimal="."):
    return phyphox_zip({"Energy.csv": energy(heard)}, delimiter, decimal)


@makes("phyphox_stopwatch.zip")
def phyphox_stopwatch(delimiter=",", decimal="."):
    columns = [KNOCKS, np.diff(KNOCKS, prepend=np.nan)]
    return phyphox_zip(
        {"Many.csv": (["Event time (s)", "Interval (s)"], columns)}, delimiter, decimal
    )


@makes("phyphox_scope.csv")
def phyphox_scope(delimiter=",", decimal="."):
    columns = [TIMES * 1000.0, np.round(VOLTS / 2.0, 6)]
    return phyphox_csv(["Time (ms)", "Recording (a.u.)"], columns, delimiter, decimal)


def acceleration(linear=""):
    parts = [0.1 * PULSE, 0.2 * PULSE, 0.3 * PULSE]
    names = [f"{linear}Acceleration {axis} (m/s^2)" for axis in "xyz"]
    return (
        ["Time (s)", *names, "Absolute acceleration (m/s^2)"],
        [TIMES, *parts, np.sqrt(sum(one**2 for one in parts))],
    )


@makes("phyphox_acceleration.zip")
def phyphox_acceleration(linear="", delimiter=",", decimal="."):
    return phyphox_zip({"Raw Data.csv": acceleration(linear)}, delimiter, decimal)


VERNIER = {
    "latest": ("Latest: Time (s)", "Latest: Force (N)"),
    "run": ("Run 1: Time (s)", "Run 1: Position (m)"),
    "data_set": ("Data Set 1:Time(s)", "Data Set 1:Force(N)"),
}


def vernier(style):
    numbers = [FRAMES, FALL] if style == "run" else [TIMES, PULSE]
    return (",".join(VERNIER[style]) + "\n" + rows(numbers, "{:.6g}")).encode()


for _style in VERNIER:
    MAKERS[f"vernier_{_style}.csv"] = partial(vernier, _style)


@makes("logger_pro.txt")
def logger_pro():
    head = "Vernier Format 2\nbounce.cmbl 1/1/2024 12:00:00 .\nRun 1\n"
    head += "Time\tForce\nt\tF\ns\tN\n\n"
    return (head + rows([TIMES, PULSE], "{:.7g}", "\t")).replace("\n", "\r\n").encode()


@makes("capstone.csv")
def capstone(delimiter=",", decimal=".", preamble=""):
    names = [f'"{name} Run #{k}"' for k in (1, 2) for name in ("Time (s)", "Fz (N)")]
    short = np.where(np.arange(40) < 25, 1.0, np.nan)  # the second run ends sooner
    columns = [TIMES, PULSE, TIMES * short, 0.5 * PULSE * short]
    head = preamble + delimiter.join(names) + "\n"
    return (head + rows(columns, "{:.7g}", delimiter, decimal)).encode("utf-8-sig")


@makes("rigol.csv")
def rigol():
    head = "X,CH1,CH2,Start,Increment,\nSequence,Volt,Volt,-5.999998e-02,2.000000e-05\n"
    lines = [f"{k},{v:.6e},{-v:.6e},,\n" for k, v in enumerate(VOLTS)]
    return (head + "".join(lines)).encode()


@makes("picoscope.csv")
def picoscope(units="(ms),(V)", size=(1e3, 1.0)):
    head = f"Time,Channel A\n{units}\n\n"
    numbers = rows([TIMES * size[0], VOLTS * size[1]], "{:.8f}", end="\r\n")
    return (head.replace("\n", "\r\n") + numbers).encode()


@makes("tek_mdo.csv")
def tek_mdo():
    head = (
        "Model,MDO3024\nFirmware Version,1.20\n\nPoint Format,Y,\nHorizontal Units,s,\n"
        "Horizontal Scale,4e-04,\nSample Interval,1e-4,\nRecord Length,40,\nProbe Attenuation,10,\n"
        "Vertical Units,V,\nVertical Scale,0.5,\n,\nLabel,,\nTIME,CH2\n"
    )
    return (head + rows([TIMES - 1e-3, VOLTS], "{:.6e}")).encode()


@makes("tek_tds.csv")
def tek_tds():
    keys = (
        "Record Length,4.000000e+01;Sample Interval,1.000000e-04;Trigger Point,1.000000000000e+01;"
        ",;,;Source,CH1;Vertical Units,V;Vertical Scale,5.000000e-01;Vertical Offset,0.000000e+00;"
        "Horizontal Units,s;Horizontal Scale,2.500000e-04;Pt Fmt,Y;Yzero,0.000000e+00;"
        "Probe Atten,1.000000e+00;Model Number,TDS2014;Firmware Version,FV:v24.26"
    ).split(";")
    keys += [","] * (len(TIMES) - len(keys))
    rows = zip(keys, TIMES - 1e-3, VOLTS, strict=True)
    return "".join(f"{pair},,{t:018.12f},{v:10.5f},\n" for pair, t, v in rows).encode()


RATE = 8000


def sound():
    """Return 0.1 s with a knock in it, of full scale 1."""
    time = np.arange(RATE // 10) / RATE
    return np.where(time < 0.02, 0.0, 0.8 * np.exp(-(time - 0.02) / 0.01) * np.cos(3000.0 * time))


def wav(bits=16, channels=1, floating=False, extensible=False, size=None):
    """Return a WAV file; with two channels the second is half as loud."""
    wave = np.stack([sound() / (1 + k) for k in range(channels)], axis=1).ravel()
    if floating:
        data = wave.astype(f"<f{bits // 8}").tobytes()
    elif bits == 8:
        data = np.round(wave * 127.0 + 128.0).astype("u1").tobytes()
    else:
        whole = np.round(wave * (2.0 ** (bits - 1) - 1.0)).astype("<i8").view("u1").reshape(-1, 8)
        data = whole[:, : bits // 8].tobytes()
    code, frame = 3 if floating else 1, channels * bits // 8
    form = struct.pack(
        "<HHIIHH", 0xFFFE if extensible else code, channels, RATE, RATE * frame, frame, bits
    )
    if extensible:
        rest = bytes.fromhex("000000001000800000aa00389b71")
        form += struct.pack("<HHIH", 22, bits, 3, code) + rest
    chunks = struct.pack("<4sI", b"fmt ", len(form)) + form
    chunks += struct.pack("<4sI", b"LIST", 5) + b"INFOx\0"  # of odd size, so padded
    chunks += struct.pack("<4sI", b"data", len(data) if size is None else size) + data
    return struct.pack("<4sI4s", b"RIFF", 4 + len(chunks), b"WAVE") + chunks


for _bits, _channels, _floating, _extensible in (
    (8, 1, False, False), (16, 1, False, False), (16, 2, False, False), (24, 1, False, False),
    (24, 2, False, True), (32, 1, False, False), (32, 2, True, False), (32, 1, True, True),
    (64, 1, True, False),
):  # fmt: skip
    _name = f"wav_{_bits}{'f' if _floating else ''}_{_channels}{'_ext' if _extensible else ''}.wav"
    MAKERS[_name] = partial(wav, _bits, _channels, _floating, _extensible)


@makes("force_ms.csv")
def force_ms(header="t [ms],Force / N"):
    return (header + "\n" + rows([TIMES * 1000.0, PULSE], "{:.6g}")).encode()


@makes("press.csv")
def press(header="Compression (mm),Force (N)", delimiter=","):
    return (header + "\n" + rows([PRESSED, LOAD], "{:g}", delimiter)).encode()


def main(folder):
    folder.mkdir(parents=True, exist_ok=True)
    for name, maker in MAKERS.items():
        (folder / name).write_bytes(maker())
