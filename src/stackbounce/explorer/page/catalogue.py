"""What the page offers: balls, contact laws and examples, and the limits of a request."""

import dataclasses
import tomllib
from importlib.resources import files
from typing import Any

from stackbounce.cross2007.cases import list_cases
from stackbounce.explorer.examples import list_examples
from stackbounce.explorer.limits import LIMITS
from stackbounce.model import LAWS, ContactLaw, Hysteretic
from stackbounce.model.catalogue import BALLS, CLASS_BALLS
from stackbounce.version import __version__

WORDS: dict[str, Any] = tomllib.loads((files(__package__) / "words.toml").read_text("utf-8"))
"""What the page calls numbers of laws, what maps show, and the ratios that they vary."""

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
        own = {"words": name.replace("_", " "), "explains": ""} | WORDS["numbers"].get(name, {})
        fields.append(
            {
                "name": name,
                "unit": number.symbol,
                "required": given is dataclasses.MISSING,
                "default": given if isinstance(given, float) else default,
                "low": low,
                "high": high,
                "says": name.replace("_", " "),
                **own,
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
