"""The note on an outlier: it comes where one number makes chi squared unlikely, and names it."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

import stackbounce as sb
from stackbounce.fitting import FitProblem

SPEEDS = (1.0, 2.0, 3.0, 4.0)
TIME, RATIO = 1e-4, 0.01  # errors
VARY = {"contacts.0.stiffness": (1e4, 4e4), "contacts.0.damping": (1.0, 20.0)}


def problem(shifts, law=None):
    """Return a ball at four speeds, with contact times and ratios that are so many errors off."""
    drop = sb.Drop([sb.Ball(0.1)], [sb.Dashpot(2e4, 5.0)], impact_speed=1.0)
    drops = {f"at{speed:.0f}": replace(drop, impact_speed=speed) for speed in SPEEDS}
    data = {}
    for (name, drop), (late, fast) in zip(drops.items(), np.reshape(shifts, (-1, 2)), strict=True):
        found = sb.simulate(drop if law is None else replace(drop, contacts=[law]))
        data[name] = {
            "durations.0": (float(found.last_release[0]) + late * TIME, TIME),
            "rebound_ratios.0": (float(found.rebound_ratios[0]) + fast * RATIO, RATIO),
        }
    return FitProblem(drops, data, VARY)


def shifted(**errors):
    names = [f"at{speed:.0f}_{what}" for speed in SPEEDS for what in ("durations", "ratios")]
    return [errors.get(name, 0.0) for name in names]


def outlier(found):
    """Return the number that a fit calls an outlier; empty for none."""
    start = "one number makes chi squared improbable: "
    told = [note.removeprefix(start) for note in found.notes if note.startswith(start)]
    return told[0].split()[0] if told else ""


@pytest.mark.parametrize("size", [4.5, 8.0])
def test_one_number_far_off_is_named_with_what_is_likely_without_it(size):
    whole = problem(shifted(at2_ratios=size, at3_durations=1.0))
    found = whole.fit()
    (note,) = found.notes  # and the model is not blamed
    assert outlier(found) == "at2.rebound_ratios.0"
    assert found.probability < 0.05
    rest = {key: dict(own) for key, own in whole.data.items()}
    del rest["at2"]["rebound_ratios.0"]
    without = replace(whole, data=rest).fit().probability
    assert f"without it p is {without:.2g} instead of " in note


def test_a_model_that_is_wrong_for_many_numbers_has_no_outlier():
    found = problem(shifted(), sb.HuntCrossley(2e5, exponent=1.5, dissipation=0.1)).fit()
    assert not outlier(found)
    assert "the model does not describe the data" in found.notes[0]


def test_a_number_that_chance_may_explain_is_no_outlier():
    """One of eight numbers is 2.6 errors off in one fit of fourteen."""
    found = problem(shifted(at2_ratios=2.6, at3_durations=2.4, at4_ratios=-2.0)).fit()
    assert 1e-3 < found.probability < 0.05
    assert found.notes == ()


def test_two_numbers_that_contradict_each_other_are_no_outliers():
    """With one degree of freedom every number explains chi squared as well as any other."""
    drop = sb.Drop([sb.Ball(0.1)], [sb.Spring(2e4)], impact_speed=1.0)
    drops = {"a": drop, "b": drop}
    data = {"a": {"durations.0": (7e-3, 1e-4)}, "b": {"durations.0": (8e-3, 1e-4)}}
    found = sb.fit(drops, data, {"contacts.0.stiffness": (1e4, 4e4)})
    assert found.probability < 1e-9
    assert not outlier(found)


@pytest.mark.slow
def test_how_often_the_outlier_is_named():
    """Normal errors, with one number of eight 5 errors further off, and without."""
    random = np.random.default_rng(21)
    seen = {True: Counter(), False: Counter()}
    for spoiled, counts in seen.items():
        for _ in range(50):
            shifts, k = random.standard_normal(8), int(random.integers(8))
            shifts[k] += 5.0 * spoiled * random.choice([-1.0, 1.0])
            found = problem(shifts).fit()
            if found.probability < 0.05:
                named = outlier(found)
                own = found.residuals[k].label if spoiled else ""
                counts["named" if named == own else "another" if named else "none"] += 1
    assert seen[True].total() > 40
    assert seen[True]["named"] > 0.8 * seen[True].total()
    assert seen[True]["another"] <= 1
    assert seen[False]["another"] <= 2
