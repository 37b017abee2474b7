"""The page on fits: its commands print what it shows, in turn."""

import re
import shutil
from pathlib import Path

import pytest

import stackbounce as sb
from pages.consoles import run_all, steps

DOCS = Path(__file__).parents[2] / "docs"
TEXT = (DOCS / "fit.md").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("page")
    for path in [*(DOCS / "lab").iterdir(), *(DOCS / "fit").iterdir()]:
        if path.is_file():
            shutil.copy(path, folder)
    return folder


@pytest.mark.slow
def test_the_commands_in_turn_print_what_is_shown(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder)
    assert [command[0] for command, _ in steps(TEXT)].count("fit") == TEXT.count(
        "$ stackbounce fit"
    )
    run_all(TEXT, capsys)
    for name in ("force", "valley", "draws", "models"):
        assert (folder / f"{name}.png").stat().st_size > 10_000
    drop = sb.Drop.from_toml(folder / "fitted" / "highest.toml")
    assert drop.contacts[1].stiffness == pytest.approx(1000.0, abs=3 * 21.0)  # what went in
    assert drop.gaps[0] == pytest.approx(0.002, abs=3 * 0.00049)


def test_every_picture_has_its_command():
    pictures = re.findall(r"^\.\. plot:: figures/fit.py (\w+)$", TEXT, re.MULTILINE)
    written = re.findall(r"^Picture: (\w+)\.png$", TEXT, re.MULTILINE)
    assert sorted(pictures) == sorted(written) == ["draws", "force", "models", "valley"]


def test_every_quantity_is_in_the_table():
    from stackbounce.fitting.quantities import QUANTITIES

    for name in (*QUANTITIES, "force"):
        assert re.search(rf"`{name}(\.\d)?`", TEXT), name
