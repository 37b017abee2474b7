"""Files are written by `stackbounce.files`; nothing is pickled, nor kept in a cache on the disk."""

import ast
from pathlib import Path

import stackbounce

SOURCE = Path(stackbounce.__file__).parent
WRITERS = {
    "write_text",
    "write_bytes",
    "to_csv",
    "to_netcdf",
    "to_zarr",
    "dump",
    "savefig",
    "tofile",
}
HOMES = {
    "files.py",  # the one writer
    "plots/style.py",  # a picture, into memory
    "cross2007/style.py",
}
UNSAFE = {"pickle", "cPickle", "marshal", "shelve", "dill", "cloudpickle", "joblib", "platformdirs"}


def modules():
    for path in SOURCE.rglob("*.py"):
        yield path.relative_to(SOURCE).as_posix(), ast.parse(path.read_text("utf-8"))


def test_files_are_written_in_one_place():
    found = {
        name
        for name, tree in modules()
        for node in ast.walk(tree)
        if isinstance(node, ast.Call) and getattr(node.func, "attr", "") in WRITERS
    }
    assert found == HOMES


def test_nothing_is_pickled_or_kept_in_a_cache():
    found = {
        (name, one)
        for name, tree in modules()
        for node in ast.walk(tree)
        if isinstance(node, ast.Import | ast.ImportFrom)
        for one in [getattr(node, "module", None), *(alias.name for alias in node.names)]
        if one in UNSAFE
    }
    assert found == set()
