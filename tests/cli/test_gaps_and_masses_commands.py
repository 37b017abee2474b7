"""The commands transition, highest and masses: tables, JSON, files, and what they refuse."""

import json
import re
from pathlib import Path

import pytest

import stackbounce as sb
from stackbounce.cli import main

SPRINGS = ["--contact", "Spring stiffness=2500", "--contact", "Spring stiffness=1000"]
RIGID = ["--contact", "Rigid restitution=1"] * 2


@pytest.fixture(autouse=True)
def _in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def run(capfd):
    def run_main(*arguments):
        code = main(list(arguments))
        out, err = capfd.readouterr()
        return code, out, err

    return run_main


def test_they_are_listed_and_have_help(run):
    listed = run("--help")[1]
    for command in ("transition", "highest", "masses"):
        assert command in listed
        code, out, err = run(command, "--help")
        assert (code, err) == (0, "")
        assert f"stackbounce {command}" in out


def test_transition_for_machines(run):
    code, out, err = run("transition", "basketball", "tennis", *SPRINGS, "--speed", "1", "--json")
    assert (code, err) == (0, "")
    found = json.loads(out)
    drop = sb.Drop.from_mapping(found["drop"])
    ds = sb.transition(drop)
    assert found["separate_from"] == ds.separate_from
    assert found["gap"] == ds.gap.values.tolist()
    assert found["rebound_ratio"] == ds.rebound_ratio.values.tolist()
    assert found["textbook"]["collisions"] == [2, 1]
    (change,) = found["changes"]
    assert (change["before"], change["after"]) == ([1, 1], [2, 1])
    assert set(found["status"]) == {"FINISHED"}


def test_transition_of_one_gap_up_to_a_stop(run):
    words = ["B1", "B2", "B3", "--gap", "1mm", "--gap", "0mm", "--only", "1", "--stop", "2mm"]
    code, out, err = run("transition", *words)
    assert (code, err) == (0, "")
    assert re.search(r"^ *2\.000 ", out, re.MULTILINE)
    assert "beyond --stop" in out
    assert "separate from here on" not in out


def test_transition_without_an_end(run):
    laws = ["--contact", "Hysteretic stiffness=1e4 restitution=0.5"] * 2
    code, out, _ = run("transition", "B3", "basketball", *laws, "--stop", "5mm")
    assert code == 0
    assert "never all separate" in out
    assert "∞ ∞  textbook" in out


def test_highest_for_machines_and_to_a_file(run):
    words = ["B1", "B2", "B3", "--balls", "2", "--gap", "1mm", "--speed", "2", "--law", "spring"]
    code, out, err = run("highest", *words, "--save", "best.toml", "--json")
    assert (code, err) == (0, "")
    found = json.loads(out)
    names = ["B1", "B2", "B3"]
    ds = sb.highest(names, 2, gaps=[0.001], law=sb.Spring, impact_speed=2.0)
    assert [stack["balls"] for stack in found["stacks"]] == ds.balls.values.tolist()
    assert [stack["height_ratio"] for stack in found["stacks"]] == ds.height_ratio.values.tolist()
    assert (found["gap"], found["impact_speed"]) == ([0.001], 2.0)
    best = sb.simulate(sb.Drop.from_toml("best.toml"))
    assert best.rebound_ratios == pytest.approx(ds.rebound_ratio.values[0, 0], abs=1e-12)


def test_highest_of_balls_that_have_a_file_each(run):
    for name, mass in (("a", 0.2), ("b", 0.02)):
        drop = sb.Drop([sb.Ball(mass, name=name)], [sb.Spring(1e4)], height=1.0)
        Path(f"{name}.toml").write_text(drop.to_toml(), encoding="utf-8")
    code, out, _ = run("highest", "a.toml", "b.toml", "--balls", "2", "--gap", "0", "--rows", "1")
    assert code == 0
    assert "The best 1 of 2 stacks" in out
    height = sb.simulate(
        sb.Drop([sb.Ball(0.2), sb.Ball(0.02)], [sb.Spring(1e4), sb.Spring(5e3)], height=1.0)
    ).rebound_ratios[1]
    assert f"{height:.3f}" in next(line for line in out.splitlines() if line.startswith("a + b"))


def test_highest_says_which_stack_another_gap_favours(run):
    code, out, _ = run("highest", "B1", "B2", "B3", "--balls", "2")
    assert code == 0
    assert "With gaps of 5 mm B1 + B3 is first." in out


def test_masses_for_machines_and_to_a_file(run):
    words = ["B1", "B2", "B3", *RIGID, "--contact", "Rigid restitution=1"]
    code, out, err = run("masses", *words, "--save", "best.toml", "--json")
    assert (code, err) == (0, "")
    found = json.loads(out)
    middle = (0.101 * 0.0085) ** 0.5
    assert found["best"]["masses"][1] == pytest.approx(middle, rel=1e-5)
    assert found["geometric_means"]["masses"][1] == pytest.approx(middle)
    assert found["at_the_end"] == []
    assert sb.Drop.from_toml("best.toml").balls[1].mass == found["best"]["masses"][1]


@pytest.mark.slow
def test_masses_tell_when_the_best_lies_beyond(run):
    words = ["B1", "B2", "B3", *RIGID, "--contact", "Rigid restitution=1", "--within", "40g:50g"]
    code, out, _ = run("masses", *words)
    assert code == 0
    assert "B2 lies at the end of what was tried" in out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["transition", "B1"], "balls must be two or more"),
        (["transition", "B1", "B2", *RIGID], "contacts must be finite ones"),
        (["transition", "B1", "B2", "--stop", "5kg"], "--stop"),
        (["transition", "B1", "B2", "--plot", "x.txt"], "--plot must end in .svg"),
        (["transition", "B1", "B2", "--only", "3"], "only must be a whole number from 0 to 0"),
        (["highest", "--balls", "9"], "count must be a whole number from 2 to 5, got 9"),
        (["highest", "B9"], "ball must be one of the catalogue"),
        (["highest", "--law", "rigid"], "law must be one with a stiffness"),
        (["highest", "--height", "1m", "--speed", "1"], "only one of the two can be given"),
        (["highest", "--height", "-1m"], "--height must be a positive number of metres"),
        (["highest", "--save", "best.txt"], "--save must end in .toml"),
        (["highest", "no.toml"], "no.toml cannot be read"),
        (["masses", "B1", "B2"], "balls must be three or more"),
        (["masses", "B1", "B2", "B3", "--within", "1g"], "--within must be MASS:MASS"),
        (["masses", "B1", "B2", "B3", "--save", "no/best.toml"], "there is no folder"),
    ],
)
def test_what_is_wrong_is_said_in_one_line(run, arguments, message):
    code, out, err = run(*arguments)
    assert (code, out) == (2, "")
    assert err.startswith("stackbounce: error: ")
    assert err.count("\n") == 1
    assert message in err
