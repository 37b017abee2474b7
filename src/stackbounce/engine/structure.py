"""A stack of numpy arrays as a numba type of its own: kernels pass one pointer.

The pointer leads to a table with the address and the shape of each array. An array that a kernel
takes from it owns no memory. numba's own structures count a reference each time an array is taken
from them, which took longer than the arithmetic. Negative indices are not supported, because no
kernel uses them and the test for them took a tenth of the time.
"""

import functools
import math
import operator
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
_COLUMNS = 2  # columns of the table: an array's address and its rows
_WORD = 8  # bytes of any number


class Structure:
    """The argument that compiled kernels take for a stack; it keeps the stack's arrays alive."""

    def __init__(self, stack: Any) -> None:
        self.stack = stack
        rows = [(a.ctypes.data, a.shape[0]) for a in stack]
        self.table = np.array(rows, dtype=np.int64)
        self.address = self.table.ctypes.data

    @functools.cached_property
    def kind(self) -> "StructureType":
        """The numba type, which numba asks for at each call of a kernel."""
        named = zip(self.stack._fields, self.stack, strict=True)
        kinds = tuple((field, array.dtype.name, array.shape[1:]) for field, array in named)
        return StructureType(type(self.stack).__name__, kinds)


class StructureType(types.Type):
    """The numba type of a Structure: the names of its arrays and the columns of their rows."""

    def __init__(self, name: str, kinds: tuple[tuple[str, str, tuple[int, ...]], ...]) -> None:
        self.kinds = kinds
        super().__init__(name=f"{name}Structure")

    def array(self, name: str) -> Any:
        """Return the numba type of an array, or None if there is none of that name."""
        for field, kind, columns in self.kinds:
            if field == name:
                return Numbers(getattr(types, kind), 1 + len(columns))
        return None


class Numbers(types.Array):
    """The numba type of an array whose indices are never negative."""

    def __init__(self, dtype: Any, ndim: int) -> None:
        name = f"Numbers({dtype}, {ndim}d)"
        super().__init__(dtype, ndim, "C", name=name)

    def copy(self, ndim: int, **_: Any) -> "Numbers":  # type: ignore[override]
        """Return the type of an array with another number of dimensions, such as a row."""
        return Numbers(self.dtype, ndim)


def _unsigned(sig: Any) -> Any:
    """Return the signature of getting or setting an item with an unsigned index."""
    return sig.replace(args=(sig.args[0], types.uintp, *sig.args[2:]))


def _get(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    """Return an item, or a row."""
    return _arrays.getitem_arraynd_intp(context, builder, _unsigned(sig), args)


def _set(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    """Set an item."""
    return _arrays.setitem_array(context, builder, _unsigned(sig), args)


@typeof_impl.register(Structure)
def _typeof(value: Structure, _: Any) -> StructureType:
    return value.kind


def _unbox(_: StructureType, value: Any, c: Any) -> Any:
    """Return the address of a Structure's table."""
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
    """Return an array of a name, built from its row of the table."""
    word, made = ir.IntType(8 * _WORD), kind.array(name)
    row = [field for field, _, _ in kind.kinds].index(name)
    table = builder.bitcast(pointer, word.as_pointer())
    address, length = (
        builder.load(builder.gep(table, [word(_COLUMNS * row + column)])) for column in (0, 1)
    )
    columns = kind.kinds[row][2]
    shape = [length, *map(word, columns)]
    strides = [word(_WORD * math.prod(columns[axis:])) for axis in range(made.ndim)]
    array = _arrays.make_array(made)(context, builder)
    data = builder.inttoptr(address, array.data.type)
    _arrays.populate_array(array, data, shape, strides, _WORD, None)
    return array._getvalue()


_extending.register_model(Numbers)(_extending.models.ArrayModel)
_extending.lower_builtin(operator.getitem, Numbers, types.Integer)(_get)
_extending.lower_builtin(operator.setitem, Numbers, types.Integer, types.Any)(_set)
_extending.register_model(StructureType)(_extending.models.OpaqueModel)
_extending.unbox(StructureType)(_unbox)
_extending.lower_getattr_generic(StructureType)(_array)
