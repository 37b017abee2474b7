"""`stackbounce measure`: each layout from the command line, a table, JSON, a picture, a ball."""

import math
import shutil
from functools import partial
from pathlib import Path

import pytest

import stackbounce as sb
from measure import make_files as made
from stackbounce.measure import one_ball

LAB = Path(__file__).parents[2] / "docs" / "lab"
RIGID = {"contact": {"law": "Rigid", "restitution": 0.8}}
SPRING = {"contact": {"law": "Spring", "stiffness": 2e4}}
HERTZ = {"contact": {"law": "Hertz", "stiffness": 1e6}}
LOSSY = {"contact": {"law": "Hysteretic", "stiffness": 1e3, "restitution": 0.5}}


@pytest.fixture(autouse=True)
def _with_files(tmp_path):
    made.main(tmp_path / "made")
    for path in LAB.iterdir():
        if path.suffix != ".py" and path.is_file():
            shutil.copy(path, tmp_path)


@pytest.fixture
def measure(printed):
    return partial(printed, "measure")


LAYOUTS = {  # of each kind of measurement one; tests/measure/reading has the others
    "made/force_ms.csv": ("table of numbers", "contact time"),
    "made/phyphox_collision.zip": ("phyphox: (in)elastic collision", "restitution, mean"),
    "made/press.csv": ("table of numbers", "exponent"),
    "made/tek_mdo.csv": ("Tektronix MDO oscilloscope", "contacts"),
    "stack-video.txt": ("Tracker", "tennis: rebound ratio"),
}


@pytest.mark.parametrize("name", LAYOUTS)
def test_each_layout_is_read_and_analysed(measure, told, name):
    (file,) = told("measure", name)["files"]
    form, first = LAYOUTS[name]
    assert file["format"] == form
    assert first in [row["name"] for row in file["found"]]
    out = measure(name)
    assert out.startswith(f"{name}: {form}\n")
    assert first in out
    assert max(map(len, out.splitlines())) <= 100


@pytest.mark.parametrize("name", ["tennis.wav", "made/phyphox_collision.zip", "tennis-force.csv"])
def test_a_picture(measure, name, tmp_path):
    assert measure(name, "--plot", "found.svg").endswith("Picture: found.svg\n")
    assert (tmp_path / "found.svg").read_bytes().startswith(b"<?xml")


def test_a_ball_is_saved_and_dropped(told):
    known = ["--mass", "57g", "--diameter", "66 mm", "--height", "1m", "--name", "tennis"]
    found = ("tennis.wav", "tennis-force.csv")
    ball = told("measure", *found, *known, "--save", "ball.toml")["ball"]
    drop = sb.Drop.from_toml("ball.toml")
    assert ball == drop.to_mapping()
    assert (drop.balls[0], drop.height) == (sb.Ball(0.057, 0.066, "tennis"), 1.0)
    assert drop.contacts[0].restitution == pytest.approx(0.75, abs=1e-3)
    assert told("simulate", "ball.toml")["rebound_ratios"][0] == pytest.approx(
        drop.contacts[0].restitution
    )


@pytest.mark.parametrize(
    ("parts", "law"),
    [
        ([RIGID], sb.Rigid(0.8)),
        ([SPRING], sb.Spring(2e4)),
        ([RIGID, SPRING], sb.Hysteretic(2e4, restitution=0.8)),
        ([HERTZ, RIGID], sb.Hysteretic(1e6, exponent=1.5, restitution=0.8)),
        ([LOSSY, RIGID], sb.Hysteretic(1e3, restitution=0.8)),
    ],
)
def test_contacts_found_together(parts, law):
    assert one_ball(parts, mass=0.1).contacts == (law,)


def test_what_a_ball_needs():
    assert one_ball([RIGID], mass=0.1).height == 1.0
    assert one_ball([RIGID | {"impact_speed": 2.0}], mass=0.1).impact_speed == 2.0
    later = one_ball([{"height": 3.0}, RIGID | {"impact_speed": 2.0}], mass=0.1)
    assert (later.height, later.impact_speed) == (None, 2.0)
    with pytest.raises(sb.StackbounceError, match="mass is not known"):
        one_ball([RIGID])
    with pytest.raises(sb.StackbounceError, match="got Rigid, Rigid"):
        one_ball([RIGID, RIGID], mass=0.1)
    assert math.isclose(one_ball([RIGID, {"ball": {"mass": 0.2}}]).balls[0].mass, 0.2)
