"""Answers as lines of text, with all their bits."""

import hashlib
import json
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

import stackbounce as sb

_SHORT = 8  # numbers of an array that are written in full


def lines(path: str, answer: Any) -> Iterator[str]:
    """Yield a line for each value below a path: mappings within mappings are followed."""
    if isinstance(answer, Mapping):
        for key, value in answer.items():
            yield from lines(f"{path}/{key}", value)
    elif isinstance(answer, np.ndarray) and answer.size > _SHORT:
        yield f"{path} = {answer.shape} {digest(answer)}"
    else:
        value = answer.tolist() if isinstance(answer, np.ndarray | np.generic) else answer
        text = value if isinstance(value, str) else repr(value)
        yield f"{path} = {json.dumps(text.replace(sb.__version__, 'VERSION'), ensure_ascii=False)}"


def digest(array: np.ndarray) -> str:
    """Return a digest of the bits of an array."""
    return hashlib.sha256(np.ascontiguousarray(array).tobytes()).hexdigest()[:20]
