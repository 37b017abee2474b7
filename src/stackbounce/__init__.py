"""What happens when a stack of balls hits the floor: predicted, measured, fitted, explained."""

import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from stackbounce.calibrate import calibrate, contact_time, restitution, separate
    from stackbounce.design import best_masses, highest, transition
    from stackbounce.errors import StackbounceError
    from stackbounce.fit import Fit, Model, Range, compare, fit, standard_models
    from stackbounce.measure import read
    from stackbounce.model import (
        Ball,
        Dashpot,
        Drop,
        Hertz,
        HuntCrossley,
        Hysteretic,
        PowerLaw,
        Rigid,
        Spring,
        Viscoelastic,
        series,
    )
    from stackbounce.result import Result, Status
    from stackbounce.simulate import simulate
    from stackbounce.sweep import sweep
    from stackbounce.version import __version__

__all__ = [
    "Ball",
    "Dashpot",
    "Drop",
    "Fit",
    "Hertz",
    "HuntCrossley",
    "Hysteretic",
    "Model",
    "PowerLaw",
    "Range",
    "Result",
    "Rigid",
    "Spring",
    "StackbounceError",
    "Status",
    "Viscoelastic",
    "__version__",
    "best_masses",
    "calibrate",
    "compare",
    "contact_time",
    "fit",
    "highest",
    "read",
    "restitution",
    "separate",
    "series",
    "simulate",
    "standard_models",
    "sweep",
    "transition",
]

# Each name is imported when it is first used, so that nothing waits for what it does not need.
_ROOMS = {
    "calibrate": ("calibrate", "contact_time", "restitution", "separate"),
    "design": ("best_masses", "highest", "transition"),
    "errors": ("StackbounceError",),
    "fit": ("Fit", "Model", "Range", "compare", "fit", "standard_models"),
    "measure": ("read",),
    "result": ("Result", "Status"),
    "simulate": ("simulate",),
    "sweep": ("sweep",),
    "version": ("__version__",),
}
_HOMES = dict.fromkeys(__all__, "model") | {
    name: room for room, names in _ROOMS.items() for name in names
}


class _Front(ModuleType):
    """The package, of which `calibrate`, `fit`, `simulate` and `sweep` are functions.

    Python sets each submodule as an attribute of its package once it is imported: those of the
    same names would hide them.
    """

    def __setattr__(self, name: str, value: Any) -> None:
        if not (name in _HOMES and isinstance(value, ModuleType)):
            super().__setattr__(name, value)


def __getattr__(name: str) -> Any:
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


sys.modules[__name__].__class__ = _Front
