"""Kernels use only operations that every processor and every C library rounds alike."""

import ast
from pathlib import Path

import pytest

from stackbounce import engine

FILES = sorted(Path(engine.__file__).parent.glob("*.py"))
EXACT = {"sqrt", "floor", "frexp", "isnan", "isfinite", "inf", "nan"}  # of `math`, exact everywhere
LIBRARY = {"pow", "round", "divmod"}  # builtins that may ask the C library


def kernels(tree):
    """Yield the functions of a module that are marked as kernels."""
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef):
            marks = {mark.id for mark in node.decorator_list if isinstance(mark, ast.Name)}
            if "kernel" in marks:
                yield node


def inexact(tree):
    """Yield what kernels of a module must not use: ``**``, ``%``, functions of libraries."""
    modules, names = set(), {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            modules |= {alias.asname or alias.name.partition(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module in ("math", "cmath", "numpy"):
            names |= {alias.asname or alias.name: alias.name for alias in node.names}
    for function in kernels(tree):
        for node in ast.walk(function):
            what = None
            if isinstance(node, ast.BinOp | ast.AugAssign):
                what = {ast.Pow: "**", ast.Mod: "%"}.get(type(node.op))
            elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
                exact = node.value.id == "math" and node.attr in EXACT
                if node.value.id in modules and not exact:
                    what = f"{node.value.id}.{node.attr}"
            elif isinstance(node, ast.Name) and (
                node.id in LIBRARY or names.get(node.id, "inf") not in EXACT
            ):
                what = node.id
            if what is not None:
                yield f"{function.name}: {what}"


def test_kernels_ask_no_library():
    trees = [ast.parse(path.read_text("utf-8")) for path in FILES]
    assert sum(len(list(kernels(tree))) for tree in trees) > 100
    assert [what for tree in trees for what in inexact(tree)] == []


@pytest.mark.parametrize(
    ("code", "what"),
    [("x ** 2", "**"), ("pow(x, y)", "pow"), ("np.exp(x)", "np.exp"), ("tangent(x)", "tangent")],
)
def test_what_is_refused(code, what):
    top = "import math\nimport numpy as np\nfrom math import tan as tangent\n"
    tree = ast.parse(f"{top}@kernel\ndef f(x):\n    return math.sqrt({code})\n")
    assert list(inexact(tree)) == [f"f: {what}"]
