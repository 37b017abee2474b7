"""What the page offers: balls, contact laws and examples, and the limits of a request."""

import tomllib
from importlib.resources import files
from typing import Any

from stackbounce.cross2007.cases import list_cases
from stackbounce.explorer.examples import list_examples
from stackbounce.explorer.limits import LIMITS
from stackbounce.explorer.page.bounds import limits_of
from stackbounce.model import LAWS, ContactLaw, Hysteretic
from stackbounce.model.catalogue import BALLS, CLASS_BALLS
from stackbounce.version import __version__

WORDS: dict[str, Any] = tomllib.loads((files(__package__) / "words.toml").read_text("utf-8"))
"""What the page calls numbers of laws, what maps show, and the ratios that they vary."""

_LOSSY = Hysteretic  # the paper's own way to lose energy


def list_choices() -> dict[str, Any]:
    """Return balls, contact laws, examples and the limits of a request."""
    cases = (*list_examples(), *list_cases())
    return {
        "stackbounce": __version__,
        "balls": [entry.to_mapping() for entry in (*BALLS, *CLASS_BALLS)],
        "laws": [_describe_law(kind) for kind in LAWS.values()],
        "lossy_law": _LOSSY.__name__,
        "presets": [vars(case) | {"drop": case.drop.to_mapping()} for case in cases],
        "limits": LIMITS,
    }


def _describe_law(kind: type[ContactLaw]) -> dict[str, Any]:
    """Return what the page shows of a law and computes with, and what it is in the engine."""
    return {
        "law": kind.__name__,
        "says": kind.says,
        "formula": kind.formula,
        "source": kind.source,
        "fields": [_describe_number(kind, name) for name in kind.quantities()],
        "form": kind.form,
        "parameters": (kind.third_number, kind.fourth_number),
        "rigid": kind.rigid,
        "exact": kind.exact,
        "loss": kind.loss,
        "loss_fields": list(kind.loss_fields()),
        "constant_loss": not kind.loss_depends_on,
        "least_restitution": kind.least_restitution,
        "exponent": kind.fixed_exponent(),
        "usual_exponent": kind.default_exponent(),
        "needs": {"linear": kind.calibration_needs(1.0), "other": kind.calibration_needs(2.0)},
    }


def _describe_number(kind: type[ContactLaw], name: str) -> dict[str, Any]:
    """Return a number of a law: words, unit, limits, slider, where a search starts, usual value."""
    number, words = kind.quantities()[name], name.replace("_", " ")
    initial, low, high = number.slider
    usual = getattr(kind, name, None)
    return {
        "name": name,
        "unit": number.symbol,
        "required": not hasattr(kind, name),
        "default": initial if usual is None else usual,
        "low": low,
        "high": high,
        "start": low if name == kind.loss else initial,
        "says": words,
        "words": words,
        "explains": "",
        **WORDS["numbers"].get(name, {}),
        **limits_of(number.check),
        **({"usual": usual} if hasattr(kind, name) else {}),
    }
