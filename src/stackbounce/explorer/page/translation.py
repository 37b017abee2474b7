"""Python to JavaScript: plain functions on numbers, and the methods of classes.

Only what formulas need is known, and all else is refused with its place. A division by zero and an
overflow raise in JavaScript as in Python, by functions of `static/js/model/python.js`, which also
has Python's builtins.
"""

import ast
from collections.abc import Callable, Iterator
from typing import Any

__all__ = ["METHODS", "THIS", "NotTranslated", "expression", "function", "names_in"]

THIS = ("self", "cls")
_OPERATORS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*"}
_FUNCTIONS = {ast.Div: "div", ast.Pow: "pow", ast.BitOr: "united"}
_COMPARED = {
    ast.Eq: "===",
    ast.NotEq: "!==",
    ast.Lt: "<",
    ast.LtE: "<=",
    ast.Gt: ">",
    ast.GtE: ">=",
    ast.Is: "===",
    ast.IsNot: "!==",
}
METHODS = ("append", "get", "items", "join")
"""Methods of lists, dicts and texts: functions of what they are called on."""

_RESERVED = {"function", "new", "var", "let", "const", "default", "switch", "case", "this", "void"}

Resolve = Callable[[ast.expr], str | None]
"""Returns what a name, or a name of a module, is called in JavaScript; None for a local one."""


class NotTranslated(Exception):
    """A piece of Python that has no translation."""

    def __init__(self, node: ast.AST) -> None:
        line = getattr(node, "lineno", "?")
        super().__init__(f"line {line} has no translation: {ast.unparse(node)}")


def names_in(node: ast.AST) -> Iterator[ast.expr]:
    """Yield all names and attributes that a piece of Python mentions, annotations left out."""
    if isinstance(node, ast.FunctionDef):
        parts: list[Any] = [*node.body, *node.args.defaults, *node.args.kw_defaults]
    elif isinstance(node, ast.AnnAssign):
        parts = [node.target, node.value]
    else:
        parts = list(ast.iter_child_nodes(node))
    if isinstance(node, ast.Name | ast.Attribute):
        yield node
    for part in filter(None, parts):
        yield from names_in(part)


def function(node: ast.FunctionDef, resolve: Resolve, name: str) -> str:
    """Return a function or a method as JavaScript, under a name.

    Raises
    ------
    NotTranslated
        If it has a piece that is not known.
    """
    return _Function(node, resolve).written(name)


def expression(node: ast.expr, resolve: Resolve) -> str:
    """Return an expression that stands alone as JavaScript.

    Raises
    ------
    NotTranslated
        If it has a piece that is not known.
    """
    nothing = ast.arguments([], [], None, [], [], None, [])
    return _Function(ast.FunctionDef("", nothing, [ast.Return(node)], []), resolve).value(node)


def _inside(node: ast.FunctionDef) -> Iterator[ast.AST]:
    """Yield all nodes of a function, functions in it included, but nothing inside of these."""
    parts: list[ast.AST] = [node.args, *node.body]
    while parts:
        one = parts.pop()
        yield one
        if not isinstance(one, ast.FunctionDef):
            parts += ast.iter_child_nodes(one)


class _Function:
    """Translates one function, expression by expression."""

    def __init__(
        self, node: ast.FunctionDef, resolve: Resolve, around: frozenset[str] = frozenset()
    ) -> None:
        """Take a function, and the names of the one `around` it, if it is inside of one."""
        self._node, self._resolve = node, resolve
        inside = list(_inside(node))
        self._locals = {
            one.id for one in inside if isinstance(one, ast.Name) and isinstance(one.ctx, ast.Store)
        }
        arguments = {one.arg for one in inside if isinstance(one, ast.arg)}
        functions = {one.name for one in inside if isinstance(one, ast.FunctionDef)}
        self._known = around | self._locals | arguments | functions

    def written(self, name: str) -> str:
        given = self._node.args
        plain = [_free(one.arg) for one in given.args if one.arg not in THIS]
        later = dict(zip(plain[::-1], given.defaults[::-1], strict=False))
        parts = [f"{one} = {self.value(later[one])}" if one in later else one for one in plain]
        if given.kwonlyargs:
            named = zip(given.kwonlyargs, given.kw_defaults, strict=True)
            texts = [f"{one.arg} = {self.value(value)}" for one, value in named if value]
            parts.append(f"{{ {', '.join(texts)} }} = {{}}")
        bound = sorted(self._locals - self._bound_inside())
        declared = [f"  let {', '.join(bound)};"] if bound else []
        body = [line for one in self._node.body for line in self.statement(one, "  ")]
        return "\n".join([f"{name}({', '.join(parts)}) {{", *declared, *body, "}"])

    def _bound_inside(self) -> set[str]:
        """Return the names that comprehensions bind, which are not those of the function."""
        kinds = ast.GeneratorExp | ast.ListComp | ast.DictComp
        loops = [
            loop
            for one in ast.walk(self._node)
            if isinstance(one, kinds)
            for loop in one.generators
        ]
        inner = {
            one.id for loop in loops for one in ast.walk(loop.target) if isinstance(one, ast.Name)
        }
        own: set[str] = set()
        for one in ast.walk(self._node):
            targets = one.targets if isinstance(one, ast.Assign) else []
            if isinstance(one, ast.AnnAssign | ast.AugAssign | ast.For):
                targets = [one.target]
            own |= {
                name.id
                for target in targets
                for name in ast.walk(target)
                if isinstance(name, ast.Name)
            }
        return inner - own

    def statement(self, node: ast.stmt, indent: str) -> Iterator[str]:
        """Yield the lines of a statement."""
        match node:
            case ast.Expr(value=ast.Constant()) | ast.Import() | ast.ImportFrom() | ast.Pass():
                return  # a docstring; an import, whose names are resolved; nothing
            case ast.Expr(value=ast.Call(func=ast.Attribute(value=ast.Name(id="object")))) as call:
                target, name, value = call.value.args  # type: ignore[attr-defined]
                yield f"{indent}{self.value(target)}[{self.value(name)}] = {self.value(value)};"
            case ast.Expr(value=value):
                yield f"{indent}{self.value(value)};"
            case ast.Assign(targets=targets, value=value):
                left = " = ".join(map(self.value, targets))
                yield f"{indent}{left} = {self.value(value)};"
            case ast.AnnAssign(target=target, value=value) if value is not None:
                yield f"{indent}{self.value(target)} = {self.value(value)};"
            case ast.AugAssign(target=target, op=op, value=value):
                made = self.value(ast.BinOp(target, op, value))
                yield f"{indent}{self.value(target)} = {made};"
            case ast.Return(value=value):
                yield f"{indent}return {'null' if value is None else self.value(value)};"
            case ast.Raise(exc=raised) if raised is not None:
                yield f"{indent}throw {self._error(raised)};"
            case ast.Delete(targets=targets):
                yield from (f"{indent}delete {self.value(one)};" for one in targets)
            case ast.If():
                yield f"{indent}if ({self.condition(node.test)}) {{"
                yield from self._block(node.body, indent)
                if node.orelse:
                    yield f"{indent}}} else {{"
                    yield from self._block(node.orelse, indent)
                yield f"{indent}}}"
            case ast.While(orelse=[]):
                yield f"{indent}while ({self.condition(node.test)}) {{"
                yield from self._block(node.body, indent)
                yield f"{indent}}}"
            case ast.FunctionDef():
                own = _Function(node, self._resolve, self._known)
                text = own.written(f"function {_free(node.name)}")
                yield from (f"{indent}{line}" for line in text.splitlines())
            case ast.For(target=target, iter=over, orelse=[]):
                yield f"{indent}for ({self.value(target)} of {self.value(over)}) {{"
                yield from self._block(node.body, indent)
                yield f"{indent}}}"
            case _:
                raise NotTranslated(node)

    def _block(self, body: list[ast.stmt], indent: str) -> Iterator[str]:
        for one in body:
            yield from self.statement(one, indent + "  ")

    def _error(self, raised: ast.expr) -> str:
        call = raised if isinstance(raised, ast.Call) else ast.Call(raised, [], [])
        given = ", ".join(map(self.value, call.args))
        return f"new {self.value(call.func)}({given})"

    def condition(self, node: ast.expr) -> str:
        """Return an expression of which only the truth counts."""
        match node:
            case ast.BoolOp(op=op, values=values):
                sign = " && " if isinstance(op, ast.And) else " || "
                return f"({sign.join(map(self.condition, values))})"
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return f"!{self.condition(operand)}"
            case ast.Compare() | ast.Constant():
                return self.value(node)
        return f"truth({self.value(node)})"

    def value(self, node: ast.expr) -> str:
        """Return an expression."""
        match node:
            case ast.Constant(value=value):
                return _constant(node, value)
            case ast.Name(id=name):
                return self._name(node, name)
            case ast.Attribute(value=owner, attr=name):
                return self._resolve(node) or f"{self.value(owner)}.{name}"
            case ast.BinOp(left=left, op=op, right=right) if type(op) in _OPERATORS:
                return f"({self.value(left)} {_OPERATORS[type(op)]} {self.value(right)})"
            case ast.BinOp(left=left, op=op, right=right) if type(op) in _FUNCTIONS:
                return f"{_FUNCTIONS[type(op)]}({self.value(left)}, {self.value(right)})"
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return f"(-{self.value(operand)})"
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                return f"!{self.condition(operand)}"
            case ast.BoolOp(op=op, values=values):
                which = "both" if isinstance(op, ast.And) else "either"
                return f"{which}({', '.join(f'() => {self.value(one)}' for one in values)})"
            case ast.Compare():
                return self._comparison(node)
            case ast.IfExp(test=test, body=body, orelse=other):
                return f"({self.condition(test)} ? {self.value(body)} : {self.value(other)})"
            case ast.Call():
                return self._call(node)
            case ast.Subscript(value=owner, slice=place) if not isinstance(place, ast.Slice):
                return f"{self.value(owner)}[{self.value(place)}]"
            case ast.Tuple(elts=parts) | ast.List(elts=parts):
                return f"[{', '.join(map(self.value, parts))}]"
            case ast.Starred(value=inner):
                return f"...{self.value(inner)}"
            case ast.Dict(keys=keys, values=values):
                return self._mapping(keys, values)
            case ast.GeneratorExp(elt=made) | ast.ListComp(elt=made):
                return self._comprehension(node, made)
            case ast.DictComp(key=key, value=value):
                return f"dict({self._comprehension(node, ast.Tuple([key, value]))})"
            case ast.Lambda(args=given, body=body):
                names = ", ".join(_free(one.arg) for one in given.args)
                return f"(({names}) => {self.value(body)})"
            case ast.JoinedStr(values=parts):
                return f"[{', '.join(map(self._text, parts))}].join('')"
        raise NotTranslated(node)

    def _name(self, node: ast.expr, name: str) -> str:
        if name in THIS:
            return "this"
        if name in self._known:
            return _free(name)
        found = self._resolve(node)
        if found is None:
            raise NotTranslated(node)
        return found

    def _comparison(self, node: ast.Compare) -> str:
        parts, left = [], node.left
        for op, right in zip(node.ops, node.comparators, strict=True):
            if isinstance(op, ast.In | ast.NotIn):
                within = f"contains({self.value(right)}, {self.value(left)})"
                parts.append(within if isinstance(op, ast.In) else f"!{within}")
            elif type(op) in _COMPARED:
                parts.append(f"{self.value(left)} {_COMPARED[type(op)]} {self.value(right)}")
            else:
                raise NotTranslated(node)
            left = right
        return f"({' && '.join(parts)})"

    def _call(self, node: ast.Call) -> str:
        match node.func:
            case ast.Name(id="super"):
                return "super"
            case ast.Name(id="isinstance"):
                return f"is_{self._named(node.args[1])}({self.value(node.args[0])})"
        given = list(map(self.value, node.args))
        match node.func:
            case ast.Name(id="getattr"):
                return f"{given[0]}[{given[1]}]" + (f" ?? {given[2]}" if given[2:] else "")
            case ast.Name(id="type"):
                return f"{given[0]}.constructor"
            case ast.Attribute(value=owner, attr=name) if name in METHODS:
                return f"{name}({', '.join([self.value(owner), *given])})"
        named = self._mapping(
            [one.arg and ast.Constant(one.arg) for one in node.keywords],
            [one.value for one in node.keywords],
        )
        callee = self.value(node.func)
        if callee == "this" or self._is_class(node.func):
            return f"{callee}.make([{', '.join(given)}], {named})"
        return f"{callee}({', '.join([*given, *([named] if node.keywords else [])])})"

    @staticmethod
    def _is_class(node: ast.expr) -> bool:
        return isinstance(node, ast.Name) and node.id[:1].isupper()

    @staticmethod
    def _named(node: ast.expr) -> str:
        if isinstance(node, ast.Name):
            return node.id
        raise NotTranslated(node)

    def _mapping(self, keys: Any, values: list[ast.expr]) -> str:
        pairs = [
            f"...{self.value(value)}"
            if key is None
            else f"[{self.value(key)}]: {self.value(value)}"
            for key, value in zip(keys, values, strict=True)
        ]
        return f"{{ {', '.join(pairs)} }}" if pairs else "{}"

    def _comprehension(self, node: Any, made: ast.expr) -> str:
        if len(node.generators) != 1:
            raise NotTranslated(node)
        (loop,) = node.generators
        target = self.value(loop.target)
        over = f"[...{self.value(loop.iter)}]"
        for test in loop.ifs:
            over += f".filter(({target}) => {self.condition(test)})"
        return f"{over}.map(({target}) => {self.value(made)})"

    def _text(self, part: ast.expr) -> str:
        if isinstance(part, ast.Constant):
            return _constant(part, part.value)
        if not isinstance(part, ast.FormattedValue):
            raise NotTranslated(part)
        if part.conversion == ord("r"):
            return f"repr({self.value(part.value)})"
        spec = part.format_spec
        form = "".join(one.value for one in spec.values) if isinstance(spec, ast.JoinedStr) else ""  # type: ignore[attr-defined]
        return f"formatted({self.value(part.value)}, {form!r})"


def _free(name: str) -> str:
    """Return a name that is no word of JavaScript's own."""
    return f"{name}_" if name in _RESERVED else name


def _constant(node: ast.AST, value: object) -> str:
    import json

    if value is None or isinstance(value, bool | str | int | float):
        return json.dumps(value, ensure_ascii=False)
    raise NotTranslated(node)
