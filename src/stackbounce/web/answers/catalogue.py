"""What there is to choose from: balls, contact laws, the paper's cases."""

import dataclasses
import functools
from typing import Any

from stackbounce.calibration import calibrate, contact_time, restitution
from stackbounce.cross2007.cases import list_cases
from stackbounce.errors import InvalidValue
from stackbounce.json_values import as_json
from stackbounce.model import LAWS, ContactLaw, Drop, law_named
from stackbounce.model.catalogue import BALLS, stack
from stackbounce.version import __version__
from stackbounce.web.limits import Limits

__all__ = ["catalogue", "like", "measured_law", "stacked"]

_DEFAULT_CONTACT_TIME = 5e-3  # s, a tennis ball's, where a rigid contact has none


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
    """Return what the page shows of a law, and what it has to know of it."""
    defaults = {one.name: one.default for one in dataclasses.fields(kind)}  # type: ignore[arg-type]
    fields = []
    for name, number in kind.quantities().items():
        given = defaults[name]
        default, low, high = number.slider
        fields.append(
            {
                "name": name,
                "unit": number.symbol,
                "required": given is dataclasses.MISSING,
                "default": given if isinstance(given, float) else default,
                "low": low,
                "high": high,
                "says": name.replace("_", " "),
            }
        )
    return {
        "law": kind.__name__,
        "says": kind.says,
        "formula": kind.formula,
        "source": kind.source,
        "fields": fields,
        "loses": bool(kind.loss),
        "rigid": kind.rigid,
        "exact": kind.exact,
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
        lasts = contact_time(contact, mass=mass, speed=impact_speed) or _DEFAULT_CONTACT_TIME
    law = law_named(to)
    given: dict[str, float] = {"contact_time": lasts, "impact_speed": impact_speed, "mass": mass}
    if law.loss:
        given["restitution"] = kept
    if law.default_exponent() is None and not law.rigid:
        given["exponent"] = getattr(contact, "exponent", 1.5)
    return _contact(calibrate(law, **given))


def _contact(law: ContactLaw) -> str:
    return as_json({"contact": law.to_mapping()})
