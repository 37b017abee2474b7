"""Errors in a scenario: ``height = "63 ± 1 cm"``."""

import os
from collections.abc import Mapping
from typing import Any

from stackbounce.errors import InvalidValue, ScenarioError
from stackbounce.extras import need
from stackbounce.measure.quantities import without_error
from stackbounce.model import Drop
from stackbounce.model.toml import load_toml, write_toml
from stackbounce.prediction.inputs import read_inputs

_WORDS = ("law", "name")


def read_scenario(path: str | os.PathLike[str]) -> tuple[Drop, dict[str, str]]:
    """Read a scenario file whose numbers may have errors, such as ``mass = "57 ± 0.5 g"``.

    Parameters
    ----------
    path : str or path-like
        The file, as `Drop.from_toml` reads it.

    Returns
    -------
    drop : Drop
        With the values without errors.
    errors : dict of str to str
        The numbers with errors by path, as `predict` takes them; empty if none has one.

    Raises
    ------
    FileError, ScenarioError, InvalidType
        As `Drop.from_toml`.

    Examples
    --------
    >>> import stackbounce as sb
    >>> path = getfixture("tmp_path") / "drop.toml"
    >>> text = sb.Drop([sb.Ball(0.057)], [sb.Spring(2e4)], height=0.63).to_toml()
    >>> _ = path.write_text(text.replace("0.63", '"63 ± 1 cm"'))
    >>> read_scenario(path)[1]
    {'height': '63 ± 1 cm'}
    """
    name, mapping = load_toml(path)
    plain, errors = split_errors(mapping)
    try:
        return Drop.from_mapping(plain), errors
    except ScenarioError as error:
        raise ScenarioError(f"{name}: {error}") from error


def write_scenario(drop: Drop, errors: Mapping[str, Any]) -> str:
    """Return a drop whose numbers have errors as the text of a scenario file.

    Parameters
    ----------
    drop : Drop
        All numbers; those in `errors` replace its own.
    errors : mapping
        Numbers with errors by path, as `predict` takes them.

    Returns
    -------
    str
        TOML, which `read_scenario` reads. Numbers are in SI units, and are written in full.

    Raises
    ------
    InvalidValue
        If the drop has no such number, or the errors are correlated or given as draws.
    InvalidType
        If something has the wrong type.
    MissingExtra
        If the extra `measure` is not installed.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.057)], [sb.Spring(2e4)], height=0.63)
    >>> print(write_scenario(drop, {"height": "63 ± 1 cm"}).splitlines()[1])
    height = "0.63 ± 0.01 m"
    """
    need("measure", "a number with an error")
    inputs = read_inputs(drop, errors)
    if not inputs.independent:
        raise InvalidValue("errors must be independent of each other in a scenario file")
    mapping, values = inputs.drop.to_mapping(), inputs.values.tolist()
    for number, value, error in zip(
        inputs.numbers, values, inputs.deviations.tolist(), strict=True
    ):
        if error > 0.0:
            place: Any = mapping[number.part] if number.part else mapping
            if number.part and number.field:
                place = place[number.index]
            text = f"{value!r} ± {error!r} {number.unit}".rstrip()
            place[number.field or number.index] = text
    return write_toml(mapping)


def split_errors(mapping: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, str]]:
    """Return a scenario without errors, and the texts that have some by path.

    Examples
    --------
    >>> split_errors({"height": "63 ± 1 cm", "balls": [{"mass": "57 g"}]})
    ({'height': '63 cm', 'balls': [{'mass': '57 g'}]}, {'height': '63 ± 1 cm'})
    """
    errors: dict[str, str] = {}

    def plain(value: Any, path: str) -> Any:
        if isinstance(value, str):
            return split_error(value, path, errors)
        if isinstance(value, Mapping):
            return {
                key: one if key in _WORDS else plain(one, f"{path}.{key}" if path else str(key))
                for key, one in value.items()
            }
        if isinstance(value, list):
            return [plain(part, f"{path}.{k}") for k, part in enumerate(value)]
        return value

    return plain(mapping, ""), errors


def split_error(text: str, path: str, errors: dict[str, str]) -> str:
    """Return a quantity without its error; a text that has one is noted by its path."""
    if "±" not in text and "+/-" not in text and "(" not in text:
        return text
    value = without_error(text)
    if value is None:
        return text
    errors[path] = text
    return value
