"""`stackbounce fit`: from arguments and files to tables, JSON, pictures and scenarios."""

import contextlib
import os
import re
import subprocess
import sys
from functools import partial
from pathlib import Path

import pytest

import stackbounce as sb
from stackbounce.cli import main
from stackbounce.fitting import Fit

PAIR = ("basketball", "tennis", "--height", "63cm")
MEASURED = ("--measured", "rebound_ratios.1=1.64 ± 0.02")
ONE = (*PAIR, *MEASURED, "--vary", "contacts.1.stiffness=0.7kN/m:2.5kN/m")
BALLS, SPRINGS = [sb.Ball(0.150), sb.Ball(0.057)], [sb.Spring(2500.0), sb.Spring(1000.0)]
DROP = sb.Drop(BALLS, SPRINGS, height=0.63)
ONE_BALL = """height = 1
measured.durations.0 = '5.0 ± 0.1 ms'
vary.contacts.0.stiffness = ''
[[balls]]
mass = '56.7 g'
[[contacts]]
law = 'Spring'
stiffness = 1e4
"""
TABLE = """name;height (cm);gaps.0 (mm);rebound_ratios.1
low;30;1;1,70 ± 0,02
high;63;1;1,68 ± 0,02
"""


@pytest.fixture
def fit(printed):
    return partial(printed, "fit")


@pytest.fixture
def told(told):
    return partial(told, "fit")


def cells(out, start):
    return [line.split() for line in out.splitlines() if line.split()[:1] == [start]]


def test_what_is_found_is_what_the_library_finds(told):
    found = told(*ONE)
    vary = {"contacts.1.stiffness": (700.0, 2500.0)}
    same = sb.fit(DROP, {"rebound_ratios.1": "1.64 ± 0.02"}, vary)
    (value,) = found["values"].values()
    assert value["value"] == pytest.approx(same["contacts.1.stiffness"].nominal_value, rel=1e-6)
    assert value["error"] == pytest.approx(same["contacts.1.stiffness"].std_dev, rel=1e-3)
    assert value["unit"] == "N/m"
    assert (found["intervals"], found["posterior"], found["saved"]) == (None, None, [])
    assert found["probability"] is None  # nothing is left to tell


def test_a_table_for_people(fit):
    out = fit(*ONE, "--interval")
    ((_, value, error, low, high, unit),) = cells(out, "contacts.1.stiffness")
    assert (value, error, unit) == ("1477", "55", "N/m")
    assert float(low) < float(value) < float(high)
    ((_, measured, error, best, pull),) = cells(out, "rebound_ratios.1")
    assert (measured, error, best, float(pull)) == ("1.640", "0.020", "1.640", 0.0)
    assert "0 degrees of freedom: too few data to tell whether the model is right." in out
    assert max(map(len, out.splitlines())) <= 100


def test_the_same_digits_for_a_value_and_its_limits(fit):
    """Where an interval is shorter on one side, that side says how many digits count."""
    vary = {"contacts.1.stiffness": ("0.7kN/m", "2.5kN/m")}
    found = sb.fit(DROP, {"rebound_ratios.1": "1.64 ± 0.02"}, vary, starts=16)
    low, high, *_ = found.intervals()["contacts.1.stiffness"]
    out = fit(*ONE, "--interval", "--starts", "16")
    ((*_, shown_low, shown_high, _),) = cells(out, "contacts.1.stiffness")
    assert (shown_low, shown_high) == (f"{low:.0f}", f"{high:.0f}")


def test_notes_and_handy_units(fit):
    out = fit(
        *PAIR,
        *("--measured", "rebound_ratios.1=1.90 ± 0.01", "--measured", "rebound_ratios.0=.1 ± .01"),
        *("--measured", "first_touch.1=1.5 ± 0.1 ms", "--measured", "collisions.1=3"),
        *("--vary", "contacts.1.stiffness=0.7kN/m:2.5kN/m", "--vary", "gaps.0=0mm:5mm"),
    )
    assert cells(out, "first_touch.1")[0][1:3] == ["1.50", "0.10"]
    assert cells(out, "first_touch.1")[0][-1] == "ms"
    assert cells(out, "gaps.0")[0][-1] in ("mm", "µm")
    text = " ".join(out.split())
    assert "Note: the model does not describe the data: chi squared is" in text
    assert "Note: collisions.1: 3 seen, 1 in the fit." in text


def test_strong_correlations_are_told(fit, told):
    asked = (*ONE, "--vary", "gaps.0=1.3 ± 0.9 mm")
    out = fit(*asked)
    (_, correlation), _ = told(*asked)["correlations"]
    assert abs(correlation) > 0.5
    words = f"Correlations: contacts.1.stiffness and gaps.0 {correlation:+.2f}"
    assert words in " ".join(out.split())


def test_a_drop_that_is_saved_does_what_was_measured_and_is_drawn(fit, tmp_path):
    out = fit(*ONE, "--save", "fitted.toml", "--plot", "fit.svg")
    assert "Picture: fit.svg" in out
    assert (tmp_path / "fit.svg").stat().st_size > 10_000
    assert "Fitted: fitted.toml; now: stackbounce simulate fitted.toml" in out
    result = sb.simulate(sb.Drop.from_toml(tmp_path / "fitted.toml"))
    assert result.rebound_ratios[1] == pytest.approx(1.64, abs=1e-6)
    assert main(["simulate", "fitted.toml"]) == 0
    again = fit("fitted.toml", *ONE[4:])
    assert cells(again, "contacts.1.stiffness") == cells(out, "contacts.1.stiffness")
    assert {path.name for path in tmp_path.iterdir()} == {"fitted.toml", "fit.svg"}


def test_several_drops_are_saved_into_a_folder(fit, told, tmp_path):
    (tmp_path / "drops.csv").write_text(TABLE, encoding="utf-8")
    asked = (*PAIR, "--data", "drops.csv", "--vary", "contacts.1.stiffness")
    found = told(*asked, "--save", "fitted")
    assert [one["drop"] for one in found["residuals"]] == ["low", "high"]
    assert found["saved"] == [str(Path("fitted", f"{name}.toml")) for name in ("low", "high")]
    for name, height in (("low", 0.30), ("high", 0.63)):
        drop = sb.Drop.from_toml(tmp_path / "fitted" / f"{name}.toml")
        assert (drop.height, drop.gaps) == (height, (0.001,))
        assert drop.contacts[1].stiffness == found["values"]["contacts.1.stiffness"]["value"]
    more = told(*asked, "--measured", "low.rebound_ratios.0=0.2 ± 0.1")
    names = [residual["name"] for residual in more["residuals"]]
    assert names[:2] == ["rebound_ratios.1", "rebound_ratios.0"]
    out = fit(*asked)
    assert len(cells(out, "low.rebound_ratios.1")) == len(cells(out, "high.rebound_ratios.1")) == 1
    assert "for 1 degree of freedom; were the model right, it would be larger in" in out
    assert "% of" in out


def test_a_file_asks_and_options_change_it(told, tmp_path):
    (tmp_path / "fit.toml").write_text(ONE_BALL, encoding="utf-8")
    first = told("fit.toml")["values"]["contacts.0.stiffness"]
    assert first["value"] == pytest.approx(0.0567 * (3.14159265 / 5e-3) ** 2, rel=1e-6)
    other = told("fit.toml", "--measured", "durations.0=2.5 ± 0.1 ms", "--height", "2m")
    assert other["values"]["contacts.0.stiffness"]["value"] == pytest.approx(4.0 * first["value"])
    assert "height = 2.0" in other["drops"][""]


def test_draws_and_their_picture(told, tmp_path):
    drawn = told(*ONE, "--sample", "3200", "--seed", "3", "--corner", "corner.png")["posterior"]
    assert (drawn["draws"], drawn["seed"]) == (75 * 32, 3)
    assert 0.1 < drawn["acceptance"] < 0.9
    value = drawn["values"]["contacts.1.stiffness"]
    assert value["autocorrelation"] > 0.0
    assert value["quantiles"]["0.5"] == pytest.approx(1477.0, abs=30.0)
    assert (tmp_path / "corner.png").stat().st_size > 5_000
    assert told(*ONE, "--sample", "3200", "--seed", "3")["posterior"] == drawn


def test_draws_in_a_table(fit):
    out = fit(*ONE, "--sample", "3200", "--interval")
    ((*numbers, unit),) = cells(out, "contacts.1.stiffness")
    assert (len(numbers), unit) == (8, "N/m")
    assert re.search(r"Draws: \d+ kept; \d\d% of the steps were accepted, and the autocorr", out)


@pytest.mark.skipif(os.name != "posix", reason="a terminal of its own")
@pytest.mark.slow
def test_a_terminal_sees_how_far_the_draws_are(tmp_path):
    ours, theirs = os.openpty()
    code = "import sys; from stackbounce.cli import main; sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", code, "fit", *ONE, "--sample", "64000"]
    options = {"stderr": theirs, "stdout": subprocess.DEVNULL, "cwd": tmp_path}
    with subprocess.Popen(command, **options) as process:
        os.close(theirs)
        seen = b""
        with contextlib.suppress(OSError):  # how Linux tells that the other end is closed
            while more := os.read(ours, 10_000):
                seen += more
    os.close(ours)
    assert process.returncode == 0
    assert b"64000/64000" in seen


def test_an_interruption_leaves_nothing_behind(run, tmp_path, monkeypatch):
    def interrupted(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(Fit, "sample", interrupted)
    asked = (*ONE, "--sample", "3200", "--save", "fitted.toml", "--plot", "fit.png")
    code, out, err = run("fit", *asked)
    assert (code, err) == (130, "stackbounce: interrupted\n")
    best = r"Interrupted: the best of \d+ trials, .*: contacts.1.stiffness = 1477.* N/m\n"
    assert re.fullmatch(best, out)
    assert list(tmp_path.iterdir()) == []
