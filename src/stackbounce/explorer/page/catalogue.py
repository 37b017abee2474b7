"""What the page offers: balls, contact laws and examples, and the limits of a request."""

import dataclasses
from typing import Any

from stackbounce.cross2007.cases import list_cases
from stackbounce.explorer.examples import list_examples
from stackbounce.explorer.limits import LIMITS
from stackbounce.model import LAWS, ContactLaw, Hysteretic
from stackbounce.model.catalogue import BALLS, CLASS_BALLS
from stackbounce.version import __version__

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


def list_choices() -> dict[str, Any]:
    """Return balls, contact laws, examples and the limits of a request."""
    presets = [
        {"name": case.name, "group": case.group, "title": case.title, "says": case.says}
        | {"drop": case.drop.to_mapping()}
        for case in (*list_examples(), *list_cases())
    ]
    return {
        "stackbounce": __version__,
        "balls": [entry.to_mapping() for entry in (*BALLS, *CLASS_BALLS)],
        "laws": [_describe_law(kind) for kind in LAWS.values()],
        "lossy_law": _LOSSY.__name__,
        "presets": presets,
        "limits": LIMITS,
    }


def _describe_law(kind: type[ContactLaw]) -> dict[str, Any]:
    """Return what the page shows and needs to know of a law."""
    defaults = {entry.name: entry.default for entry in dataclasses.fields(kind)}  # type: ignore[arg-type]
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
        "loss_fields": list(kind.loss_fields()),
        "rigid": kind.rigid,
        "exact": kind.exact,
    }
