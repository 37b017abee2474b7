"""The two rules of the architecture, beyond what import-linter checks."""

import ast
from pathlib import Path

import grimp
import pytest

import stackbounce

SOURCE = Path(stackbounce.__file__).parent
LAWS = {"Dashpot", "HuntCrossley", "Viscoelastic"}  # those that nothing else builds upon
AT_HOME = ("model/laws/", "model/__init__.py", "__init__.py", "cross2007/")


def in_code(tree):
    """Yield the names and texts of a module, without its docstrings."""
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef)
    docs = {node.body[0] for node in ast.walk(tree) if isinstance(node, documented) and node.body}
    texts = {node.value for node in docs if isinstance(node, ast.Expr)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and node not in texts:
            yield node.value
        yield from (getattr(node, name, "") for name in ("id", "attr", "name"))


def test_a_law_is_named_where_it_is_defined_and_nowhere_else():
    found = {
        str(path.relative_to(SOURCE))
        for path in SOURCE.rglob("*.py")
        if LAWS & {text for text in in_code(ast.parse(path.read_text("utf-8"))) if text}
    }
    assert {name for name in found if not name.startswith(AT_HOME)} == set()
    assert found


@pytest.fixture(scope="module")
def imports():
    """What each file imports, also inside functions.

    Not what only type checkers import, nor a folder that the file lies in, such as a registry.
    """
    graph = grimp.build_graph("stackbounce", exclude_type_checking_imports=True)
    return {
        name: {
            other
            for other in graph.find_modules_directly_imported_by(name)
            if not name.startswith(f"{other}.")
        }
        for name in graph.modules
    }


def test_no_file_imports_itself_through_others(imports):
    users = {name: {other for other in imports if name in imports[other]} for name in imports}
    rest = set(imports)
    while free := {name for name in rest if not imports[name] & rest or not users[name] & rest}:
        rest -= free
    assert rest == set()
