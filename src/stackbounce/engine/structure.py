"""A stack of numpy arrays as a structure of its own for numba: kernels pass one pointer.

Behind the pointer lies a table with the address and the shape of each array. What a kernel takes
out of it is an array that nobody owns: numba's own structures count a reference each time they are
asked for an array, which took longer than the arithmetic did.
"""

import functools
from typing import Any

import numba.extending
import numba.np.arrayobj
import numpy as np
from llvmlite import ir
from numba import types
from numba.core.typing.templates import AttributeTemplate
from numba.extending import typeof_impl

_extending: Any = numba.extending
_arrays: Any = numba.np.arrayobj
_COLUMNS = 3  # of the table: an array's address, its rows and its columns
_WORD = 8  # bytes of any number


class Structure:
    """What compiled kernels are given for a stack: it shares the arrays and keeps them alive."""

    def __init__(self, stack: Any) -> None:
        self.stack = stack
        rows = [(a.ctypes.data, a.shape[0], a.size // max(1, a.shape[0])) for a in stack]
        self.table = np.array(rows, dtype=np.int64)
        self.address = self.table.ctypes.data

    @functools.cached_property
    def kind(self) -> "StructureType":
        """Its numba type, for which numba asks at each call of a kernel."""
        named = zip(self.stack._fields, self.stack, strict=True)
        kinds = tuple((field, array.dtype.name, array.ndim) for field, array in named)
        return StructureType(type(self.stack).__name__, kinds)


class StructureType(types.Type):
    """The numba type of a Structure, by the names of its arrays and how many axes each has."""

    def __init__(self, name: str, kinds: tuple[tuple[str, str, int], ...]) -> None:
        self.kinds = kinds
        super().__init__(name=f"{name}Structure")

    def array(self, name: str) -> Any:
        """Return the numba type of an array, or nothing where there is none of that name."""
        for field, kind, axes in self.kinds:
            if field == name:
                return types.Array(getattr(types, kind), axes, "C")
        return None


@typeof_impl.register(Structure)
def _typeof(value: Structure, _: Any) -> StructureType:
    return value.kind


def _unbox(_: StructureType, value: Any, c: Any) -> Any:
    """Take the address of a Structure's table."""
    address = c.pyapi.object_getattr_string(value, "address")
    pointer = c.pyapi.long_as_voidptr(address)
    c.pyapi.decref(address)
    return _extending.NativeValue(pointer)


@_extending.infer_getattr
class _Attributes(AttributeTemplate):
    key = StructureType

    def generic_resolve(self, value: Any, attr: Any) -> Any:  # type: ignore[override]
        return value.array(attr)


def _array(context: Any, builder: Any, kind: StructureType, pointer: Any, name: str) -> Any:
    """Build the array of a name from its row of the table."""
    word, made = ir.IntType(8 * _WORD), kind.array(name)
    start = _COLUMNS * [field for field, _, _ in kind.kinds].index(name)
    table = builder.bitcast(pointer, word.as_pointer())
    address, *shape = (
        builder.load(builder.gep(table, [word(start + column)])) for column in range(1 + made.ndim)
    )
    strides = [word(_WORD)] if made.ndim == 1 else [builder.mul(shape[1], word(_WORD)), word(_WORD)]
    array = _arrays.make_array(made)(context, builder)
    data = builder.inttoptr(address, array.data.type)
    _arrays.populate_array(array, data, shape, strides, _WORD, None)
    return array._getvalue()


_extending.register_model(StructureType)(_extending.models.OpaqueModel)
_extending.unbox(StructureType)(_unbox)
_extending.lower_getattr_generic(StructureType)(_array)
