"""The mark of a kernel, and the types of its arguments.

A kernel is a plain Python function on numbers and arrays. The same source runs as plain Python, and
is compiled when the package is built (the folder `kernel_build` of the repository). Both give the
same bits: no fast-math, no threads, and no function of a C library.
"""

from collections.abc import Callable, MutableSequence, Sequence
from typing import Annotated, Any, TypeAlias, TypeVar

Floats: TypeAlias = MutableSequence[float]  # a list, or an array when compiled
Integers: TypeAlias = MutableSequence[int]
Rows: TypeAlias = Sequence[Floats]  # a list of lists, or an array of rows of TERMS numbers
FloatColumn: TypeAlias = Annotated[Any, "float64", 1]  # always an array, with a number per drop
IntegerColumn: TypeAlias = Annotated[Any, "int64", 1]
FloatTable: TypeAlias = Annotated[Any, "float64", 2]  # the same, with a row per drop
IntegerTable: TypeAlias = Annotated[Any, "int64", 2]

Function = TypeVar("Function", bound=Callable[..., Any])
MARK = "__stackbounce_kernel__"


def kernel(function: Function) -> Function:
    """Mark a function as a kernel: callable as it is, and compilable with its marked callees."""
    setattr(function, MARK, True)
    return function
