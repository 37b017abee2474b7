"""The package's front door: its names come when they are used, and its functions stay."""

import pkgutil
import subprocess
import sys

import pytest

import stackbounce as sb


def test_every_name_is_there():
    assert {name for name in sb.__all__ if not hasattr(sb, name)} == set()
    assert set(sb.__all__) <= set(dir(sb))


def test_no_module_has_the_name_of_a_function():
    """Python sets each submodule as an attribute of its package, and would hide the function."""
    modules = {module.name for module in pkgutil.iter_modules(sb.__path__)}
    assert modules & set(sb.__all__) == set()


def test_a_name_that_is_not_there_is_an_attribute_error():
    for name in ("simulat", "_simulate", "__wrapped__"):
        with pytest.raises(AttributeError, match=f"no attribute '{name}'"):
            getattr(sb, name)
    with pytest.raises(ImportError):
        from stackbounce import simulat  # noqa: F401


def run(code):
    """Run Python afresh; return what it says."""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    return done.stderr.strip()


@pytest.mark.fast_cases(1)
@pytest.mark.parametrize(
    "first", ["import stackbounce.run.driver\nfrom stackbounce.sweeps import grid, write", ""]
)
def test_names_do_not_depend_on_what_was_imported_first(first):
    code = (
        f"{first}\nimport sys, stackbounce as sb\n"
        "assert all(map(callable, (sb.sweep, sb.calibrate, sb.simulate)))\n"
        "assert sb.errors.InvalidValue is not sb.StackbounceError\n"
        "from stackbounce import *\nassert simulate is sb.simulate\n"
    )
    assert run(code) == ""


def test_nothing_is_imported_until_it_is_used_and_nothing_is_compiled_at_run_time():
    code = (
        "import sys, stackbounce as sb\n"
        "assert 'numpy' not in sys.modules\n"
        "drop = sb.Drop([sb.Ball(0.1)] * 2, [sb.Hertz(1e5)] * 2, impact_speed=1.0)\n"
        "data = {'rebound_ratios': [None, '1.2 ± 0.01']}\n"
        "assert sb.fit(drop, data, {'balls.0.mass': (0.1, 0.3)}).drop.balls[0].mass > 0.1\n"
        "sys.exit(', '.join({'numba', 'llvmlite'} & set(sys.modules)))\n"
    )
    assert run(code) == ""
