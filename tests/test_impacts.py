"""The open benchmark of impacts: its files, its scorer, how programs are run, our own answers."""

import json
import subprocess
import sys
from functools import partial

import pytest
from benchmarks.impacts import __main__ as command
from benchmarks.impacts import make_answers, runs, score, table
from benchmarks.impacts.score import FOLDER, Malformed, score_all
from benchmarks.peers.impacts import PEERS, by_chipmunk, by_mujoco, by_scipy, ours, worlds
from benchmarks.peers.impacts.common import Peer, Unsupported

PROBLEMS = score.read(FOLDER / "problems.json", "problems")["problems"]
ANSWERS = score.read(FOLDER / "answers.json", "answers")["answers"]
BY_NAME = {problem["name"]: problem for problem in PROBLEMS}
PAIR = "springs-basketball-tennis"
QUICK = ("spring-one-ball", PAIR, "dashpots-delayed-rebound", "rigid-cannon", "rigid-settles")
LONG = ("hysteretic-superballs", "chase-hertz-touched", "collapse-floor", "hunt-crossley-one-ball")


def answer_to(name):
    return next(answer for answer in ANSWERS if answer["name"] == name)


def scored(answers, name=PAIR):
    return next(found for found in score_all(PROBLEMS, ANSWERS, answers) if found.name == name)


def changed(field, value, name=PAIR):
    return scored([answer_to(name) | {field: value}], name)


def test_the_set_has_the_sizes_that_it_promises():
    assert 40 <= len(PROBLEMS) <= 80
    assert [answer["name"] for answer in ANSWERS] == list(BY_NAME)
    assert {problem["grade"] for problem in PROBLEMS} == {1, 2, 3, 4, 5}
    assert {len(problem["masses"]) for problem in PROBLEMS} >= {1, 2, 3, 4, 5, 6, 10}


@pytest.mark.parametrize(
    ("problem", "answer"), list(zip(PROBLEMS, ANSWERS, strict=True)), ids=BY_NAME
)
def test_a_problem_and_its_answer_are_as_the_readme_says(problem, answer):
    fields = "name grade group why masses contacts gaps velocities gravity until ask"
    assert list(problem) == fields.split()
    balls = len(problem["masses"])
    sizes = [len(problem["contacts"]), len(problem["velocities"]), len(problem["gaps"]) + 1]
    assert sizes == [balls] * 3
    assert all(mass > 0.0 for mass in problem["masses"])
    assert {"velocities", "counts"} <= set(problem["ask"]) <= set(score.FIELDS)
    assert (problem["gravity"] > 0.0) == (problem["until"] is not None)
    assert None not in problem["contacts"][1:]
    fields = [field for word in problem["ask"] for field in score.FIELDS[word]]
    assert set(answer) == {"name", *fields, "methods", "sure", "conditioning"}
    assert answer["sure"] >= 17
    assert len(set(answer["methods"])) == 2
    assert answer["conditioning"]["velocities"] >= 0.0


@pytest.mark.parametrize(
    "name", [*QUICK, *(pytest.param(name, marks=pytest.mark.slow) for name in LONG)]
)
def test_answers_are_what_the_references_give(name):
    assert make_answers.answer(BY_NAME[name]) == answer_to(name)


def test_a_perfect_answer_has_full_marks():
    for one in score_all(PROBLEMS, ANSWERS, ANSWERS):
        assert one.right(score.MOST), one
        assert one.forces in (None, score.MOST)


def test_an_error_loses_the_digits_above_it():
    velocities = answer_to(PAIR)["velocities"]
    error = 3.53e-5  # of 3.53 m/s; the conditioning is 1.4
    one = changed("velocities", [float(velocities[0]) + error, float(velocities[1])])
    assert one.speeds == pytest.approx(5.0 + 0.146, abs=0.01)
    assert one.times == score.MOST
    assert one.right(5)
    assert not one.right(6)


def test_each_kind_of_wrong_answer_loses_what_it_should():
    assert changed("counts", [1, 2]).counts is False
    assert changed("status", "collapsed").status is False
    assert changed("last_release", [0.0306, 0.0340]).times == pytest.approx(3.1, abs=0.2)
    assert changed("peak_force", [70.0, 34.0]).forces == pytest.approx(2.3, abs=0.1)
    for velocities in ([float("nan"), 1.0], None):
        assert changed("velocities", velocities).speeds == 0.0
    # an error of a time that is zero is one of the run, whose largest time is 0.034 s
    assert changed("first_touch", [0.0, 3.4e-8]).times == pytest.approx(6.0, abs=0.01)
    assert changed("first_touch", [0.0, None]).times == 0.0
    assert changed("end", 0.2, "rigid-settles").times == pytest.approx(2.06, abs=0.01)
    without_forces = changed("peak_force", None)
    assert (without_forces.forces, without_forces.right(12)) == (0.0, True)
    for wrong in (("counts", [1, 2]), ("status", "stopped"), ("counts", None)):
        assert not changed(*wrong).right(0)


def test_what_is_not_answered_is_told_and_not_right():
    answers = [{"name": PAIR, "unsupported": "no"}, {"name": "rigid-cannon", "failed": "it died"}]
    found = {one.name: one for one in score_all(PROBLEMS, ANSWERS, answers)}
    assert found[PAIR].outcome == "unsupported"
    assert found["rigid-cannon"].reason == "it died"
    assert found["rigid-million"].outcome == "missing"
    assert not any(one.right(0) for one in found.values())
    assert score.summary(list(found.values()))["answered"] == 0


@pytest.mark.parametrize(
    ("answers", "message"),
    [
        ([{"velocities": [1.0]}], "each answer has to be an object with the name"),
        ([{"name": "springs"}], "there is no problem 'springs'"),
        ([{"name": PAIR, "velocities": [1.0]}], "velocities has to be a list of 2"),
        ([{"name": PAIR, "velocities": [1.0, "fast"]}], "'fast', which is no number"),
        (2 * ANSWERS[:1], "two answers"),
    ],
)
def test_malformed_answers_are_named(answers, message):
    with pytest.raises(Malformed, match=message):
        score_all(PROBLEMS, ANSWERS, answers)


@pytest.mark.parametrize("text", ["{", "[]", '{"answers": 1}', '{"answers": [1]}', None])
def test_a_malformed_file_gives_one_line_and_a_status(text, tmp_path, capsys):
    file = tmp_path / "mine.json"
    if text is not None:
        file.write_text(text, "utf-8")
    assert score.main([str(file)]) == 2
    told = capsys.readouterr()
    assert told.out == ""
    assert told.err.count("\n") == 1


def test_the_scorer_needs_the_standard_library_only(tmp_path):
    file = tmp_path / "mine.json"
    file.write_text(json.dumps({"answers": ANSWERS[:3]}), "utf-8")
    command = [sys.executable, "-I", "-S", str(FOLDER / "score.py"), str(file)]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=False)
    assert done.returncode == 0, done.stderr
    assert f"all    {len(PROBLEMS)}" in done.stdout


def test_a_program_that_hangs_or_dies_loses_that_problem_only():
    actions = {
        "slow": "__import__('time').sleep(60)",
        "dead": "__import__('os')._exit(1)",
        "wrong": "1 / 0",
        "good": "{'counts': [1]}",
    }
    code = " or ".join(f"p['name'] == {name!r} and {act}" for name, act in actions.items())
    peer = Peer("mine", "numpy", "tests", "none", partial(eval, f"lambda p: {code}"))
    problems = [{"name": name} for name in ("slow", "dead", "wrong", "good")]
    slow, dead, wrong, good = runs.answers(peer, problems, 1.0, lambda _: None)
    assert slow["failed"] == "not done after 1 s"
    assert dead["failed"] == "the process died"
    assert wrong["failed"] == "ZeroDivisionError: division by zero"
    assert good["counts"] == [1]
    assert good["seconds"] >= 0.0


def test_ours_is_right():
    solve = ours.prepare()
    answers = [{"name": one["name"], **solve(one)} for one in PROBLEMS]
    assert [one.name for one in score_all(PROBLEMS, ANSWERS, answers) if not one.right(12)] == []


def test_a_program_says_what_it_is_not_meant_for():
    with pytest.raises(Unsupported, match="rigid collisions"):
        by_scipy.DOP853.prepare()(BY_NAME["rigid-cannon"])


@pytest.mark.parametrize(("restitution", "ratio"), [(0.744079, 0.1), (0.450975, 0.3)])
def test_the_damping_of_a_soft_rigid_contact_has_the_restitution(restitution, ratio):
    assert by_mujoco.damping_ratio(restitution) == pytest.approx(ratio, abs=1e-6)


def test_the_table_has_a_row_for_each_program(tmp_path):
    problems = [BY_NAME[PAIR], BY_NAME["rigid-cannon"]]
    right = answer_to("rigid-cannon") | {"seconds": 0.001}
    answers = [{"name": PAIR, "failed": "not done", "seconds": 1.0}, right]
    scores = score_all(problems, ANSWERS, answers)
    table.write(tmp_path, [table.Entry(by_chipmunk.PEER, "7", answers, scores)], problems)
    text = (tmp_path / "impacts.md").read_text("utf-8")
    assert "| pymunk (Chipmunk) | 7 | 1 | 1 | 1 | 1 | 1 | 15.0 | 15.0 | – | 1.0 |" in text
    assert len((tmp_path / "impacts.csv").read_text("utf-8").splitlines()) == 3
    assert json.loads((tmp_path / "impacts.json").read_text("utf-8"))[0]["version"] == "7"


def test_the_command_prints_and_writes_the_table(tmp_path, monkeypatch, capsys):
    options = ["--only", "stackbounce", "--problem", PAIR, "--out", str(tmp_path)]
    monkeypatch.setattr(sys, "argv", ["impacts", *options])
    command.main()
    assert "| stackbounce | " in capsys.readouterr().out
    assert {path.suffix for path in tmp_path.glob("impacts.*")} == {".csv", ".json", ".md"}
    assert len({peer.name for peer in PEERS}) == len(PEERS)


INSTALLED = [peer for peer in PEERS if peer.version()]
EASY = {"springs-basketball-tennis": 3.0, "rigid-cannon": 2.0}


@pytest.mark.slow
@pytest.mark.parametrize("peer", INSTALLED, ids=lambda one: one.name)
def test_a_program_that_is_installed_is_right_where_problems_are_easy(peer):
    problems = [BY_NAME[name] for name in EASY]
    answers = list(runs.answers(peer, problems, 60.0, lambda _: None))
    found = [scored([answer], answer["name"]) for answer in answers]
    assert {one.outcome for one in found} <= {"answered", "unsupported"}, answers
    assert any(one.outcome == "answered" for one in found)
    for one in found:
        assert one.right(EASY[one.name]) or one.outcome == "unsupported"


class Exact:
    """A world that moves two balls without a floor exactly, if a step has one collision at most."""

    def __init__(self, problem, _):
        self.gap, self.v = problem["gaps"][0], list(problem["velocities"])
        self.mass = problem["masses"]

    def step(self, dt):
        approach = self.v[0] - self.v[1]
        self.gap -= approach * dt
        if self.gap < 0.0 < approach:
            centre = sum(m * v for m, v in zip(self.mass, self.v, strict=True)) / sum(self.mass)
            self.v = [2.0 * centre - v for v in self.v]
            self.gap = -self.gap

    def look(self):
        return [0.0, self.gap], self.v


def test_collisions_are_read_off_the_steps_of_a_world():
    problem = {
        **BY_NAME["rigid-cradle"],
        "masses": [1.0, 3.0],
        "contacts": [None, {"law": "Rigid", "restitution": 1.0}],
        "gaps": [0.01],
        "velocities": [1.0, 0.0],
    }
    answer = worlds.play(problem, Exact)
    assert answer["velocities"] == pytest.approx([-0.5, 0.5], abs=1e-15)
    assert answer["counts"] == [0, 1]
    assert answer["first_touch"] == [None, pytest.approx(0.01, rel=1e-12)]
    assert answer["last_release"] == answer["first_touch"]
    with pytest.raises(Unsupported, match="infinitely many"):
        worlds.play(BY_NAME["collapse-floor"], Exact)
