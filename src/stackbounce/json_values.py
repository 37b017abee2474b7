"""Values for JSON: lists and plain numbers, with null for numbers that are not finite."""

import dataclasses
import json
import math
from pathlib import Path
from typing import Any


def as_json(value: object, *, indent: int | None = None) -> str:
    """Return `value` as JSON.

    Parameters
    ----------
    value : object
        Dicts, lists, dataclasses, arrays, strings and numbers.
    indent : int, optional
        Spaces for each level; all on one line by default.

    Returns
    -------
    str

    Examples
    --------
    >>> as_json({"peak_force": float("inf")})
    '{"peak_force": null}'
    """
    return json.dumps(plain(value), indent=indent, ensure_ascii=False, allow_nan=False)


def plain(value: Any) -> Any:
    """Return `value` as dicts, lists, strings, numbers, booleans and None; see `as_json`.

    Examples
    --------
    >>> import numpy as np
    >>> plain({"rebound_speeds": np.array([1.0, np.nan])})
    {'rebound_speeds': [1.0, None]}
    """
    import numpy as np

    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return plain(dataclasses.asdict(value))
    if isinstance(value, dict):
        return {str(key): plain(one) for key, one in value.items()}
    if isinstance(value, np.ndarray) and value.dtype.names:
        return [{name: plain(row[name]) for name in value.dtype.names} for row in value]
    if isinstance(value, np.ndarray) and value.dtype.kind == "f" and np.isfinite(value).all():
        return value.tolist()
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist())
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, Path):
        return str(value)
    return None if isinstance(value, float) and not math.isfinite(value) else value
