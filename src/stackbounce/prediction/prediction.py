"""`predict`: what follows of a drop whose numbers have errors, as in ``height = "63 ± 1 cm"``."""

import os
from collections.abc import Mapping
from typing import Any

import numpy as np

from stackbounce.errors import placed, whole
from stackbounce.extras import MEASURING, need
from stackbounce.measure.quantities import without_error
from stackbounce.model import Drop
from stackbounce.model.toml import load_toml
from stackbounce.prediction.draws import DRAWS, Progress, Slopes, differentiate, solve_draws
from stackbounce.prediction.inputs import FEWEST, Inputs, read_inputs
from stackbounce.prediction.result import Prediction
from stackbounce.run.driver import solve_one
from stackbounce.run.options import Options, run_options, seed_of
from stackbounce.run.result import ROUND_OFF

_MOST = 10_000_000  # draws
_EVENTS, _NONLINEAR_EVENTS = 1_000_000, 200_000  # of all draws together, by default
_FEW = 1e-3  # share of draws that are not possible, which derivatives do without
_WORDS = ("law", "name")


def predict(
    drop: Drop,
    errors: Mapping[str, Any],
    *,
    until: float | None = None,
    rtol: float = 1e-12,
    event_limit: int = 1_000_000,
    draws: int | None = None,
    rng: Any = 0,
    progress: Progress | None = None,
) -> Prediction:
    """Run a drop whose numbers have errors; return speeds, times and energy with errors.

    Parameters
    ----------
    drop : Drop
        All numbers; those in `errors` replace its own.
    errors : mapping
        Numbers with errors, by the paths that `sweep` has, or ``offsets.1`` for how far ball 1 lies
        off the middle (see `Prediction.sideways`): a ``UFloat`` of `uncertainties`, in SI
        units (correlated ones stay so), a text such as ``"63 ± 1 cm"``, a pair of value and
        standard deviation, or an array of draws, of which each row holds for all arrays.
    until, rtol, event_limit
        As in `simulate`, for every drop.
    draws : int, optional
        The number of draws, 100 or above; by default 10 000, and fewer where these would have more
        than a million events (200 000 under nonlinear contact laws), but 100 at least. Given draws
        have their own number. All draws together may cost what takes up to half a minute, and more
        where more draws or a larger `event_limit` are asked for. If they cost more, fewer are run,
        and a note says so.
    rng : int, numpy.random.Generator or the like, optional
        Of the random numbers, as `numpy.random.default_rng` takes it: the same number gives the
        same draws, bit for bit, and a Generator others each time.
    progress : callable, optional
        Is called with the number of draws done and the number of all.

    Returns
    -------
    Prediction

    Raises
    ------
    InvalidValue
        If the drop has no such number, an error is negative, few draws are possible drops, or they
        cost so much that few can be run.
    InvalidType
        If something has the wrong type.
    MissingExtra
        If the extra `lab` is not installed.

    Notes
    -----
    Errors are those of normal distributions. They are carried by derivatives (central differences)
    where all draws follow these to a tenth of the error and have the same numbers of contact
    intervals. Elsewhere values and errors are mean and standard deviation of draws; numbers that
    no drop can have, such as negative gaps, are left out. `Prediction.how` says which and why.

    Examples
    --------
    >>> import stackbounce as sb
    >>> drop = sb.Drop([sb.Ball(0.6), sb.Ball(0.06)], [sb.Spring(2e4)] * 2, height=0.63)
    >>> found = sb.predict(drop, {"height": "63 ± 1 cm", "gaps.0": "1.0 ± 0.5 mm"})
    >>> found.how[:62]
    'errors by 10000 draws: numbers within the errors are not possi'
    >>> str(found["rebound_speeds.1"])
    '4.28+/-0.10'
    """
    need("a number with an error", *MEASURING)
    options = run_options(drop, until, rtol, event_limit)
    inputs = read_inputs(drop, errors)
    if inputs.offsets:  # what has no sideways motion is refused before the draws
        result = solve_one(drop, options)
        for ball, offset in inputs.offsets.items():
            for end in (-offset.std_dev, offset.std_dev):
                result.sideways(inputs.middle | {ball: offset.nominal_value + end})
    count = _default_draws(inputs, options) if draws is None else draws
    count = whole("draws", count, FEWEST, _MOST)
    drawn, refused, share = inputs.draw(count, seed_of(rng))
    reason = "draws were given" if inputs.given else ""
    if share > _FEW and not reason:
        reason = f"numbers within the errors are not possible and left out: {refused}"
    asked, solved = len(drawn), solve_draws(inputs, drawn, options, progress)
    drawn, difference = drawn[: len(solved.status)], np.inf
    slopes: Slopes = {}
    if not reason:
        slopes, reason, difference = differentiate(inputs, drawn, solved, options)
    return Prediction(inputs, options, reason, difference, slopes, drawn, solved, refused, asked)


def _default_draws(inputs: Inputs, options: Options) -> int:
    """Return how many draws of a drop have a reasonable number of events together."""
    if not inputs.numbers:
        return FEWEST
    result = solve_one(inputs.drop, options)
    most = _NONLINEAR_EVENTS if result.precision > ROUND_OFF else _EVENTS
    return min(DRAWS, max(FEWEST, most // max(1, len(result.events))))


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
    with placed(f"{name}: "):
        return Drop.from_mapping(plain), errors


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
