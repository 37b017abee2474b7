"""What there is to choose from: balls, contact laws, the paper's cases."""

import dataclasses
import functools
import inspect
import re
from typing import Any, get_type_hints

from stackbounce.calibration import calibrate, contact_time, restitution
from stackbounce.cross2007.cases import list_cases
from stackbounce.errors import InvalidValue
from stackbounce.json_values import as_json
from stackbounce.model import LAWS, ContactLaw, Drop, Rigid, law_named
from stackbounce.model.catalogue import BALLS, stack
from stackbounce.model.laws.table import FORMULAS
from stackbounce.version import __version__
from stackbounce.web.limits import Limits

__all__ = ["catalogue", "like", "measured_law", "stacked"]

_ELASTIC = ("Spring", "Hertz", "PowerLaw")
_DEFAULT_CONTACT_TIME = 5e-3  # s, a tennis ball's, where a rigid contact has none

# What a slider offers: the value it begins with, its ends, and what people call it.
_FIELDS: dict[str, tuple[float, float, float, str]] = {
    "stiffness": (5e3, 1e2, 1e6, "stiffness"),
    "stiffness**1.5": (2e5, 1e3, 1e10, "stiffness"),
    "exponent": (1.5, 1.0, 4.0, "exponent"),
    "damping": (2.0, 1e-2, 1e3, "damping"),
    "dissipative_time": (3e-4, 1e-6, 1e-2, "dissipative time"),
    "dissipation": (0.2, 1e-3, 10.0, "dissipation"),
    "restitution": (0.8, 0.05, 1.0, "restitution"),
    "unloading_exponent": (2.0, 1.0, 20.0, "unloading exponent"),
}


@functools.cache
def catalogue(limits: Limits) -> str:
    """Return, as JSON, what there is to choose from, and the bounds of one request."""
    presets = [
        {"name": one.name, "group": one.group, "title": one.title, "says": one.says}
        | {"drop": one.drop.to_mapping()}
        for one in list_cases()
    ]
    return as_json(
        {
            "stackbounce": __version__,
            "balls": [entry.to_mapping() for entry in BALLS],
            "laws": [_law(kind) for kind in LAWS.values()],
            "presets": presets,
            "limits": limits,
        }
    )


def _law(kind: type[ContactLaw]) -> dict[str, Any]:
    """Return a law's name, formula and numbers, and its docstring's first line and source."""
    text = inspect.getdoc(kind) or ""
    _, _, rest = text.partition("Source: ")
    source = re.split(r"\n\n|(?<=[\d)])\.\s+(?=[A-Z])|(?<=section V)\.\s", rest)[
        0
    ]  # a sentence ends after a number
    return {
        "law": kind.__name__,
        "says": text.partition("\n")[0],
        "formula": FORMULAS[kind],
        "source": " ".join(source.split()).removesuffix("."),
        "fields": [_field(kind, one) for one in dataclasses.fields(kind) if _is_number(kind, one)],
    }


def _is_number(kind: type, one: "dataclasses.Field[Any]") -> bool:
    hint = get_type_hints(kind, include_extras=True)[one.name]
    return one.init and hasattr(hint, "__metadata__")


def _field(kind: type[ContactLaw], one: "dataclasses.Field[Any]") -> dict[str, Any]:
    hint = get_type_hints(kind, include_extras=True)[one.name]
    unit = hint.__metadata__[0].symbol
    steep = one.name == "stiffness" and unit != "N/m"
    default, low, high, said = _FIELDS["stiffness**1.5" if steep else one.name]
    required = one.default is dataclasses.MISSING
    if one.name == "exponent" and isinstance(one.default, float):
        default = one.default
    return {
        "name": one.name,
        "unit": unit,
        "required": required,
        "default": default,
        "low": low,
        "high": high,
        "says": said,
    }


def stacked(names: list[str], height: float) -> str:
    """Return, as JSON, balls of the catalogue on top of each other, and where that is from."""
    chosen = stack(names)
    drop = Drop(chosen.balls, chosen.contacts, chosen.gaps, height=height)
    sources = {"contact_sources": chosen.contact_sources, "gap_sources": chosen.gap_sources}
    return as_json({"drop": drop.to_mapping()} | sources)


def measured_law(law: str, given: dict[str, float]) -> str:
    """Return, as JSON, the law of a name that has what was measured; see `calibrate`."""
    return _contact(calibrate(law_named(law), **given))


def like(
    contact: ContactLaw | None,
    to: str,
    mass: float,
    impact_speed: float,
    restitution_wanted: float | None,
    contact_time_wanted: float | None,
) -> str:
    """Return, as JSON, another law with a contact's restitution and contact time."""
    if contact is None:
        raise InvalidValue('contact must be a law to begin with, got "none"')
    kept, lasts = restitution_wanted, contact_time_wanted
    if kept is None:
        kept = restitution(contact, mass=mass, speed=impact_speed)
    if lasts is None:
        rigid = isinstance(contact, Rigid)
        lasts = (
            _DEFAULT_CONTACT_TIME if rigid else contact_time(contact, mass=mass, speed=impact_speed)
        )
    given: dict[str, float] = {"contact_time": lasts, "impact_speed": impact_speed, "mass": mass}
    if to not in _ELASTIC:
        given["restitution"] = kept
    if to == "PowerLaw":
        given["exponent"] = getattr(contact, "exponent", 1.5)
    return _contact(calibrate(law_named(to), **given))


def _contact(law: ContactLaw) -> str:
    from stackbounce.model.schema import write_law

    return as_json({"contact": write_law(law)})
