"""Answers as flat tables: a path and a value each, long arrays as what sums them up."""

import hashlib
import math
import numbers
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

import stackbounce as sb

LONG = 40  # numbers in a list; a longer one is summed up
_VERSION = "stackbounce"  # the key under which each answer tells it
_TURN = 2.399963229728653  # radians; no two weights of a sum are alike


def flat(answer: Any) -> dict[str, Any]:
    """Return an answer as a table from paths to numbers, texts, truth values, None and summaries.

    Parameters
    ----------
    answer : Any
        Mappings, lists, arrays, xarray's datasets, numbers and texts within each other.

    Returns
    -------
    dict of str to Any
        Versions are left out.
    """
    return dict(_leaves("", answer))


def _leaves(path: str, value: Any) -> Iterator[tuple[str, Any]]:
    """Yield paths and values below a path."""
    if hasattr(value, "data_vars"):  # a dataset
        value = {str(name): value[name].values for name in value.variables}
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, Mapping):
        for key, one in value.items():
            if key != _VERSION:
                yield from _leaves(f"{path}/{key}" if path else str(key), one)
        if not value:
            yield path, "{}"
    elif isinstance(value, list | tuple):
        if len(value) > LONG and all(_is_number(one) for one in value):
            yield path, summary(value)
            return
        rows = _columns(value)
        if rows:
            yield from _leaves(f"{path}/*", rows)
            return
        for index, one in enumerate(value):
            yield from _leaves(f"{path}/{index}", one)
        if not value:
            yield path, "[]"
    else:
        yield path, _plain(value)


def _columns(rows: Sequence[Any]) -> dict[str, Any]:
    """Return the columns of a long table of numbers; nothing of what is none."""
    if len(rows) <= LONG or not all(isinstance(row, dict | list | tuple) for row in rows):
        return {}
    named = [row if isinstance(row, dict) else dict(enumerate(row)) for row in rows]
    if any(row.keys() != named[0].keys() for row in named):
        return {}
    if not all(_is_number(one) for row in named for one in row.values()):
        return {}
    return {str(key): [row[key] for row in named] for key in named[0]}


def _is_number(value: Any) -> bool:
    return value is None or (isinstance(value, numbers.Real) and not isinstance(value, bool))


def _plain(value: Any) -> Any:
    """Return a value as JSON has it."""
    if value is None or isinstance(value, bool | int | float):
        return value
    if isinstance(value, numbers.Integral):
        return int(value)
    if isinstance(value, numbers.Real):
        return float(value)
    return without_version(str(value))


def without_version(text: str) -> str:
    """Return a text without the package's version, as it stands in the head of a file."""
    return re.sub(rf"(stackbounce\W{{0,3}}){re.escape(sb.__version__)}", r"\1VERSION", text)


def summary(values: Any) -> dict[str, Any]:
    """Return what sums up a long array of numbers.

    Parameters
    ----------
    values : sequence of numbers
        None stands for what is not finite.

    Returns
    -------
    dict of str to Any
        `count` and how many are `missing`; the sha256 of the `bits` and that of ten `digits`;
        `low`, `high` and `sum`; `mixed` is a sum with weights, which tells the order.
    """
    array = np.array([math.nan if one is None else one for one in values], dtype=float)
    finite = np.where(np.isfinite(array), array, 0.0)
    digits = " ".join(f"{one:.9e}" for one in array.tolist())
    weights = np.cos(_TURN * np.arange(len(array)))
    return {
        "count": len(array),
        "missing": int(np.count_nonzero(~np.isfinite(array))),
        "bits": _hash(array.tobytes()),
        "digits": _hash(digits.encode()),
        "low": float(np.min(finite)) if len(finite) else 0.0,
        "high": float(np.max(finite)) if len(finite) else 0.0,
        "sum": math.fsum(finite.tolist()),
        "mixed": math.fsum((weights * finite).tolist()),
    }


def _hash(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()[:24]
