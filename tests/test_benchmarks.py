import numpy as np
import pytest
from benchmarks import figures, hard_pairs, many, pairs, race, random_drops, report, startup
from benchmarks.peers import by_scipy, by_steps
from benchmarks.peers.common import Peer
from benchmarks.random_drops import Drops

import stackbounce as sb

EASY = Drops(np.array([[1.0, 1.0, 0.0], [3.0, 0.5, 0.3], [0.4, 2.0, 0.0]]))
NONE = Peer("nobody", "a-solver-that-nobody-has", "by magic", lambda: pytest.fail("prepared"))


def quiet(_):
    pass


@pytest.fixture(scope="module")
def small():
    return race.sets(quiet, most=40, changes=3)


@pytest.mark.slow
def test_the_truth_agrees_with_fifty_digits(small):
    check = race.check(small, quiet, sample=4, hard=2)
    assert check.drops == 4 + 2 * len(random_drops.OFFSETS)
    assert check.errors.max() < 1e-13
    assert check.wrong == 0


@pytest.mark.fast_cases(1)
@pytest.mark.parametrize(
    ("peer", "tolerance"), [(by_scipy.PEER, 1e-8), (by_steps.PEER, 1e-5)], ids=["scipy", "steps"]
)
def test_a_peer_is_right_on_easy_drops(peer, tolerance):
    velocities, counts = peer.solve(EASY)
    assert velocities[0] == pytest.approx([0.7664, 1.1886], abs=1e-4)
    for row, velocity, count in zip(EASY.ratios, velocities, counts, strict=True):
        result = random_drops.simulated(row)
        assert result.status is sb.Status.FINISHED
        assert velocity == pytest.approx(result.rebound_speeds, abs=tolerance)
        assert count.tolist() == result.collisions.tolist()


@pytest.mark.slow
def test_a_missing_peer_is_skipped_with_a_word(small):
    assert not NONE.available()
    ours, steps, nobody = race.race(small, quiet, (race.OURS, by_steps.PEER, NONE), seconds=0.1)
    assert ours.wrong == dict.fromkeys(small.drops, 0.0)
    assert steps.wrong[1e-10] > 0.0
    assert not nobody.rounds
    entries = [ours, steps, nobody]
    times, counts = report.peer_times(entries), report.peer_counts(entries, 4)
    assert times[2] == ["nobody", "not installed", *["–"] * 5]
    assert counts[2] == ["nobody", *["–"] * 4]
    assert {len(row) for row in times} == {7}
    assert {len(row) for row in counts} == {5}


@pytest.mark.slow
def test_starts_are_told_next_to_numpy(monkeypatch):
    starts = startup.measure(quiet, rounds=1)
    assert [start.name for start in starts] == list(startup.STARTS)
    base = starts[1]
    assert (base.name, base.processor_ratio, base.clock_ratio) == (startup.BASE, 1.0, 1.0)
    assert min(min(start.processor, start.clock) for start in starts) > 0.0
    assert report.startup_times(starts)[1][::2] == [startup.BASE, "1.00", "1.00"]
    assert len(figures.startup(starts).axes[0].patches) == 2 * len(starts)
    monkeypatch.setattr(startup, "STARTS", dict([*startup.STARTS.items()][:3]))
    imports = report.import_times(startup.imports(quiet, rounds=1))
    assert [imports[0], imports[1][0]] == [["python", ""], startup.BASE]
    assert "numpy" in imports[1][1]


def test_no_hard_pair_has_a_wrong_number_of_contacts():
    assert [check.wrong for check in hard_pairs.measure(quiet, count=1000)] == [0] * 12


def test_a_start_is_the_median_of_its_rounds_and_of_their_ratios(monkeypatch):
    monkeypatch.setattr(startup, "STARTS", {startup.BASE: "1", "ours": "2"})
    first, rounds = [(9.0, 9.0)] * 2, [(1, 2), (3, 4), (2, 2), (4, 3), (1, 1), (8, 9)]
    spent = iter([*first, *rounds])
    monkeypatch.setattr(startup, "_spent", lambda _: next(spent))
    base, ours = startup.measure(quiet, rounds=3)
    assert base == startup.Start(startup.BASE, 1.0, 2.0, 1.0, 1.0)
    assert ours == startup.Start("ours", 4.0, 4.0, 3.0, 2.0)


@pytest.mark.slow
@pytest.mark.parametrize("law", pairs.LAWS)
def test_all_ways_solve_the_same_pairs(law, monkeypatch):
    for name, value in {"THEIRS": (1e-6,), "LEAST": 2, "SECONDS": 0.0, "ROUNDS": 1}.items():
        monkeypatch.setattr(pairs, name, value)
    entries = pairs.measure(law, quiet, count=200)
    assert min(entry.seconds for entry in entries) > 0.0
    loops = [entry.median for entry in entries if entry.way == pairs.LOOP]
    assert loops[-1] < 0.1 * loops[0] < 1e-2
    off = {entry.way: entry.median / entry.setting for entry in entries}
    assert off[pairs.LANES] < 1.0 > off[pairs.DROPS]
    assert max(off.values()) < 1e3
    assert len(report.figures.pairs(entries).axes[0].lines) == len(figures.WAYS)


def test_rigid_pairs_are_the_same_by_hand():
    assert max(entry.most for entry in pairs.rigid(quiet, count=300)) < 1e-13


@pytest.mark.slow
def test_sweeps_of_all_sizes_are_measured(monkeypatch):
    monkeypatch.setattr(many, "LAWS", {"Hertz": "sb.Hertz(1e6)"})
    found = many.measure(quiet, sizes=(1000,), shared=1000, threaded=1000, largest=False)
    assert [one.how for one in found] == ["memory"] * 3 + [many.FILE, many.WORKERS]
