"""What happens when a stack of balls hits the floor: predicted, measured, fitted, explained."""

# Nothing is imported here: importing typing alone would be most of the time until the program
# handles Ctrl+C.
TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from stackbounce.errors import StackbounceError as StackbounceError
    from stackbounce.fitting import Fit as Fit
    from stackbounce.fitting import Model as Model
    from stackbounce.fitting import Range as Range
    from stackbounce.fitting import compare as compare
    from stackbounce.fitting import fit as fit
    from stackbounce.fitting import standard_models as standard_models
    from stackbounce.fitting.series import fit_series as fit_series
    from stackbounce.measure import read as read
    from stackbounce.model import Air as Air
    from stackbounce.model import Ball as Ball
    from stackbounce.model import Bond as Bond
    from stackbounce.model import Dashpot as Dashpot
    from stackbounce.model import Drop as Drop
    from stackbounce.model import Hertz as Hertz
    from stackbounce.model import HollowBall as HollowBall
    from stackbounce.model import HuntCrossley as HuntCrossley
    from stackbounce.model import Hysteretic as Hysteretic
    from stackbounce.model import PowerLaw as PowerLaw
    from stackbounce.model import Rigid as Rigid
    from stackbounce.model import RigidBySpeed as RigidBySpeed
    from stackbounce.model import RigidLossBySpeed as RigidLossBySpeed
    from stackbounce.model import Spring as Spring
    from stackbounce.model import StandardLinearSolid as StandardLinearSolid
    from stackbounce.model import Tabulated as Tabulated
    from stackbounce.model import Viscoelastic as Viscoelastic
    from stackbounce.model import series as series
    from stackbounce.prediction import Prediction as Prediction
    from stackbounce.prediction import predict as predict
    from stackbounce.run.bounces import bounces_in_air as bounces_in_air
    from stackbounce.run.calibration import calibrate as calibrate
    from stackbounce.run.collision import contact_time as contact_time
    from stackbounce.run.collision import restitution as restitution
    from stackbounce.run.collision import separate as separate
    from stackbounce.run.driver import simulate as simulate
    from stackbounce.run.result import Result as Result
    from stackbounce.run.result import Status as Status
    from stackbounce.sweeps import sweep as sweep
    from stackbounce.towers import best_masses as best_masses
    from stackbounce.towers import highest as highest
    from stackbounce.towers import separation_limit as separation_limit
    from stackbounce.version import __version__ as __version__

# Each name is imported when it is first used, so that nothing waits for what it does not need.
_ROOMS = {
    "errors": "StackbounceError",
    "fitting": "Fit Model Range compare fit standard_models",
    "fitting.series": "fit_series",
    "measure": "read",
    "model": "Air Ball Bond Dashpot Drop Hertz HollowBall HuntCrossley Hysteretic PowerLaw Rigid "
    "RigidBySpeed RigidLossBySpeed Spring StandardLinearSolid Tabulated Viscoelastic series",
    "prediction": "Prediction predict",
    "run.bounces": "bounces_in_air",
    "run.calibration": "calibrate",
    "run.collision": "contact_time restitution separate",
    "run.driver": "simulate",
    "run.result": "Result Status",
    "sweeps": "sweep",
    "towers": "best_masses highest separation_limit",
    "version": "__version__",
}
_HOMES = {name: room for room, names in _ROOMS.items() for name in names.split()}
if not TYPE_CHECKING:  # a checker of types takes the names above
    __all__ = list(_HOMES)


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
    return sorted({*globals(), *_HOMES})
