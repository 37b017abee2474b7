"""The models that the study compares, by their short names."""

import math

from stackbounce import HuntCrossley, Hysteretic, StandardLinearSolid, Viscoelastic
from studies.table2.inputs import PRINTED
from studies.table2.theories import ELASTIC, OWN, SHARED, Theory

AS_PRINTED = {f"e_{ball}": value for ball, value in PRINTED.items()}
"""Table I's COR taken as restitutions."""

AS_HEIGHTS = {name: math.sqrt(value) for name, value in AS_PRINTED.items()}
"""Table I's COR taken as ratios of heights; the restitution is the square root."""

MISPRINT = {**AS_PRINTED, "e_B1": 0.88}
"""B1's 0.78 taken as a misprint of 0.88."""

_BOTH = ("e_B1", "e_B2")
_SMALL = {"e_B2": PRINTED["B2"]}

THEORIES: dict[str, Theory] = {
    "Hertz": Theory("elastic balls (Hertz), nothing is lost", HuntCrossley, ELASTIC),
    "A": Theory("loss at the floor only, Table I as printed", HuntCrossley, ELASTIC, AS_PRINTED),
    "A, fitted": Theory(
        "loss at the floor only, two restitutions", HuntCrossley, ELASTIC, {}, _BOTH
    ),
    "P": Theory(
        "the paper's law, linear hysteresis at the floor only, as printed",
        Hysteretic,
        ELASTIC,
        AS_PRINTED,
        exponent=1.0,
    ),
    "P, fitted": Theory(
        "the paper's law, two restitutions",
        Hysteretic,
        ELASTIC,
        {},
        _BOTH,
        exponent=1.0,
    ),
    "X": Theory("loss in every contact, Table I as printed", HuntCrossley, SHARED, AS_PRINTED),
    "S": Theory("loss in every contact, roots of Table I", HuntCrossley, SHARED, AS_HEIGHTS),
    "S, one factor": Theory(
        "loss in every contact, one factor on Table I's losses",
        HuntCrossley,
        SHARED,
        AS_PRINTED,
        ("loss",),
    ),
    "S, fitted": Theory("loss in every contact, two restitutions", HuntCrossley, SHARED, {}, _BOTH),
    "V": Theory(
        "viscoelastic spheres in every contact, two restitutions", Viscoelastic, SHARED, {}, _BOTH
    ),
    "H": Theory(
        "hysteresis in every contact, B1's restitution", Hysteretic, SHARED, _SMALL, ("e_B1",)
    ),
    "H, fitted": Theory(
        "hysteresis in every contact, two restitutions", Hysteretic, SHARED, {}, _BOTH
    ),
    "H, linear": Theory(
        "the same from linear springs", Hysteretic, SHARED, {}, _BOTH, exponent=1.0
    ),
    "Z": Theory(
        "linear solid that relaxes in every contact, two restitutions",
        StandardLinearSolid,
        SHARED,
        {},
        _BOTH,
        exponent=1.0,
    ),
    "Z, time": Theory(
        "as Z, and relaxation time over contact time",
        StandardLinearSolid,
        SHARED,
        {},
        (*_BOTH, "relaxation"),
        exponent=1.0,
    ),
    "B": Theory(
        "hysteresis: B1 on the floor, and any two balls",
        Hysteretic,
        OWN,
        _SMALL,
        ("e_B1", "e_between"),
    ),
    "S, six": Theory(
        "loss in every contact, six numbers fitted",
        HuntCrossley,
        SHARED,
        {},
        ("e_B1", "e_B2", "e_B3", "exponent", "between", "stiffer"),
    ),
}
"""The models with finite contacts; `NAMES` has those with separate collisions."""

CHOSEN = ("A", "S", "H", "B")
"""The models whose predictions are shown: a loss at the floor only, and three that fit better."""

FLOOR_ONLY = ("A", "A, fitted", "P", "P, fitted")
"""The models that lose energy at the floor only, the paper's idea; P has its law (section V)."""

NAMES = {"rigid, one": ("e",), "rigid, two": ("e_floor", "e_between")}
"""The models with separate collisions, and the restitutions that they fit."""
