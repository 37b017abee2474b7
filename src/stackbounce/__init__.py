"""What happens when a stack of balls hits the floor: predicted, measured, fitted, explained."""

# Nothing is imported here: importing typing alone would be most of the time until the program
# handles Ctrl+C.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from stackbounce.errors import StackbounceError
    from stackbounce.fitting import Fit, Model, Range, compare, fit, standard_models
    from stackbounce.measure import read
    from stackbounce.model import (
        Air,
        Ball,
        Bond,
        Dashpot,
        Drop,
        Hertz,
        HollowBall,
        HuntCrossley,
        Hysteretic,
        PowerLaw,
        Rigid,
        RigidBySpeed,
        RigidLossBySpeed,
        Spring,
        StandardLinearSolid,
        Tabulated,
        Viscoelastic,
        series,
    )
    from stackbounce.prediction import Prediction, predict
    from stackbounce.run.bounces import bounces_in_air
    from stackbounce.run.calibration import calibrate
    from stackbounce.run.collision import contact_time, restitution, separate
    from stackbounce.run.driver import simulate
    from stackbounce.run.result import Result, Status
    from stackbounce.sweeps import sweep
    from stackbounce.towers import best_masses, highest, separation_limit
    from stackbounce.version import __version__

__all__ = [
    "Air",
    "Ball",
    "Bond",
    "Dashpot",
    "Drop",
    "Fit",
    "Hertz",
    "HollowBall",
    "HuntCrossley",
    "Hysteretic",
    "Model",
    "PowerLaw",
    "Prediction",
    "Range",
    "Result",
    "Rigid",
    "RigidBySpeed",
    "RigidLossBySpeed",
    "Spring",
    "StackbounceError",
    "StandardLinearSolid",
    "Status",
    "Tabulated",
    "Viscoelastic",
    "__version__",
    "best_masses",
    "bounces_in_air",
    "calibrate",
    "compare",
    "contact_time",
    "fit",
    "highest",
    "predict",
    "read",
    "restitution",
    "separate",
    "separation_limit",
    "series",
    "simulate",
    "standard_models",
    "sweep",
]

# Each name is imported when it is first used, so that nothing waits for what it does not need.
_ROOMS = {
    "errors": ("StackbounceError",),
    "fitting": ("Fit", "Model", "Range", "compare", "fit", "standard_models"),
    "measure": ("read",),
    "prediction": ("Prediction", "predict"),
    "run.calibration": ("calibrate",),
    "run.collision": ("contact_time", "restitution", "separate"),
    "run.driver": ("simulate",),
    "run.result": ("Result", "Status"),
    "run.bounces": ("bounces_in_air",),
    "sweeps": ("sweep",),
    "towers": ("best_masses", "highest", "separation_limit"),
    "version": ("__version__",),
}
_HOMES = dict.fromkeys(__all__, "model") | {
    name: room for room, names in _ROOMS.items() for name in names
}


def __getattr__(name: str) -> "Any":
    from importlib import import_module
    from importlib.util import find_spec

    if name in _HOMES:
        globals()[name] = getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
    elif not name.startswith("_") and find_spec(f"{__name__}.{name}"):
        import_module(f"{__name__}.{name}")  # which sets it
    else:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return globals()[name]


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
