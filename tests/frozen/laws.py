"""Contact laws: maps of what a pair does under each, what is measured of them, and their texts."""

import itertools
from collections.abc import Iterator
from typing import Any

import numpy as np

import stackbounce as sb
from frozen.lines import lines

LAWS: dict[str, tuple[Any, Any]] = {  # of the floor, and between two balls of 0.1 kg at 1 m/s
    "Rigid": (sb.Rigid(0.9), sb.Rigid(0.6)),
    "RigidBySpeed": (
        sb.RigidBySpeed(0.9, 1.0),
        sb.RigidBySpeed(0.6, 0.5, 0.4, scatter=0.05, seed=3),
    ),
    "RigidLossBySpeed": (
        sb.RigidLossBySpeed(0.8, 3.0, 0.43),
        sb.RigidLossBySpeed(0.6, 0.5, scatter=0.05, seed=3),
    ),
    "Spring": (sb.Spring(1e4), sb.Spring(1e4)),
    "Hertz": (sb.Hertz(1e6), sb.Hertz(1e6)),
    "PowerLaw": (sb.PowerLaw(1e5, 1.3), sb.PowerLaw(1e6, 2.0)),
    "Dashpot": (sb.Dashpot(1e4, 5.0), sb.Dashpot(1e4, 80.0)),
    "StandardLinearSolid": (
        sb.StandardLinearSolid(1e4, 0.5, 2e-3),
        sb.StandardLinearSolid(1e4, 4.0, 1e-3),
    ),
    "Viscoelastic": (sb.Viscoelastic(1e6, 1e-4), sb.Viscoelastic(1e6, 1e-3)),
    "HuntCrossley": (sb.HuntCrossley(1e6, 1.5, 0.2), sb.HuntCrossley(1e4, 1.0, 2.0)),
    "Hysteretic": (
        sb.Hysteretic(1e4, restitution=0.8),
        sb.Hysteretic(1e6, exponent=1.5, unloading_exponent=3.0),
    ),
    "Hysteretic, linear": (
        sb.Hysteretic(1e4, restitution=0.8),
        sb.Hysteretic(1e4, exponent=1.0, restitution=0.7),
    ),
    "HollowBall": (sb.HollowBall(1e4, 1e-3, 0.3, 0.8), sb.HollowBall(4e4, 5e-4, 0.2, 0.7)),
}
MASS_RATIOS = np.geomspace(0.05, 20.0, 20)
STIFFNESS_RATIOS = np.geomspace(0.1, 50.0, 15)
RESTITUTIONS = np.linspace(0.1, 1.0, 15)  # of rigid floors, which have no stiffness
GAP, GRAVITY = 2e-3, 9.81
EVENTS = 2000
MASSES, SPEEDS = (0.01, 0.1, 2.0), (0.03, 1.0, 10.0)
TIMES, RATIOS = (5e-4, 5e-3, 0.05), (0.2, 0.6, 0.9, 1.0)


def answers() -> Iterator[str]:
    """Yield lines of maps, single values, and texts for each law."""
    for name, pair in LAWS.items():
        yield from lines(name, {"maps": _maps(*pair), "texts": _texts(*pair)})
        for place, law in zip(("floor", "balls"), pair, strict=True):
            yield from lines(f"{name}/{place}", _measures(law))
        if "," not in name:
            yield from lines(f"{name}/calibrated", _calibrated(type(pair[0])))
    yield from lines("series", _series())


def _maps(floor: Any, between: Any) -> dict[str, Any]:
    """Return the outcome over mass and stiffness ratio, with and without gap and gravity."""
    maps = {}
    for gap, gravity in itertools.product((0.0, GAP), (0.0, GRAVITY)):
        drop = sb.Drop(
            [sb.Ball(0.1), sb.Ball(0.1)], [floor, between], [gap], impact_speed=1.0, gravity=gravity
        )
        varied = {"balls.0.mass": 0.1 * MASS_RATIOS}
        if isinstance(floor, sb.Rigid):
            varied["contacts.0.restitution"] = RESTITUTIONS
        else:
            varied["contacts.0.stiffness"] = floor.stiffness * STIFFNESS_RATIOS
        maps[f"gap {gap:g}, gravity {gravity:g}"] = _map(sb.sweep(drop, varied, event_limit=EVENTS))
    return maps


def _map(found: Any) -> dict[str, Any]:
    """Return all numbers of a sweep; the rebound ratios by the mass ratio."""
    whole = {str(name): found[name].values for name in found.variables if name != "rebound_ratio"}
    ratios = found.rebound_ratio.values
    return whole | {"ratios": dict(enumerate(ratios.reshape(len(MASS_RATIOS), -1, 2)))}


def _measures(law: Any) -> dict[str, Any]:
    """Return restitution and contact time over masses and speeds."""
    return {
        what.__name__: {
            f"{mass:g} kg, {speed:g} m/s": _tried(what, law, mass, speed)
            for mass, speed in itertools.product(MASSES, SPEEDS)
        }
        for what in (sb.restitution, sb.contact_time)
    }


def _calibrated(kind: Any) -> dict[str, Any]:
    """Return the laws that have given contact times and restitutions."""
    found = {}
    exponents = {sb.PowerLaw: (1.2, 2.5), sb.HuntCrossley: (None, 1.0), sb.Hysteretic: (None, 1.5)}
    for time, kept, exponent in itertools.product(TIMES, RATIOS, exponents.get(kind, (None,))):
        asked = {"mass": 0.057, "impact_speed": 3.0, "contact_time": time, "restitution": kept}
        if exponent is not None:
            asked["exponent"] = exponent
        law = _tried(lambda known=asked: sb.calibrate(kind, **known))
        found[f"{time:g} s, {kept:g}, exponent {exponent}"] = repr(law)
    return found


def _tried(what: Any, *given: Any) -> Any:
    """Return what a function gives, or what it raises."""
    try:
        return what(*given)
    except sb.StackbounceError as error:
        return f"{type(error).__name__}: {error}"


def _texts(floor: Any, between: Any) -> dict[str, Any]:
    """Return a drop as a scenario file, and as a mapping, and whether it comes back."""
    drop = sb.Drop(
        [sb.Ball(0.15, diameter=0.16, name="low"), sb.Ball(0.057)],
        [floor, between],
        [GAP],
        height=0.63,
        gravity=GRAVITY,
    )
    text = drop.to_toml()
    return {
        "toml": text,
        "mapping": drop.to_mapping(),
        "separate": repr(sb.separate(drop).to_mapping()),
        "meaning": (type(floor).__doc__ or "").split("\n")[0],
        "comes back": sb.Drop.from_mapping(drop.to_mapping()) == drop,
        "hash": hash(floor) == hash(sb.Drop.from_mapping(drop.to_mapping()).contacts[0]),
    }


def _series() -> dict[str, Any]:
    """Return what laws in series are, and contacts from size and material."""
    steel = sb.Ball(0.0286, diameter=0.0191, young_modulus=210e9, poisson_ratio=0.3)
    found = {"steel": repr(sb.Hertz.between(steel, steel)), "floor": repr(sb.Hertz.between(steel))}
    for (name, pair), (other, pair_of_other) in itertools.combinations_with_replacement(
        LAWS.items(), 2
    ):
        found[f"{name} and {other}"] = repr(_tried(sb.series, pair[0], pair_of_other[1]))
    return found
