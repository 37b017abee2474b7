"""Short pages: that on balls, whose table is the catalogue's, and the two below."""

import re
import shutil
from pathlib import Path

import pytest

import stackbounce as sb
from pages.consoles import DOCS, read_page, run_all, steps, write_files
from stackbounce.fitting.quantities import QUANTITIES
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


# --- the page on fits: its commands print what it shows, in turn
FIT_TEXT = read_page("fit")


@pytest.mark.slow
def test_the_commands_in_turn_print_what_is_shown(tmp_path, monkeypatch, capsys):
    for path in [*(DOCS / "lab").iterdir(), *(DOCS / "fit").iterdir()]:
        if path.is_file():
            shutil.copy(path, tmp_path)
    monkeypatch.chdir(tmp_path)
    commands = [command[0] for command, _ in steps(FIT_TEXT)]
    assert commands.count("fit") == FIT_TEXT.count("$ stackbounce fit")
    run_all(steps(FIT_TEXT), capsys)
    for name in ("force", "valley", "draws", "models"):
        assert (tmp_path / f"{name}.png").stat().st_size > 10_000
    drop = sb.Drop.from_toml(tmp_path / "fitted" / "highest.toml")
    assert drop.contacts[1].stiffness == pytest.approx(1000.0, abs=3 * 21.0)  # what went in
    assert drop.gaps[0] == pytest.approx(0.002, abs=3 * 0.00049)


def test_every_picture_has_its_command():
    pictures = re.findall(r"^\.\. plot:: figures/fit.py (\w+)$", FIT_TEXT, re.MULTILINE)
    written = re.findall(r"^Picture: (\w+)\.png$", FIT_TEXT, re.MULTILINE)
    assert sorted(pictures) == sorted(written) == ["draws", "force", "models", "valley"]


def test_every_quantity_is_in_the_table():
    for name in (*QUANTITIES, "force"):
        assert re.search(rf"`{name}(\.\d)?`", FIT_TEXT), name
