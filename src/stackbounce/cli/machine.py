"""Output for machines: JSON with the API's names, in SI units; null for what is not finite."""

from stackbounce.cli.scenario import Scenario
from stackbounce.json_values import as_json
from stackbounce.model.catalogue import BALLS, PAIRS
from stackbounce.run.result import Result
from stackbounce.version import __version__

__all__ = ["catalogue", "simulation", "text"]


def text(value: object) -> str:
    """Return `value` as JSON, indented.

    Parameters
    ----------
    value : object
        Dicts, lists, dataclasses, arrays, strings and numbers.

    Returns
    -------
    str

    Examples
    --------
    >>> print(text({"peak_force": float("inf")}))
    {
      "peak_force": null
    }
    """
    return as_json(value, indent=2)


def simulation(scenario: Scenario, result: Result, textbook: Result | None) -> dict[str, object]:
    """Return what ``stackbounce simulate --json`` prints."""
    return {
        "stackbounce": __version__,
        "drop": scenario.drop.to_mapping(),
        "contact_sources": scenario.contact_sources,
        "gap_sources": scenario.gap_sources,
        "reference_speed": scenario.drop.reference_speed,
        **result.to_mapping(),
        "intervals": result.intervals,
        "apexes": result.apexes,
        "separate": None if textbook is None else textbook.to_mapping(),
    }


def catalogue() -> dict[str, object]:
    """Return what ``stackbounce balls --json`` prints."""
    rows = [entry.to_mapping() for entry in BALLS]
    return {"stackbounce": __version__, "balls": rows, "pairs": PAIRS}
