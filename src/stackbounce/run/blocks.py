"""A grid of drops cut into blocks, each contiguous in memory."""

import itertools
import math
from collections.abc import Iterator, Sequence
from typing import TypeAlias

Block: TypeAlias = tuple[slice, ...]
"""A range of each dimension."""


def sides(shape: Sequence[int], most: int) -> tuple[int, ...]:
    """Return the sides of a block of at most ``most`` drops, filled from the last dimension on.

    Examples
    --------
    >>> sides((400, 300, 20), 1000)
    (1, 50, 20)
    """
    found, left = [], most
    for length in reversed(shape):
        side = max(1, min(length, left))
        left //= side
        found.append(side)
    return tuple(reversed(found))


def blocks(shape: Sequence[int], sides: Sequence[int]) -> Iterator[Block]:
    """Yield all blocks of a shape, in the order of memory; the last ones may be smaller.

    Examples
    --------
    >>> [size(block) for block in blocks((2, 5), (1, 3))]
    [3, 2, 3, 2]
    """
    ranges = [
        [slice(start, min(start + side, length)) for start in range(0, length, side)]
        for length, side in zip(shape, sides, strict=True)
    ]
    return itertools.product(*ranges)


def size(block: Block) -> int:
    """Return the number of drops in a block."""
    return math.prod(side.stop - side.start for side in block)
