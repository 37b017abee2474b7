"""Measurements in which something was wrong."""

import asyncio
import dataclasses
import sys
from pathlib import Path

import numpy as np
import pytest
from uncertainties import ufloat

import stackbounce as sb
from stackbounce import errors, measure
from stackbounce.cli import main
from stackbounce.explorer import LIMITS
from stackbounce.explorer.answers.records import measure_record
from stackbounce.explorer.workers import Workers
from stackbounce.measure import analyse
from stackbounce.measure.kinds.bounces.restitution_law import laws_of

# --- masked numbers were taken as numbers: a prediction from draws gave 6 ± 26 m/s for 6.3 ± 0.05
MASKED = np.ma.array([0.1, 9.0, 0.2] * 100, mask=[False, True, False] * 100)
TIMES = np.linspace(0.0, 1.0, 300)
DROP = sb.Drop([sb.Ball(0.1), sb.Ball(0.05)], [sb.Spring(1e4)] * 2, height=0.6, gravity=9.81)
USES = {
    "sample": lambda values: sb.simulate(DROP).sample(values),
    "sweep": lambda values: sb.sweep(DROP, {"gaps.0": values}),
    "sweep of pairs": lambda values: sb.sweep(DROP, {"gaps.0": ("row", values)}),
    "sweep of a list": lambda values: sb.sweep(DROP, {"gaps.0": list(values)}),
    "predict": lambda values: sb.predict(DROP, {"height": values}),
    "fit": lambda values: sb.fit(
        DROP, {"force.0": (TIMES, values)}, {"contacts.0.stiffness": None}
    ),
    "waveform": lambda values: measure.waveform((TIMES, values)),
    "waveform in one array": lambda values: measure.waveform(np.ma.array([TIMES, values])),
    "press": lambda values: measure.press((values, TIMES)),
    "track": lambda values: measure.track((TIMES, values)),
    "accelerometer": lambda values: measure.accelerometer((TIMES, values)),
    "bounces": measure.bounces,
    "heights": lambda values: measure.heights(1.0, values),
    "knocks": lambda values: measure.knocks(values, rate=44100.0),
    "velocities": lambda values: sb.Drop(
        [sb.Ball(0.1)] * 300, [sb.Spring(1e4)] * 300, velocities=values
    ),
}


@pytest.mark.parametrize("use", USES.values(), ids=USES)
def test_a_masked_number_is_refused(use):
    with pytest.raises(
        errors.InvalidType, match=r"masked$|no masked numbers, got .*leave them out$"
    ):
        use(MASKED)


def test_an_array_that_masks_nothing_is_one_of_numbers():
    values = np.ma.array([0.1, 0.2])
    assert sb.sweep(DROP, {"gaps.0": values}).equals(sb.sweep(DROP, {"gaps.0": values.data}))


# --- numbers near the ends of their range: their squares and ratios overflowed in analyses
@pytest.mark.parametrize(
    ("text", "options"),
    [
        ("0\n1e-300\n-\n9999999999999999999999999\n", ("--holds", "knocks")),
        ("9999999999999999999999999,y\n1,1e-300,\n1e300,1,5", ()),
        ("time,sound\n" + "\n".join(f"{k}e-302,{k % 7}" for k in range(110)), ("--holds", "sound")),
        ("TekID\nModel\nRecord Length,2\nTIME,CH1\n0,1\n1e-3,2\n2e-3,3\n", ("--run", "2")),
        ("Memory Length,9\nSampling Period,1\nMode\nWaveform Data\n0,1\n1,2\n", ()),
    ],
)
def test_results_or_one_line(tmp_path, capfd, text, options):
    path = tmp_path / "changed.csv"
    path.write_text(text)
    code = main(["measure", str(path), *options])
    assert (code, capfd.readouterr().err.count("\n")) in {(0, 0), (2, 1)}


@pytest.mark.parametrize(
    "arguments",
    [
        ("--heights", "1, 0.5 ± 1e308 m"),
        ("--heights", "1e308, 0.5 m"),
        ("--heights", "1, 0.6 m", "--height-error", "1e308m"),
        ("--heights", "1, 0.6 m", "--mass", "57 ± 1e308 g"),
        ("--contact-time", "5 ms", "--mass", "1e300 ± 1e99", "--restitution", "0.75 ± 0.01",
         "--law", "hysteretic"),
    ],
)  # fmt: skip
def test_typed_numbers_are_refused_in_one_line(arguments, capfd):
    assert main(["measure", *arguments]) == 2
    err = capfd.readouterr().err
    assert err.count("\n") == 1
    assert "unexpected" not in err


def test_speeds_far_from_one_metre_per_second_have_no_power_law():
    speeds = [ufloat(one, 1e-6) for one in (0.0200, 0.0202, 0.0205, 0.0208)]
    kept = [ufloat(0.5 * (one.nominal_value / 0.02) ** 50, 1e-4) for one in speeds]
    assert [law.form for law in laws_of(speeds, kept)[1]] == ["linear"]
    near = [50.0 * one for one in speeds]
    assert [law.form for law in laws_of(near, kept)[1]] == ["linear", "power law"]


# --- covariances were summed over a set, so that the last bits differed from run to run
LAB = Path(__file__).parents[2] / "docs" / "lab"


def bits():
    """Return all numbers of an analysis, with fresh objects at other addresses."""
    found, *_ = analyse(sb.read(LAB / "basketball.wav"))
    rows = [row.value for row in found.rows()]
    return [(one.nominal_value, one.std_dev) for one in rows if hasattr(one, "std_dev")]


def test_a_recording_gives_the_same_bits_again():
    first, kept = bits(), []
    for count in range(5):
        kept.append([object() for _ in range(1000 * count)])
        assert bits() == first


# --- the first press curve or sound in a fresh process of the server took seconds, for imports
def imported_for(name):
    """Return the libraries, but for this package, that a file makes a process import."""
    before = set(sys.modules)
    measure_record(name, (LAB / name).read_bytes(), {"mass": "57 g"})
    return {one for one in set(sys.modules) - before if not one.startswith("stackbounce.")}


@pytest.mark.slow
def test_a_process_has_imported_what_measures_before_its_first_job():
    workers = Workers(dataclasses.replace(LIMITS, workers=1))

    async def run():
        workers.start()
        for name in ("basketball-press.csv", "tennis.wav", "stack-video.txt"):
            assert await workers.run(imported_for, name, seconds=300.0) <= {"uncertainties.umath"}

    try:
        asyncio.run(run())
    finally:
        workers.stop()
