"""The pictures of `fit.md`: what its commands draw."""

from shown import DOCS, show

import stackbounce as sb
from stackbounce import plots
from stackbounce.cross2007.datasets import load_dataset
from stackbounce.fitting import FitProblem, read_drops
from stackbounce.fitting.files import read_force_record
from stackbounce.fitting.series import fit_series, read_stack
from stackbounce.fitting.standard import usual_model

BASKETBALL, TENNIS = sb.Ball(0.150, name="basketball"), sb.Ball(0.057, name="tennis")


def _two():
    contacts = [sb.Hysteretic(2500.0, restitution=0.77), sb.Hysteretic(1000.0, restitution=0.9)]
    drop = sb.Drop([BASKETBALL, TENNIS], contacts, height=1.0, gravity=9.81)
    vary = {"contacts.1.stiffness": (500.0, 2000.0), "gaps.0": (0.0, 0.01)}
    return sb.fit(*read_drops(drop, DOCS / "fit" / "drops.csv"), vary)


def heights():
    """A table of two balls."""
    found = fit_series(DOCS / "fit" / "heights.csv", errors=["drop height = 5 mm"])
    show(plots.restitutions, found)


def stack():
    """A table of a stack."""
    table = read_stack(DOCS / "fit" / "stack.csv", ["1 cm"])
    show(plots.fit, usual_model(FitProblem(table.drops, table.data)).fit())


def force():
    """The force of the tennis ball on the sensor."""
    law = sb.Hysteretic(1e4, restitution=0.9)
    record = read_force_record("force.0", "tennis-force.csv", DOCS / "lab")
    vary = {"contacts.0.stiffness": None, "contacts.0.restitution": (0.5, 1.0)}
    show(plots.fitted, sb.fit(sb.Drop([TENNIS], [law], height=1.0), {"force.0": record}, vary))


def valley():
    """Stiffness and gap of two balls."""
    show(plots.fitted, _two())


def models():
    """The usual models of the paper's B2 on B1."""
    drop, data, _, _ = load_dataset("B1-B2")
    show(plots.compared, sb.compare(sb.standard_models(drop, times=True), data))


def draws():
    """The same, drawn from."""
    show(plots.corner, _two().sample(6_400))
