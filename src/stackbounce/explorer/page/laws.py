"""The formulas of the contact laws as JavaScript: `laws.js`, translated from the laws' own files.

A class becomes a class, with the fields and constants that it has and those methods that the page
calls, or that these need. What they use of other files comes along. Of a law whose restitution has
no formula, the page runs a simulation, as Python does.
"""

import ast
import dataclasses
import functools
import importlib
import inspect
import json
import math
import sys
from types import ModuleType
from typing import Any

from stackbounce.explorer.page.bounds import limits_of
from stackbounce.explorer.page.translation import METHODS, expression, function, names_in
from stackbounce.model.laws import LAWS, ContactLaw

__all__ = ["laws_js"]

_ASKED = frozenset(
    "restitution_at contact_time_at calibrated calibration_needs engine_numbers loss_fields "
    "derived_field contact_time_depends_on default_exponent fixed_exponent __post_init__ "
    "replaced to_mapping pressed_on".split()
)
"""The methods that the page calls."""

_BASE_HAS = {"quantities", "replaced", "to_mapping"}
"""Methods of `ContactLaw` that look at dataclasses: `LawBase` in JavaScript has its own."""

_OURS = "stackbounce.model"
_BY_HAND = (
    {  # names of other files that static/js/model has, too
        ("functools", "partial"): "partial",
        ("numpy", "maximum"): "max",
        ("numpy", "minimum"): "min",
        ("stackbounce.engine.codes", "FORMS"): "FORMS",
        ("stackbounce.engine.one_ball", "bounce"): "bounce",
        ("stackbounce.model.laws.law", "Quantity"): "Quantity",
        ("stackbounce.model.laws.law", "_NOTHING"): "NOTHING",
        ("stackbounce.model.laws.rigid_by_speed", "powers"): "pow",
    }
    | {
        ("stackbounce.errors", name): name
        for name in "InvalidType InvalidValue between fraction nearest positive shown".split()
    }
    | {("stackbounce.errors", "non_negative"): "nonNegative"}
)
_FILES = {
    "one_ball": "FORMS bounce",
    "law": "LawBase Quantity",
    "errors": "InvalidType InvalidValue between fraction nearest nonNegative positive shown",
}
"""Where these are, if not in python.js."""

_ALWAYS = (
    "LawBase both cached contains div either formatted is_str math pow repr truth united".split()
)
_BUILTINS = (
    "abs dict enumerate float getattr len max min object range reversed sum tuple type zip".split()
)
_ERRORS = "ArithmeticError OverflowError ZeroDivisionError".split()
_PLAIN = (str, int, float, bool, type(None))


def laws_js() -> str:
    """Return the text of `laws.js`.

    Examples
    --------
    >>> "class dashpot__Dashpot extends law__ContactLaw" in laws_js()
    True
    """
    pieces = _Pieces()
    named = {name: pieces.need(sys.modules[law.__module__], name) for name, law in LAWS.items()}
    laws = ", ".join(f"{json.dumps(name)}: {made}" for name, made in named.items())
    head = "/** The formulas of the contact laws, made from Python by explorer/page/laws.py. */\n"
    last = f"\nexport const LAWS = {{ {laws} }};\n"
    return "\n".join([head, *_imports(pieces.imported), *pieces.texts, last])


def _imports(names: set[str]) -> list[str]:
    """Return the lines that import names from files of `static/js/model`."""
    files = {name: file for file, listed in _FILES.items() for name in listed.split()}
    groups: dict[str, list[str]] = {}
    for name in sorted(names):
        groups.setdefault(files.get(name, "python"), []).append(name)
    return [
        f'import {{ {", ".join(listed)} }} from "../js/model/{file}.js";'
        for file, listed in sorted(groups.items())
    ]


class _Pieces:
    """The pieces of Python that are needed, each translated once and after all that it needs."""

    def __init__(self) -> None:
        self.texts: list[str] = []
        self.imported = {*_ALWAYS, *METHODS}
        self._made: dict[tuple[str, str], str] = {}
        self._methods = _methods_needed()

    def need(self, module: ModuleType, name: str) -> str:
        """Return what a module's name is called in JavaScript; translate it if it is new."""
        home, name = _home(module, name)
        key = (home.__name__, name)
        if key in _BY_HAND:
            return self._by_hand(_BY_HAND[key])
        if key not in self._made:
            made = f"{home.__name__.rpartition('.')[2]}__{name}"
            self._made[key] = made
            self.texts.append(self._translated(home, name, made))
        return self._made[key]

    def _by_hand(self, name: str) -> str:
        self.imported.add(name)
        return name

    def _translated(self, home: ModuleType, name: str, made: str) -> str:
        node = _definitions(home)[name]
        resolve = functools.partial(self._resolve, home)
        for one in [] if isinstance(node, ast.ClassDef) else names_in(node):
            resolve(one)  # what it needs comes first
        if isinstance(node, ast.ClassDef):
            return self._class(home, node, made)
        if isinstance(node, ast.FunctionDef):
            text = function(node, resolve, f"function {made}")
            if any("cache" in ast.unparse(mark) for mark in node.decorator_list):
                return f"\nconst {made} = cached({function(node, resolve, 'function ')});"
            return f"\n{text}"
        assert isinstance(node, ast.Assign | ast.AnnAssign)
        assert node.value is not None
        return f"\nconst {made} = {expression(node.value, resolve)};"

    def _class(self, home: ModuleType, node: ast.ClassDef, made: str) -> str:
        kind: type[ContactLaw] = getattr(home, node.name)
        resolve = functools.partial(self._resolve, home)
        base = kind.__base__
        if base is object:
            above = "LawBase"
        else:
            assert base is not None
            above = self.need(sys.modules[base.__module__], base.__name__)
        parts = []
        for one in node.body:
            if not isinstance(one, ast.FunctionDef) or one.name not in self._methods:
                continue
            if kind is not ContactLaw or one.name not in _BASE_HAS:
                for name in names_in(one):
                    resolve(name)
                marks = {ast.unparse(mark) for mark in one.decorator_list}
                head = (
                    "static " if "classmethod" in marks else "get " if "property" in marks else ""
                )
                parts.append("  " + function(one, resolve, head + one.name).replace("\n", "\n  "))
        known = json.dumps(_constants_of(kind), ensure_ascii=False)
        body = "\n".join(parts)
        return f"\nclass {made} extends {above} {{\n{body}\n}}\n{made}.tell({known});"

    def _resolve(self, home: ModuleType, node: ast.expr) -> str | None:
        """Return what a name is called in JavaScript; None for one of the function's own."""
        if isinstance(node, ast.Attribute):
            owner = vars(home).get(node.value.id) if isinstance(node.value, ast.Name) else None
            if isinstance(node.value, ast.Name) and node.value.id == "np":
                return self._by_hand(_BY_HAND["numpy", node.attr])
            if owner is math or not isinstance(owner, ModuleType):
                return None
            if (owner.__name__, node.attr) in _BY_HAND or owner.__name__.startswith(_OURS):
                return self.need(owner, node.attr)
            return self.need(owner, node.attr) if owner is functools else None
        assert isinstance(node, ast.Name)
        if node.id == "math":
            return "math"
        if node.id in _definitions(home):
            return self.need(home, node.id)
        if node.id in _BUILTINS or node.id in _ERRORS:
            return node.id if node.id in ("object", "getattr", "type") else self._by_hand(node.id)
        if node.id == "bounce":
            return self._by_hand("bounce")
        found = vars(home).get(node.id)
        return None if found is None or isinstance(found, ModuleType) else self.need(home, node.id)


def _home(module: ModuleType, name: str) -> tuple[ModuleType, str]:
    """Return the module in which a name of a module is defined."""
    if name in _definitions(module) or not module.__name__.startswith("stackbounce"):
        return module, name
    for node in ast.walk(ast.parse(inspect.getsource(module))):
        if isinstance(node, ast.ImportFrom) and node.module:
            for one in node.names:
                if (one.asname or one.name) == name:
                    return _home(importlib.import_module(node.module), one.name)
    raise LookupError(f"{module.__name__} has no {name}")


@functools.cache
def _definitions(module: ModuleType) -> dict[str, ast.stmt]:
    """Return the definitions at the top of a module, by name."""
    if not module.__name__.startswith("stackbounce"):
        return {}
    found: dict[str, ast.stmt] = {}
    for node in ast.parse(inspect.getsource(module)).body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            found[node.name] = node
        elif isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name):
            found[node.targets[0].id] = node
        elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            found[node.target.id] = node
    return found


def _methods_needed() -> set[str]:
    """Return the names of the methods that the page calls, and of those that these call."""
    kinds = {kind for law in LAWS.values() for kind in law.__mro__ if kind is not object}
    bodies = {
        (kind, one.name): one
        for kind in kinds
        for one in _definitions(sys.modules[kind.__module__])[kind.__name__].body  # type: ignore[attr-defined]
        if isinstance(one, ast.FunctionDef)
    }
    names = {name for _, name in bodies}
    needed: set[str] = set(_ASKED)
    before: set[str] = set()
    while needed != before:
        before = set(needed)
        for (_, name), body in bodies.items():
            if name in before:
                needed |= {
                    one.attr for one in names_in(body) if isinstance(one, ast.Attribute)
                } & names
    return needed


def _constants_of(kind: type[ContactLaw]) -> dict[str, Any]:
    """Return a class's own constants, its fields, and the limits of its numbers."""
    own = {
        name: list(value) if isinstance(value, tuple) else value
        for name, value in vars(kind).items()
        if not name.startswith("_")
        and (isinstance(value, _PLAIN) or (isinstance(value, tuple) and _all_plain(value)))
        and name not in ("says", "formula", "source")
    }
    told: dict[str, Any] = {"constants": own}
    if kind.__name__ in LAWS:
        members = dataclasses.fields(kind)  # type: ignore[arg-type]
        for one in members:
            own.pop(one.name, None)
        told["law"] = kind.__name__
        told["fields"] = [
            {"name": one.name, "named": one.kw_only}
            | ({} if one.default is dataclasses.MISSING else {"default": one.default})
            for one in members
            if one.init
        ]
        told["numbers"] = {
            name: {"unit": number.symbol} | limits_of(number.check)
            for name, number in kind.quantities().items()
        }
    return told


def _all_plain(values: tuple[object, ...]) -> bool:
    return all(isinstance(value, _PLAIN) for value in values)
