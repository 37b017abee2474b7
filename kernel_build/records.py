"""Records of arrays as a numba type of their own: kernels pass one pointer.

The pointer leads to the table that `stackbounce.engine.tables` describes. An array that a kernel
takes from it owns no memory. numba's own structures count a reference each time an array is taken
from them, which took longer than the arithmetic. Negative indices are not supported, because no
kernel uses them and the test for them took a tenth of the time.
"""

import operator
from typing import Any, get_type_hints

import numba.extending
import numba.np.arrayobj
from llvmlite import ir
from numba import types
from numba.core.typing.templates import AttributeTemplate
from numba.extending import typeof_impl

from stackbounce.engine.kernels import (
    FloatColumn,
    Floats,
    FloatTable,
    IntegerColumn,
    Integers,
    IntegerTable,
    Rows,
)
from stackbounce.engine.stack import TERMS
from stackbounce.engine.tables import COLUMNS, Table

_extending: Any = numba.extending
_arrays: Any = numba.np.arrayobj
_WORD = 8  # bytes of any number
_FIELDS = {  # type of the numbers, dimensions, and numbers in a row where all rows have as many
    Floats: ("float64", 1, None),
    Integers: ("int64", 1, None),
    FloatColumn: ("float64", 1, None),
    IntegerColumn: ("int64", 1, None),
    FloatTable: ("float64", 2, None),
    IntegerTable: ("int64", 2, None),
    Rows: ("float64", 2, TERMS),
}


class RecordType(types.Type):
    """The numba type of a record: the names of its arrays and their types."""

    def __init__(self, record: type) -> None:
        hints = get_type_hints(record, include_extras=True)
        self.fields = {name: _FIELDS[hint] for name, hint in hints.items()}
        super().__init__(name=f"{record.__name__}Record")

    def array(self, name: str) -> Any:
        """Return the numba type of an array, or None if there is none of that name."""
        if name not in self.fields:
            return None
        number, dimensions, _ = self.fields[name]
        return Numbers(getattr(types, number), dimensions)


class Numbers(types.Array):
    """The numba type of an array whose indices are never negative."""

    def __init__(self, dtype: Any, ndim: int) -> None:
        name = f"Numbers({dtype}, {ndim}d)"
        super().__init__(dtype, ndim, "C", name=name)

    def copy(self, ndim: int, **_: Any) -> "Numbers":
        """Return the type of an array with another number of dimensions, such as a row."""
        return Numbers(self.dtype, ndim)


def _unsigned(sig: Any) -> Any:
    """Return the signature of getting or setting an item with unsigned indices."""
    index = sig.args[1]
    if isinstance(index, types.BaseTuple):
        index = types.UniTuple(types.uintp, len(index))
    else:
        index = types.uintp
    return sig.replace(args=(sig.args[0], index, *sig.args[2:]))


def _get(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    """Return an item, or a row."""
    return _arrays.getitem_arraynd_intp(context, builder, _unsigned(sig), args)


def _get_by_tuple(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    """Return the item at a row and a column."""
    return _arrays.getitem_array_tuple(context, builder, _unsigned(sig), args)


def _set(context: Any, builder: Any, sig: Any, args: Any) -> Any:
    """Set an item."""
    return _arrays.setitem_array(context, builder, _unsigned(sig), args)


def _unbox(_: RecordType, value: Any, c: Any) -> Any:
    """Return the address of a Table."""
    address = c.pyapi.object_getattr_string(value, "address")
    pointer = c.pyapi.long_as_voidptr(address)
    c.pyapi.decref(address)
    return _extending.NativeValue(pointer)


@_extending.infer_getattr
class _Attributes(AttributeTemplate):
    key = RecordType

    def generic_resolve(self, value: Any, attr: Any) -> Any:
        return value.array(attr)


def _array(context: Any, builder: Any, kind: RecordType, pointer: Any, name: str) -> Any:
    """Return an array of a name, built from its row of the table."""
    word, made = ir.IntType(8 * _WORD), kind.array(name)
    row = list(kind.fields).index(name)
    table = builder.bitcast(pointer, word.as_pointer())
    address, length, columns = (
        builder.load(builder.gep(table, [word(COLUMNS * row + column)]))
        for column in range(COLUMNS)
    )
    _, dimensions, known = kind.fields[name]
    shape, strides = [length], [word(_WORD)]
    if dimensions > 1:
        columns = columns if known is None else word(known)
        shape, strides = [length, columns], [builder.mul(columns, word(_WORD)), word(_WORD)]
    array = _arrays.make_array(made)(context, builder)
    data = builder.inttoptr(address, array.data.type)
    _arrays.populate_array(array, data, shape, strides, _WORD, None)
    return array._getvalue()


@typeof_impl.register(Table)
def _typeof(value: Table, _: Any) -> RecordType:
    return RecordType(type(value.record))


_extending.register_model(Numbers)(_extending.models.ArrayModel)
_extending.lower_builtin(operator.getitem, Numbers, types.Integer)(_get)
_extending.lower_builtin(operator.getitem, Numbers, types.BaseTuple)(_get_by_tuple)
_extending.lower_builtin(operator.setitem, Numbers, types.Integer, types.Any)(_set)
_extending.lower_builtin(operator.setitem, Numbers, types.BaseTuple, types.Any)(_set)
_extending.register_model(RecordType)(_extending.models.OpaqueModel)
_extending.unbox(RecordType)(_unbox)
_extending.lower_getattr_generic(RecordType)(_array)
