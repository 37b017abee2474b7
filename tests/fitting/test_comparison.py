"""Several models of the same data: scores, the usual models, refusals."""

import math
from dataclasses import replace

import pytest

import stackbounce as sb
from stackbounce.errors import InvalidType, InvalidValue
from stackbounce.fitting.standard import calibration_speed

BALLS = [sb.Ball(0.150), sb.Ball(0.057)]
SPRINGS = [sb.Spring(2500.0), sb.Spring(1000.0)]


def seen_of(drop, contacts):
    """Return the rebound ratios of a drop with other contacts as data."""
    ratios = sb.simulate(replace(drop, contacts=contacts)).rebound_ratios
    return {"rebound_ratios": [(ratio, 0.01) for ratio in ratios]}


def test_pulls_are_those_of_each_fit():
    drops = at_speeds(BALLS, SPRINGS, (1, 3))
    data = {key: seen_of(drop, SPRINGS[::-1]) for key, drop in drops.items()}
    usual = sb.standard_models(drops)
    models = {name: usual[name] for name in ("Rigid, one restitution", "Spring")}
    compared = sb.compare(models, data, starts=4)
    assert compared.pulls.dims == ("model", "datum")
    for name, found in compared.fits.items():
        total = float((compared.pulls.sel(model=name) ** 2).sum())
        assert total == pytest.approx(found.chi_squared, abs=1e-9)


def test_a_model_that_is_there_twice_shares_its_row():
    drop = sb.Drop(BALLS, [sb.Rigid(0.8), sb.Rigid(0.9)], impact_speed=3.0)
    model = sb.Model(drop, {"contacts.0.restitution": (0.1, 1.0)})
    (score,) = sb.compare({"one": model, "same": model}, seen_of(drop, drop.contacts)).scores
    assert (score.model, score.same_as, score.weight) == ("one", ("same",), 1.0)


def test_a_model_with_more_numbers_than_data_is_refused_by_name():
    drop = sb.Drop(BALLS, SPRINGS, impact_speed=3.0)
    data = {"rebound_ratios": ["0.2 ± 0.02", "1.6 ± 0.02"]}
    compared = sb.compare(sb.standard_models(drop), data)
    assert "HuntCrossley" in compared.refused
    assert "3 numbers" in compared.refused["HuntCrossley"]
    assert compared.criterion == "bic"  # AICc needs two data more than numbers
    usual = {"HuntCrossley": sb.standard_models(drop)["HuntCrossley"]}
    with pytest.raises(InvalidValue, match=r"no model can be fitted: HuntCrossley: .*3 numbers"):
        sb.compare(usual, {"rebound_ratios.0": "0.2 ± 0.02"})


def at_speeds(balls, contacts, speeds):
    return {f"at_{speed}": sb.Drop(balls, contacts, impact_speed=float(speed)) for speed in speeds}


def test_usual_models_last_as_long_as_the_given_contacts_at_the_mean_speed():
    drops = at_speeds(BALLS, SPRINGS, (1, 3, 9))
    assert calibration_speed(drops) == pytest.approx(3.0)
    masses = [0.150, (0.150, 0.057)]  # in each contact
    longest = max(map(sb.contact_time, SPRINGS, masses))
    for model in sb.standard_models(drops).values():
        (contacts,) = {drop.contacts for drop in model.drops.values()}  # the same in all drops
        if not next(iter(contacts)).rigid:
            assert model.vary["gaps.0"] == pytest.approx((0.0, 4.0 * 3.0 * longest))
        for law, spring, mass in zip(contacts, SPRINGS, masses, strict=True):
            if law.rigid:
                continue
            wanted = sb.contact_time(spring, mass)
            assert sb.contact_time(law, mass, 3.0) == pytest.approx(wanted, rel=1e-6)


def test_drops_of_other_stacks_have_no_usual_models_together():
    both, alone = (sb.Drop(BALLS[:n], SPRINGS[:n], impact_speed=3.0) for n in (2, 1))
    models = sb.standard_models({"alone": alone, "both": both})
    contacts = {key: drop.contacts for key, drop in models["Spring"].drops.items()}
    assert contacts["alone"] == contacts["both"][:1]
    assert list(models["Spring"].vary) == ["contacts.1.stiffness", "gaps.0"]
    for changed in ({"balls": BALLS[::-1]}, {"contacts": SPRINGS[::-1]}):
        other = replace(both, **changed)
        with pytest.raises(InvalidValue, match="other has another mass or contact at place 0"):
            sb.standard_models({"both": both, "other": other})


def test_a_model_with_nothing_to_vary_is_left_out():
    drops = at_speeds(BALLS[:1], SPRINGS[:1], (1, 3))
    assert {"Spring", "Hertz", "Viscoelastic"} <= set(sb.standard_models(drops, times=True))
    models = sb.standard_models(drops)
    assert {"Spring", "Hertz"}.isdisjoint(models)
    assert all(model.vary for model in models.values())


def test_models_that_are_not_told_apart_share_a_row_and_a_weight():
    drops = at_speeds(BALLS[:1], SPRINGS[:1], (1, 2, 3, 4))
    data = {key: {"rebound_ratios.0": (0.8, 0.01)} for key in drops}
    usual = sb.standard_models(drops)
    some = ("Hysteretic", "HuntCrossley", "Rigid, one restitution")
    compared = sb.compare({name: usual[name] for name in some}, data, starts=4)
    first, second = compared.scores
    assert (first.model, first.same_as) == ("Hysteretic", ("Rigid, one restitution",))
    assert first.title == "Hysteretic\n= Rigid, one restitution"
    assert first.parameters == 4 - first.degrees_of_freedom == 1
    assert (second.model, second.same_as) == ("HuntCrossley", ())
    assert sum(score.weight for score in compared.scores) == pytest.approx(1.0)
    ratio = math.exp(0.5 * (first.aicc - second.aicc))
    assert second.weight == pytest.approx(ratio * first.weight)


def test_the_power_of_the_speed_is_fitted():
    law = sb.RigidBySpeed(0.7, 2.0, speed_exponent=0.3)
    drops = at_speeds(BALLS, SPRINGS, (1, 2, 4))
    data = {key: seen_of(drop, [law, law]) for key, drop in drops.items()}
    model = sb.standard_models(drops)["RigidBySpeed, one restitution"]
    found = replace(model, data=data).fit(starts=16)
    assert found.chi_squared < 1e-6
    assert found["speed_exponent"].nominal_value == pytest.approx(0.3, abs=1e-4)
    assert found["restitution"].nominal_value == pytest.approx(0.7, abs=1e-4)


def test_an_error_names_its_model():
    soft = sb.Model(sb.Drop(BALLS, SPRINGS, impact_speed=3.0), ["contacts.7.stiffness"])
    with pytest.raises(InvalidValue, match=r"^soft: contacts\.7\.stiffness"):
        sb.compare({"soft": soft}, {"rebound_ratios.0": (0.2, 0.02)})


def test_rigid_stacks_and_no_floor_have_no_usual_models():
    for contacts in ([sb.Rigid(0.8), sb.Rigid(0.8)], [None, sb.Spring(1.0)]):
        drop = sb.Drop(BALLS, contacts, velocities=[-1.0, -2.0])
        with pytest.raises(InvalidValue, match="finite contacts"):
            sb.standard_models(drop)


@pytest.mark.parametrize("models", [{}, {"a": 1}, {1: None}])
def test_what_is_no_model_is_refused(models):
    with pytest.raises(InvalidType, match="models must map names to Models"):
        sb.compare(models, {"rebound_ratios.0": "0.2 ± 0.02"})
