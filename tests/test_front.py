"""The package's front door: its names come when they are used, and its functions stay."""

import importlib
import subprocess
import sys

import pytest

import stackbounce as sb


def test_every_name_is_there():
    assert {name for name in sb.__all__ if not hasattr(sb, name)} == set()
    assert set(sb.__all__) <= set(dir(sb))


@pytest.mark.parametrize("name", ["calibrate", "simulate", "sweep"])
@pytest.mark.parametrize("how", ["imported again", "set"])
def test_a_module_does_not_hide_the_function_of_its_name(name, how, monkeypatch):
    """As pytest sets it, which loads a file that it finds doctests in by itself."""
    function, module = getattr(sb, name), sys.modules[f"stackbounce.{name}"]
    assert callable(function)
    if how == "set":
        setattr(sb, name, module)
    else:
        for own in [one for one in sys.modules if f"{one}.".startswith(f"stackbounce.{name}.")]:
            monkeypatch.delitem(sys.modules, own)
        assert importlib.import_module(f"stackbounce.{name}") is not module
    assert getattr(sb, name) is function


@pytest.mark.parametrize(
    "first", ["", "import stackbounce.simulate", "from stackbounce.sweep import grid, write"]
)
def test_names_do_not_depend_on_what_was_imported_first(first):
    code = (
        f"{first}\nimport sys, stackbounce as sb\n"
        "assert all(map(callable, (sb.sweep, sb.calibrate, sb.simulate)))\n"
        "assert sb.errors.InvalidValue is not sb.StackbounceError\n"
        "from stackbounce import *\nassert simulate is sb.simulate\n"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert run.stderr == ""


def test_the_package_imports_nothing_until_it_is_used():
    code = "import sys, stackbounce; sys.exit('numpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_a_name_that_is_not_there_is_an_attribute_error():
    for name in ("simulat", "_simulate", "__wrapped__"):
        with pytest.raises(AttributeError, match=f"no attribute '{name}'"):
            getattr(sb, name)
    with pytest.raises(ImportError):
        from stackbounce import simulat  # noqa: F401
