"""Rules of the architecture and of files, beyond what import-linter checks.

Files are written by `stackbounce.files`; nothing is pickled, nor kept in a cache on the disk.
"""

import ast
from pathlib import Path

import grimp
import pytest

import stackbounce

SOURCE = Path(stackbounce.__file__).parent
TREES = {
    path.relative_to(SOURCE).as_posix(): ast.parse(path.read_text("utf-8"))
    for path in SOURCE.rglob("*.py")
}
LAWS = {"Dashpot", "HuntCrossley", "Viscoelastic"}  # those that nothing else builds upon
AT_HOME = ("model/laws/", "model/__init__.py", "__init__.py", "cross2007/")

WRITERS = set("write_text write_bytes to_csv to_netcdf to_zarr dump savefig tofile".split())
# the writer; pictures into memory
HOMES = {"files.py", "plots/style.py", "plots/figure.py", "cross2007/style.py"}
UNSAFE = {"pickle", "cPickle", "marshal", "shelve", "dill", "cloudpickle", "joblib", "platformdirs"}


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
    found = {name for name, tree in TREES.items() if LAWS & set(filter(None, in_code(tree)))}
    assert {name for name in found if not name.startswith(AT_HOME)} == set()
    assert found


def test_files_are_written_in_one_place():
    found = {
        name
        for name, tree in TREES.items()
        for node in ast.walk(tree)
        if isinstance(node, ast.Call) and getattr(node.func, "attr", "") in WRITERS
        if node.args  # to_csv() returns the text
    }
    assert found == HOMES


def test_nothing_is_pickled_or_kept_in_a_cache():
    found = {
        (name, one)
        for name, tree in TREES.items()
        for node in ast.walk(tree)
        if isinstance(node, ast.Import | ast.ImportFrom)
        for one in [getattr(node, "module", None), *(alias.name for alias in node.names)]
        if one in UNSAFE
    }
    assert found == set()


@pytest.fixture(scope="module")
def imports():
    """What each file imports when it runs, but for folders that it lies in, such as a registry."""
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
