"""Pages whose commands print what they show; that on balls has the catalogue's table."""

import re
import runpy
import shlex
import shutil
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import stackbounce as sb
from pages.consoles import DOCS, FENCE, read_page, run_all, steps, write_files
from stackbounce.cli import main
from stackbounce.cross2007 import PAPER
from stackbounce.cross2007.bench import Bench
from stackbounce.cross2007.figures_models import (
    after_collision,
    rebound_by_mass,
    rebound_by_stiffness,
)
from stackbounce.model.catalogue import CLASS_BALLS

TEXT = read_page("balls")
MARKS = {"measured": "", "rule": " (r)", "estimate": " (e)"}


def test_the_table_is_that_of_the_catalogue():
    rows = re.findall(r"^\| `(.*?)` \| (.*) \|$", TEXT, re.MULTILINE)
    wanted = []
    for entry in CLASS_BALLS:
        figures = {
            "mass": f"{1e3 * entry.ball.mass:.4g} g",
            "diameter": f"{1e3 * entry.ball.diameter:.4g} mm",
            "restitution": f"{entry.restitution:.2f}",
            "contact_time": f"{1e3 * entry.contact_time:.2g} ms",
        }
        cells = [text + MARKS[entry.kind_of(name)] for name, text in figures.items()]
        wanted.append((entry.ball.name.replace(" ", "-"), " | ".join(cells)))
    assert rows == wanted


# --- the page on gaps, stacks and masses: its commands print what stands there, and draw
STACKS_TEXT = read_page("gaps-and-masses")
RUNS = steps(STACKS_TEXT)


@pytest.mark.fast_cases(1)
@pytest.mark.parametrize("step", RUNS, ids=lambda step: step[0][1])
def test_a_command_prints_what_stands_there(step, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    write_files(STACKS_TEXT, tmp_path)
    run_all([step], capsys, whole=True)
    command, _ = step
    if "--plot" in command:
        assert Path(command[command.index("--plot") + 1]).stat().st_size > 10_000
    if "--save" in command:
        run_all([(["simulate", command[command.index("--save") + 1]], [])], capsys)


def test_all_commands_of_the_page_are_run():
    assert len(RUNS) == STACKS_TEXT.count("$ stackbounce") == 5
    assert STACKS_TEXT.count("--plot") == 2


def test_the_command_of_the_page_on_offsets_prints_what_stands_there(capsys):
    run_all(steps(read_page("straight")), capsys)


# --- the page of maps and lines: its commands draw its pictures, and these agree with the paper's
SWEEPS_TEXT = read_page("sweeps")
WORDS = [
    [shlex.split(line)[1:] for line in fence.replace("\\\n", " ")[2:].split("\n$ ")]
    for fence in FENCE.findall(SWEEPS_TEXT)
]
COMMANDS = [words for (words, *_) in WORDS if "--plot" in words]
(OF_DRAWS,) = (commands for commands in WORDS if len(commands) > 1)


@pytest.fixture(scope="module")
def sweeps():
    module = runpy.run_path(str(DOCS / "figures" / "sweeps.py"))
    return {name: sb.sweep(*what) for name, what in module["SWEEPS"].items()}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("page")
    write_files(SWEEPS_TEXT, folder)
    return folder


@pytest.fixture
def bench():
    return Bench(PAPER)


@pytest.mark.fast_cases(2)
@pytest.mark.parametrize("command", COMMANDS, ids=lambda words: words[-1])
def test_a_command_makes_the_data_of_its_picture(command, sweeps, folder, monkeypatch):
    monkeypatch.chdir(folder)
    assert main(command) == 0
    store = command[command.index("--out") + 1]
    xr.testing.assert_equal(xr.open_zarr(store).load(), sweeps[store.removesuffix(".zarr")])
    assert (folder / command[-1]).stat().st_size > 10_000


def test_draws_are_dropped_from_each_height(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert [main(words) for words in OF_DRAWS] == [0, 0]
    ds = xr.open_zarr("posterior.zarr")
    assert dict(ds.status.sizes) == {"draw": 2400, "height": 3}
    assert ds.rebound_ratio.std("draw").sel(ball=1).values == pytest.approx(0.02, rel=0.2)


def test_every_picture_has_its_command():
    shown = re.findall(r"^\.\. plot:: figures/sweeps.py (\w+)$", SWEEPS_TEXT, re.MULTILINE)
    assert len(COMMANDS) == len(shown) == len(set(shown)) > 0


def test_lines_are_those_of_figures_4a_and_6(sweeps, bench):
    of_mass, of_stiffness = sweeps["mass"], sweeps["stiffness"]
    masses, mass_ratio = of_mass.balls_0_mass, bench("basketball.mass") / bench("tennis.mass")
    own = rebound_by_mass(bench, masses.values[::20], bench("models.stiffness_ratio"))
    assert of_mass.rebound_ratio.values[::20] == pytest.approx(own.T, abs=1e-11)
    own = rebound_by_stiffness(bench, mass_ratio, np.geomspace(0.1, 100.0, 241)[::20])
    assert of_stiffness.rebound_ratio.values[::20] == pytest.approx(own.T, abs=1e-11)


def test_lines_are_those_of_figure_2_where_they_meet_once_or_twice(sweeps, bench):
    ds = sweeps["separate"]
    for count in (1, 2):
        own = ds.isel(balls_0_mass=(ds.collisions.sel(contact=1) == count).values)
        masses, ratios = own.balls_0_mass.values, own.rebound_ratio.values
        after = after_collision(bench, masses[::10], bench("models.restitution"), count)
        back = -bench("models.restitution") * after[0]  # from the floor, where it went down again
        after[0] = np.where(after[0] < 0.0, back, after[0])
        assert ratios[::10] == pytest.approx(after.T, abs=1e-12)


# --- the lab guide: its files are what its script writes, its commands print what the page shows
LAB_TEXT = read_page("lab")
FILES = sorted(path for path in (DOCS / "lab").iterdir() if path.suffix in (".wav", ".csv", ".txt"))


def test_the_files_are_what_the_script_writes(tmp_path):
    runpy.run_path(str(DOCS / "lab" / "make.py"))["main"](tmp_path)
    assert [path.name for path in FILES] == sorted(path.name for path in tmp_path.iterdir())
    for path in FILES:
        assert (tmp_path / path.name).read_bytes() == path.read_bytes(), path.name


@pytest.mark.slow
def test_the_commands_in_turn_print_what_is_shown(tmp_path, monkeypatch, capsys):
    for path in FILES:
        shutil.copy(path, tmp_path)
    monkeypatch.chdir(tmp_path)
    assert len(steps(LAB_TEXT)) == LAB_TEXT.count("$ stackbounce")
    run_all(steps(LAB_TEXT), capsys)
    for name in ("tennis", "force", "press", "stack"):
        assert (tmp_path / f"{name}.png").stat().st_size > 10_000
