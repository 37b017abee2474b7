"""The balls, contact laws and examples that the page offers, and laws from measurements."""

import dataclasses
import functools
from typing import Any

from stackbounce.cross2007.cases import list_cases
from stackbounce.explorer.answers.examples import list_examples
from stackbounce.explorer.limits import Limits
from stackbounce.json_values import as_json
from stackbounce.model import LAWS, ContactLaw, Drop, Hysteretic, Rigid, law_named
from stackbounce.model.catalogue import BALLS, CLASS_BALLS, stack
from stackbounce.run import calibration, collision
from stackbounce.version import __version__

__all__ = [
    "DEFAULT_CONTACT",
    "DEFAULT_CONTACT_TIME",
    "DEFAULT_EXPONENT",
    "calibrate_law",
    "convert_law",
    "list_choices",
    "stack_balls",
]

DEFAULT_CONTACT_TIME = 5e-3
"""In s, a tennis ball's, where a rigid contact has none of its own."""

DEFAULT_CONTACT = Rigid(0.8)
"""In place of no floor."""

DEFAULT_EXPONENT = 1.5
"""Of a law with a free exponent, in place of a law without one."""

_WORDS = {
    "stiffness": (
        "how stiff",
        "Force over compression. A stiffer contact is pressed less, for a shorter time.",
    ),
    "exponent": (
        "how it stiffens",
        "1: the force grows as that of a spring. 1.5: it grows faster, as that of a solid ball.",
    ),
    "restitution": (
        "how bouncy",
        "The speed after a bounce over the speed before it: 1 loses nothing, 0 does not bounce.",
    ),
    "speed": (
        "at which speed",
        "The speed of a collision that has this restitution. Slower ones lose less.",
    ),
    "speed_exponent": (
        "how it depends on the speed",
        "0: the same at all speeds. The larger, the more the restitution changes with the speed.",
    ),
    "scatter": (
        "how much it varies",
        "By how much the restitution differs from one bounce to the next, by chance.",
    ),
    "seed": (
        "which chance",
        "Another number gives other chances; the same number gives the same bounces again.",
    ),
    "damping": (
        "how it brakes",
        "A force against the motion while the two touch: the faster, the larger. It takes energy.",
    ),
    "dissipation": (
        "how it brakes",
        "A force against the motion: the faster and the harder pressed, the larger.",
    ),
    "dissipative_time": (
        "how it brakes",
        "The longer this time, the more energy a fast contact takes.",
    ),
    "relaxation_strength": (
        "how much it gives way",
        "How much stiffer the contact is at once than after a while: 0.5 is half as much again.",
    ),
    "relaxation_time": (
        "how soon it gives way",
        "The time in which the additional force of a fast contact dies away.",
    ),
    "buckling_compression": (
        "where it buckles",
        "How far the ball is pressed in when its wall gives way.",
    ),
    "stiffness_ratio": (
        "how much softer then",
        "The stiffness after the wall has buckled over that before: 1 does not buckle.",
    ),
    "unloading_exponent": (
        "how it lets go",
        "The larger, the faster the force falls on the way back, and the more energy is lost.",
    ),
}
"""What numbers of a law are called by a pupil, and a sentence on each."""

_LOSSY = Hysteretic  # the paper's own way to lose energy


@functools.cache
def list_choices(limits: Limits) -> str:
    """List balls, contact laws, examples and the limits of a request, as JSON."""
    presets = [
        {"name": one.name, "group": one.group, "title": one.title, "says": one.says}
        | {"drop": one.drop.to_mapping()}
        for one in (*list_examples(), *list_cases())
    ]
    return as_json(
        {
            "stackbounce": __version__,
            "balls": [entry.to_mapping() for entry in (*BALLS, *CLASS_BALLS)],
            "laws": [_describe_law(kind) for kind in LAWS.values()],
            "lossy_law": _LOSSY.__name__,
            "presets": presets,
            "limits": limits,
        }
    )


def _describe_law(kind: type[ContactLaw]) -> dict[str, Any]:
    """Return what the page shows and needs to know of a law."""
    defaults = {one.name: one.default for one in dataclasses.fields(kind)}  # type: ignore[arg-type]
    fields = []
    for name, number in kind.quantities().items():
        given = defaults[name]
        default, low, high = number.slider
        words, explains = _WORDS.get(name, (name.replace("_", " "), ""))
        fields.append(
            {
                "name": name,
                "unit": number.symbol,
                "required": given is dataclasses.MISSING,
                "default": given if isinstance(given, float) else default,
                "low": low,
                "high": high,
                "says": name.replace("_", " "),
                "words": words,
                "explains": explains,
            }
        )
    return {
        "law": kind.__name__,
        "says": kind.says,
        "formula": kind.formula,
        "source": kind.source,
        "fields": fields,
        "loss_fields": kind.loss_fields(),
        "rigid": kind.rigid,
        "exact": kind.exact,
    }


def stack_balls(balls: list[str], height: float) -> str:
    """Stack balls of the catalogue; return the drop and the sources of its numbers, as JSON."""
    chosen = stack(balls)
    drop = Drop(chosen.balls, chosen.contacts, chosen.gaps, height=height)
    sources = {"contact_sources": chosen.contact_sources, "gap_sources": chosen.gap_sources}
    return as_json({"drop": drop.to_mapping()} | sources)


def calibrate_law(law: str, **measured: float | None) -> str:
    """Find the constants of a law from restitution and contact time; return it as JSON."""
    given = {name: value for name, value in measured.items() if value is not None}
    return _write_contact(calibration.calibrate(law_named(law), **given))


def convert_law(
    contact: ContactLaw | None,
    to: str,
    mass: float,
    impact_speed: float,
    restitution: float | None,
    contact_time: float | None,
) -> str:
    """Find another law with the restitution and contact time of a contact; return it as JSON.

    No contact has the restitution 0.8 and the contact time of a rigid one, 5 ms.
    """
    contact = contact or DEFAULT_CONTACT
    if contact_time is None:
        contact_time = collision.contact_time(contact, mass, impact_speed) or DEFAULT_CONTACT_TIME
    law = law_named(to)
    given = {"contact_time": contact_time, "impact_speed": impact_speed, "mass": mass}
    if law.loss:
        if restitution is None:
            restitution = collision.restitution(contact, mass, impact_speed)
        given["restitution"] = restitution
    if law.default_exponent() is None and not law.rigid:
        given["exponent"] = getattr(contact, "exponent", DEFAULT_EXPONENT)
    return _write_contact(calibration.calibrate(law, **given))


def _write_contact(law: ContactLaw) -> str:
    return as_json({"contact": law.to_mapping()})
