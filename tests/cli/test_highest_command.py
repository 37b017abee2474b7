"""The command highest: tables, JSON, files, and what it refuses."""

from pathlib import Path

import pytest

import stackbounce as sb

RIGID = ["--contact", "Rigid restitution=1"] * 3


def test_highest_for_machines_and_to_a_file(told):
    words = ["B1", "B2", "B3", "--balls", "3", "--gap", "1mm", "--speed", "2", "--law", "spring"]
    found = told("highest", *words, "--save", "best.toml")
    ds = sb.highest(["B1", "B2", "B3"], 3, gaps=[0.001], law=sb.Spring, impact_speed=2.0)
    assert [stack["balls"] for stack in found["stacks"]] == ds.balls.values.tolist()
    assert [stack["height_ratio"] for stack in found["stacks"]] == ds.height_ratio.values.tolist()
    assert (found["gap"], found["impact_speed"]) == ([0.001], 2.0)
    best = sb.simulate(sb.Drop.from_toml("best.toml"))
    assert best.rebound_ratios == pytest.approx(ds.rebound_ratio.values[0, 0], abs=1e-12)


def test_highest_of_balls_that_have_a_file_each(printed):
    for name, mass in (("a", 0.2), ("b", 0.02)):
        drop = sb.Drop([sb.Ball(mass, name=name)], [sb.Spring(1e4)], height=1.0)
        Path(f"{name}.toml").write_text(drop.to_toml(), encoding="utf-8")
    words = ["a.toml", "b.toml", "--balls", "2", "--gap", "1mm", "--height", "1m", "--rows", "1"]
    out = printed("highest", *words)
    assert "The best 1 of 2 stacks, at 4.429 m/s" in out  # sqrt(2 * 9.80665)
    assert "Top ball, with gaps of 1.000 mm" in out
    balls, laws = [sb.Ball(0.2), sb.Ball(0.02)], [sb.Spring(1e4), sb.Spring(5e3)]
    height = sb.simulate(sb.Drop(balls, laws, gaps=[1e-3], height=1.0)).rebound_ratios[1]
    assert f"{height:.3f}" in next(line for line in out.splitlines() if line.startswith("a + b"))


def test_the_best_masses_for_machines_and_to_a_file(told):
    words = ["B1", "B2", "B3", *RIGID, "--masses", "--save", "best.toml"]
    found = told("highest", *words)
    masses = {stack["name"]: stack["masses"] for stack in found["stacks"]}
    best, means = (masses[f"B1 + 29.3 g + B3 ({n})"] for n in ("best masses", "geometric means"))
    assert best[1] == pytest.approx((0.101 * 0.0085) ** 0.5, rel=1e-5)
    assert means[1] == pytest.approx((0.101 * 0.0085) ** 0.5)
    assert masses["B1 + B2 + B3"] == [0.101, 0.0248, 0.0085]
    assert (found["at_the_end"], found["gap"]) == ([], [None])
    assert sb.Drop.from_toml("best.toml").balls[1].mass == best[1]


@pytest.mark.slow
def test_it_says_when_the_best_masses_lie_beyond(printed):
    out = printed("highest", "B1", "B2", "B3", "--in-order", "--within", "40g:50g")
    assert "The mass of ball 1 lies at the end of what was tried, 0.04 kg to 0.05 kg" in out
    assert out.count("B1 + ") == 3
