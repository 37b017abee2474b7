"""Numbers near the ends of their range: their squares and ratios overflowed in analyses."""

import numpy as np
import pytest
from uncertainties import ufloat

from stackbounce.cli import main
from stackbounce.measure import read
from stackbounce.measure.kinds.bounces.restitution_law import laws_of


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


@pytest.mark.parametrize("missing", ["1e300", "-1.23456789E-300", "inf"])
def test_what_programs_write_for_a_missing_number_is_none(tmp_path, missing):
    path = tmp_path / "scope.csv"
    path.write_text(
        "time (s),force (N)\n" + "".join(f"{k},{k * 0.5}\n" for k in range(9)) + f"9,{missing}\n"
    )
    force = read(path).force.values
    assert force[:9].tolist() == [k * 0.5 for k in range(9)]
    assert not np.isfinite(force[9:]).any()


def test_speeds_far_from_one_metre_per_second_have_no_power_law():
    speeds = [ufloat(one, 1e-6) for one in (0.0200, 0.0202, 0.0205, 0.0208)]
    kept = [ufloat(0.5 * (one.nominal_value / 0.02) ** 50, 1e-4) for one in speeds]
    assert [law.form for law in laws_of(speeds, kept)[1]] == ["linear"]
    near = [50.0 * one for one in speeds]
    assert [law.form for law in laws_of(near, kept)[1]] == ["linear", "power law"]
