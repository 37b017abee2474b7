"""Every law in every face, and a new law that is added by one class alone."""

import dataclasses
import json
from typing import Annotated, ClassVar

import numpy as np
import pytest
from page_build.data import list_choices

import stackbounce as sb
from stackbounce.cli import main
from stackbounce.measure.kinds.waveform.analysis import waveform
from stackbounce.model import LAWS
from stackbounce.model.laws import law_named
from stackbounce.model.laws.elastic import ElasticLaw
from stackbounce.model.laws.law import ContactLaw, stiffness_in
from stackbounce.model.laws.registry import register
from synthetic.waveform import waveform as record_of

MASS, SPEED, TIME, KEPT = 0.1, 2.0, 4e-3, 0.8


class SharpCone(ElasticLaw):
    """A sharp cone on a flat floor: ``F = k c**2``."""

    formula = "F = stiffness c**2"
    source = "I. N. Sneddon, Int. J. Eng. Sci. 3, 47 (1965)"
    usual_models: ClassVar = {"SharpCone": {}}

    exponent: ClassVar[float] = 2.0
    stiffness: Annotated[float, stiffness_in("N/m**2")]


@pytest.fixture
def added():
    """Register laws for one test."""
    known = list(LAWS)
    yield register
    for name in set(LAWS) - set(known):
        del LAWS[name]


def measured(kind):
    """Return what `calibrate` is given for a class."""
    given = {"mass": MASS, "contact_time": TIME, "impact_speed": SPEED}
    if kind.loss:
        given["restitution"] = KEPT
    if not kind.rigid and kind.default_exponent() is None:
        given["exponent"] = 1.3
    return given


def alone(law):
    return sb.Drop([sb.Ball(MASS)], [law], impact_speed=SPEED)


def goes_through_every_face(kind, tmp_path, capfd):
    """Take one law through all that the package does with laws; return what the table said."""
    name = kind.__name__
    law = sb.calibrate(kind, **measured(kind))
    kept, lasts = (measure(law, MASS, SPEED) for measure in (sb.restitution, sb.contact_time))
    assert kept == pytest.approx(KEPT if kind.loss else 1.0, rel=1e-9)
    assert lasts == pytest.approx(0.0 if kind.rigid else TIME, rel=1e-9)

    result = sb.simulate(alone(law))
    assert result.status is sb.Status.FINISHED
    assert result.rebound_ratios[0] == pytest.approx(kept, rel=1e-8)
    assert result.last_release[0] == pytest.approx(lasts, rel=1e-8)
    assert sb.separate(alone(law)).contacts == (sb.Rigid(kept),)

    for field in kind.quantities():
        if field == getattr(law, "derived", None):
            continue
        balls, value = [sb.Ball(part * MASS) for part in (1.0, 0.4, 0.1)], getattr(law, field)
        laws = [law.replaced({field: other}) for other in (value, 1.05 * value or 0.01)]
        stacks = [sb.Drop(balls, [law, one, law], impact_speed=SPEED) for one in laws]
        values = [getattr(one, field) for one in laws]
        swept = sb.sweep(stacks[0], {f"contacts.1.{field}": values})
        single = [sb.simulate(stack).rebound_ratios.tolist() for stack in stacks]
        assert swept.rebound_ratio.values.tolist() == single
        assert swept.attrs["laws"] == json.dumps({name: kind.formula})

    file = tmp_path / "drop.toml"
    file.write_text(alone(law).to_toml(), encoding="utf-8")
    assert sb.Drop.from_toml(file) == alone(law)
    assert law_named(name.lower()) is kind

    assert main(["simulate", str(file), "--json"]) == 0
    assert json.loads(capfd.readouterr().out)["drop"]["contacts"] == [law.to_mapping()]
    assert main(["simulate", str(file)]) == 0
    assert law.described() in " ".join(capfd.readouterr().out.split())

    (page,) = [one for one in list_choices()["laws"] if one["law"] == name]
    assert (page["formula"], page["source"], page["says"]) == (kind.formula, kind.source, kind.says)
    assert [one["name"] for one in page["fields"]] == list(kind.quantities())
    assert page["loss_fields"] == list(kind.loss_fields or filter(None, [kind.loss]))
    return law, result


def fits_its_stiffness(law, result):
    lasting = float(result.last_release[0])
    near = dataclasses.replace(law, stiffness=1.5 * law.stiffness)
    bounds = {"contacts.0.stiffness": (0.2 * law.stiffness, 5.0 * law.stiffness)}
    data = {"durations": [f"{lasting!r} ± {1e-3 * lasting!r}"]}
    fit = sb.fit(alone(near), data, bounds)
    assert fit.drop.contacts[0].stiffness == pytest.approx(law.stiffness, rel=1e-5)


def is_told_by_a_force_record(law, result):
    record = record_of(result, rate=5e4, noise=0.01, seed=1)
    exponent = law.exponent if law.fixed_exponent() is None else None
    (contact,) = waveform(record, law=type(law), exponent=exponent).contacts
    touch = record.attrs["touch"]
    assert contact.start.nominal_value == pytest.approx(touch, abs=4e-5)
    assert contact.end.nominal_value == pytest.approx(touch + result.last_release[0], abs=2e-4)


@pytest.mark.parametrize("name", list(LAWS))
def test_every_law_says_what_people_are_shown(name):
    kind = LAWS[name]
    assert kind.says.endswith(".")
    assert kind.source in " ".join(kind.__doc__.split())
    sliders = [quantity.slider for quantity in kind.quantities().values()]
    assert all(low <= start <= high for start, low, high in sliders)


@pytest.mark.parametrize("name", list(LAWS))
def test_every_law_goes_through_every_face(name, tmp_path, capfd):
    law, result = goes_through_every_face(LAWS[name], tmp_path, capfd)
    if law.rigid:
        return
    fits_its_stiffness(law, result)
    is_told_by_a_force_record(law, result)
    assert sb.series(law, law).stiffness == pytest.approx(law.stiffness * 0.5**law.exponent)


def test_the_usual_models_are_those_that_laws_offer():
    drop = sb.Drop([sb.Ball(0.2), sb.Ball(0.1)], [sb.Spring(1e4)] * 2, impact_speed=1.0)
    offered = {name for law in LAWS.values() for name in law.usual_models}
    rigid = [name for name, law in LAWS.items() if law.rigid]
    shared = ("one restitution", "one for each contact")
    others = {f"{name}, {kept}" for name in rigid for kept in shared}
    models = sb.standard_models(drop)
    assert set(models) - offered == others
    (exponent,) = {law.exponent for law in models["Hysteretic, Hertz loading"].drop.contacts}
    assert exponent == sb.Hertz(1.0).exponent == 1.5


def test_a_new_law_with_a_known_form_of_force_is_one_class(added, tmp_path, capfd):
    cone = added(SharpCone)
    law, result = goes_through_every_face(cone, tmp_path, capfd)
    fits_its_stiffness(law, result)
    is_told_by_a_force_record(law, result)
    assert cone in LAWS.values()
    assert law.described() == f"SharpCone, stiffness {law.stiffness:.6g} N/m^2"
    power = sb.PowerLaw(law.stiffness, 2.0)
    assert np.array_equal(result.rebound_speeds, sb.simulate(alone(power)).rebound_speeds)

    models = sb.standard_models(sb.Drop([sb.Ball(0.2), sb.Ball(0.1)], [law, law], impact_speed=1.0))
    assert models["SharpCone"].drop.contacts[1].stiffness == pytest.approx(law.stiffness)


def test_a_law_without_closed_forms_is_measured_by_a_run():
    @dataclasses.dataclass(frozen=True)
    class Plain(ContactLaw):
        form: ClassVar[int] = sb.Dashpot.form
        third_number: ClassVar[str] = "damping"
        loss: ClassVar[str] = "damping"
        loss_depends_on: ClassVar[tuple[str, ...]] = ("mass",)
        exponent: ClassVar[float] = 1.0
        stiffness: float
        damping: float

    law, closed = Plain(1e4, 7.0), sb.Dashpot(1e4, 7.0)
    assert law.restitution_at(MASS, SPEED) == pytest.approx(sb.restitution(closed, MASS), rel=1e-9)
    lasts = sb.contact_time(closed, MASS)
    assert law.contact_time_at(MASS, SPEED) == pytest.approx(lasts, rel=1e-9)


@pytest.mark.parametrize(
    ("name", "bases", "own", "words"),
    [
        ("Silent", (ContactLaw,), {"says": "No."}, "Silent must set formula, source, form"),
        ("Spring", (SharpCone,), {}, r"Spring is the name of a law in stackbounce\.model"),
    ],
)
def test_a_law_that_is_incomplete_or_has_another_ones_name_is_refused(name, bases, own, words):
    known = dict(LAWS)
    with pytest.raises(TypeError, match=words):
        register(type(name, bases, own))
    assert known == LAWS
