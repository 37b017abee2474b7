"""The lab guide: its files are what its script writes, its commands print what the page shows."""

import runpy
import shutil

import pytest

import stackbounce as sb
from pages.consoles import DOCS, read_page, run_all, steps
from stackbounce.measure import analyse

TEXT = read_page("lab")
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
    assert len(steps(TEXT)) == TEXT.count("$ stackbounce")
    run_all(steps(TEXT), capsys)
    for name in ("tennis", "force", "press", "stack"):
        assert (tmp_path / f"{name}.png").stat().st_size > 10_000


@pytest.mark.parametrize(("name", "restitution"), [("tennis", 0.75), ("basketball", 0.77)])
def test_the_restitution_that_went_in_comes_out(name, restitution):
    found = analyse(sb.read(DOCS / "lab" / f"{name}.wav"), height=1.0)[0].mean
    assert abs(found.nominal_value - restitution) < 3.0 * found.std_dev


def test_the_contact_time_that_went_in_comes_out():
    contact = analyse(sb.read(DOCS / "lab" / "tennis-force.csv"))[0].contacts[0].time
    law = sb.Hysteretic(2.25e4, restitution=0.75)
    truth = sb.simulate(sb.Drop([sb.Ball(0.057)], [law], height=1.0)).intervals[0]
    assert abs(contact.nominal_value - (truth["end"] - truth["start"])) < 3.0 * contact.std_dev


def test_each_file_is_recognised_without_its_name(tmp_path):
    other = tmp_path / "file"
    for path in FILES:
        shutil.copy(path, other)
        holds = sb.read(other).attrs["holds"]
        assert holds in ("sound", "waveform", "press curve", "track"), path.name
