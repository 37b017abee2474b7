"""What happens when a stack of balls hits the floor: predicted, measured, fitted, explained."""

# Checkers of types read `__init__.pyi`. Each name is imported when it is first used, and nothing
# waits for what it does not need: importing typing alone would be most of the time until the
# program handles Ctrl+C.
_ROOMS = {
    "errors": "StackbounceError",
    "explorer.notebook": "explore",
    "fitting": "Fit Model Range compare fit standard_models",
    "fitting.series": "fit_series",
    "measure": "read",
    "model": "Air Ball Bond Dashpot Drop Hertz HollowBall HuntCrossley Hysteretic PowerLaw Rigid "
    "RigidBySpeed RigidLossBySpeed Spring StandardLinearSolid Tabulated Viscoelastic laws series",
    "model.catalogue": "balls stack",
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
__all__ = list(_HOMES)

_FIRST = (  # what `dir` shows
    "Ball Drop Hysteretic Rigid Spring balls calibrate compare cross2007 datasets explore fit "
    "measure plots predict read separate simulate stack sweep"
).split()


def __getattr__(name: str) -> object:
    from importlib import import_module
    from importlib.util import find_spec

    if name in _HOMES:
        globals()[name] = getattr(import_module(f"{__name__}.{_HOMES[name]}"), name)
    elif not name.startswith("_") and find_spec(f"{__name__}.{name}"):
        import_module(f"{__name__}.{name}")  # which sets it
    else:
        from stackbounce.errors import no_attribute

        raise no_attribute(import_module(__name__), name)
    return globals()[name]


def __dir__() -> list[str]:
    return _FIRST
