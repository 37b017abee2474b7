"""The page on fits: its commands print what it shows, in turn."""

import re
import shutil

import pytest

import stackbounce as sb
from pages.consoles import DOCS, read_page, run_all, steps
from stackbounce.fitting.quantities import QUANTITIES

TEXT = read_page("fit")
PICTURES = ["draws", "force", "heights", "models", "stack", "valley"]


@pytest.mark.slow
def test_the_commands_in_turn_print_what_is_shown(tmp_path, monkeypatch, capsys):
    for path in [*(DOCS / "lab").iterdir(), *(DOCS / "fit").iterdir()]:
        if path.is_file():
            shutil.copy(path, tmp_path)
    monkeypatch.chdir(tmp_path)
    commands = [command[0] for command, _ in steps(TEXT)]
    assert commands.count("fit") == TEXT.count("$ stackbounce fit")
    run_all(steps(TEXT), capsys)
    for name in PICTURES:
        assert (tmp_path / f"{name}.png").stat().st_size > 10_000
    drop = sb.Drop.from_toml(tmp_path / "fitted" / "highest.toml")
    assert drop.contacts[1].stiffness == pytest.approx(1000.0, abs=3 * 21.0)  # what went in
    assert drop.gaps[0] == pytest.approx(0.002, abs=3 * 0.00049)


def test_the_commands_of_the_readme_print_what_is_shown(tmp_path, monkeypatch, capsys):
    shutil.copy(DOCS / "fit" / "heights.csv", tmp_path)
    monkeypatch.chdir(tmp_path)
    run_all(steps((DOCS.parent / "README.md").read_text("utf-8")), capsys)
    assert (tmp_path / "heights.svg").stat().st_size > 10_000


def test_every_picture_has_its_command():
    pictures = re.findall(r"^\.\. plot:: figures/fit.py (\w+)$", TEXT, re.MULTILINE)
    written = re.findall(r"^Picture: (\w+)\.png$", TEXT, re.MULTILINE)
    assert sorted(pictures) == sorted(written) == PICTURES


def test_every_quantity_is_in_the_table():
    for name in (*QUANTITIES, "force"):
        assert re.search(rf"`{name}(\.\d)?`", TEXT), name
