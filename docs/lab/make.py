"""Write the files of `lab.md`: `python docs/lab/make.py FOLDER`. Each is made by the simulator.

A tennis ball and a basketball, with the paper's masses: what a phone, a video and a sensor would
record of them, with noise.
"""

import sys
import wave
from pathlib import Path

import numpy as np

import stackbounce as sb
from synthetic import press, sound, track, waveform
from synthetic.falls import falls

TENNIS, BASKETBALL = sb.Ball(0.057, 0.066, "tennis"), sb.Ball(0.150, 0.160, "basketball")
TENNIS_LAW = sb.Hysteretic(2.25e4, restitution=0.75)
BASKETBALL_LAW = sb.Hysteretic(2.5e3, restitution=0.77)
HEIGHT = 1.0  # m


def bounces(path, law, seed):
    """Write a recording of a bouncing ball: 16 bit, 11025 Hz."""
    data = sound.sound(falls(HEIGHT, law, bounces=7), rate=11025.0, seed=seed)
    with wave.open(str(path), "wb") as file:
        file.setparams((1, 2, 11025, 0, "NONE", "NONE"))
        file.writeframes(np.round(data.sound.values * 32767.0).astype("<i2").tobytes())


def force(path):
    """Write what an oscilloscope records of a piezo disk under a tennis ball that lands on it."""
    drop = sb.Drop([TENNIS], [TENNIS_LAW], height=HEIGHT)
    data = waveform.waveform(drop, rate=50e3, noise=0.01, sensitivity=0.02, seed=3)
    rows = np.column_stack([data.time.values * 1e3, data.voltage.values])
    head = "Time,Channel A\n(ms),(V)\n\n"
    path.write_text(head + "".join(f"{t:.5f},{u:.6f}\n" for t, u in rows), encoding="ascii")


def video(path):
    """Write the two tracks of a tennis ball that falls on top of a basketball."""
    between = sb.Hysteretic(1e3, restitution=0.9)
    drop = sb.Drop([BASKETBALL, TENNIS], [BASKETBALL_LAW, between], height=HEIGHT, gravity=9.80665)
    data = track.track(sb.simulate(drop, until=0.6), frame_rate=240.0, noise=1e-3, seed=4)
    lines = ["#multi:", ",basketball,,tennis,,", "t,x,y,x,y,"]
    for i, t in enumerate(data.time.values):
        cells = [f"{t:.6E}"]
        for ball in range(2):
            xy = (float(data[name].values[i, ball]) for name in "xy")
            cells += ["" if np.isnan(value) else f"{value:.6E}" for value in xy]
        lines.append(",".join(cells) + ",")
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def pressed(path):
    """Write what a materials testing machine records of a basketball."""
    data = press.press_record(BASKETBALL_LAW, peak=0.012, points=300, noise=0.05, seed=5)
    rows = np.column_stack([data.compression.values * 1e3, data.force.values])
    lines = "".join(f"{c:.4f},{f:.3f}\n" for c, f in rows)
    path.write_text("Compression (mm),Force (N)\n" + lines, encoding="ascii")


FILES = {
    "tennis.wav": lambda path: bounces(path, TENNIS_LAW, 1),
    "tennis-force.csv": force,
    "basketball.wav": lambda path: bounces(path, BASKETBALL_LAW, 2),
    "basketball-press.csv": pressed,
    "stack-video.txt": video,
}


def main(folder):
    """Write all files."""
    for name, write in FILES.items():
        write(Path(folder) / name)


if __name__ == "__main__":
    main(sys.argv[1])
