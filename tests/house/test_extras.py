"""A plain install does what the core does, and names the extra that anything else needs."""

import subprocess
import sys
import tomllib
from pathlib import Path

import httpx
import pytest

from adversary.server import running
from stackbounce.errors import MissingExtra
from stackbounce.explorer.made import HEADERS, one_file
from stackbounce.extras import EXTRAS, MEASURING, need

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
CORE = {"pandas", "pydantic"}  # which xarray and typer bring
BROUGHT = sorted({module for modules in EXTRAS.values() for module in modules} - CORE)
COMPILERS = ["numba", "llvmlite"]  # for developers and benchmarks only
PLAIN = f"import sys; sys.modules |= dict.fromkeys({BROUGHT + COMPILERS}); "
SWEEP = ["sweep", "B1", "--over", "balls.0.mass=1,2", "--out", "a.zarr"]
COMMAND = PLAIN + "from stackbounce.cli import main; sys.exit(main(sys.argv[1:]))"


def plain(code, *arguments, folder="."):
    """Run Python where no extra is installed."""
    command = [sys.executable, "-c", code, *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder)


def brought(extra):
    """Return the modules that pyproject.toml gives an extra, with those of the extras in it."""
    found = set()
    for text in PROJECT["optional-dependencies"][extra]:
        name, _, inner = text.rstrip("]").partition("[")
        if name == "stackbounce":
            found |= {module for one in inner.split(",") for module in brought(one)}
        else:
            found.add(name.partition(">")[0].replace("-", "_"))
    return found


@pytest.mark.parametrize("extra", EXTRAS)
def test_an_extra_brings_what_it_says(extra):
    assert brought(extra) == set(EXTRAS[extra])
    assert brought(extra) <= brought("all")


def test_everything_is_in_all():
    assert set(PROJECT["optional-dependencies"]) == {*EXTRAS, "all"}
    assert len(PROJECT["dependencies"]) == 5


@pytest.mark.parametrize("extra", EXTRAS)
def test_a_missing_extra_is_named(extra, monkeypatch):
    for module in EXTRAS[extra]:
        monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(MissingExtra) as caught:
        need("a task", *EXTRAS[extra])
    names = ", ".join(EXTRAS[extra])
    assert str(caught.value) == f"a task needs {names}: pip install 'stackbounce[{extra}]'"


def test_what_is_installed_of_an_extra_is_not_named(monkeypatch):
    need("stackbounce fit", *MEASURING, "emcee")
    monkeypatch.setitem(sys.modules, "emcee", None)
    with pytest.raises(MissingExtra, match=r"^a fit needs emcee: pip install 'stackbounce\[lab\]'"):
        need("a fit", *MEASURING, "emcee")


@pytest.mark.fast_cases(1)
@pytest.mark.parametrize(
    "arguments",
    [
        ["simulate", "basketball", "tennis", "--height", "0.63m", "--gap", "2mm"],
        ["app", "--export", "explorer.html"],
        ["balls"],
        ["simulate", "B1", "--contact", "HuntCrossley stiffness=1e5 exponent=1.5 dissipation=.1"],
        ["highest", "--balls", "2"],
        *([command, "--help"] for command in ("measure", "fit", "paper", "app", "sweep")),
    ],
    ids=" ".join,
)
def test_a_plain_install_runs(arguments, tmp_path):
    run = plain(COMMAND, *arguments, folder=tmp_path)
    assert (run.returncode, run.stderr) == (0, "")


def test_a_plain_install_serves_the_page_that_plays():
    command = [sys.executable, "-c", COMMAND, "app", "--no-browser", "--port", "0"]
    with running(command, stderr=subprocess.PIPE) as process:
        address = process.stdout.readline().split()[2]
        assert process.stdout.readline().endswith("pip install 'stackbounce[app]'\n")
        page, nothing = httpx.get(f"{address}?lang=de"), httpx.get(f"{address}api/places")
        process.terminate()
        assert process.communicate(timeout=30) == ("", "")
    assert (page.status_code, page.text, process.returncode) == (200, one_file(), 0)
    assert page.headers["content-security-policy"] == "frame-ancestors 'none'"
    assert page.headers.items() >= HEADERS.items()
    assert (nothing.status_code, nothing.content) == (404, b"")


@pytest.mark.slow
def test_a_plain_install_sweeps():
    run = plain(
        PLAIN + "import stackbounce as sb; "
        "drop = sb.Drop([sb.Ball(1.0)], [sb.Spring(1.0)], height=1.0); "
        "ds = sb.sweep(drop, {'balls.0.mass': [1.0, 2.0]}); "
        "sb.simulate(drop).sample([0.0, 1.0]); sb.separate(drop); "
        "print(ds.collisions.values.ravel())"
    )
    assert (run.stdout, run.stderr) == ("[1 1]\n", "")


@pytest.mark.slow
def test_the_paper_by_call_needs_what_measures_and_what_draws():
    without = sorted({*BROUGHT, "markupsafe"} - {*MEASURING, "matplotlib"})
    run = plain(
        f"import sys; sys.modules |= dict.fromkeys({without}); import stackbounce as sb; "
        "found = sb.cross2007.figure('4a'), sb.cross2007.table('II'), sb.cross2007.audit(); "
        "print([len(made._repr_html_()) > 1000 for made in found])"
    )
    assert (run.stdout, run.stderr) == ("[True, True, True]\n", "")


@pytest.mark.fast_cases(1)
@pytest.mark.parametrize(
    ("arguments", "what", "modules"),
    [
        (["measure", "sound.wav"], "stackbounce measure", MEASURING),
        (["fit", "drop.toml"], "stackbounce fit", MEASURING),
        (["highest", "B1", "B2", "--in-order", "--masses"], "a search for masses", ["scipy"]),
        (["paper", "--out", "paper"], "stackbounce paper", [*MEASURING, "jinja2", "matplotlib"]),
        (["fit", "dataset:golf-marble-heights"], "stackbounce fit", MEASURING),
        (["simulate", "B1", "--plot", "b1.png"], "--plot", ["matplotlib"]),
        (["simulate", "B1", "--height", "63 ± 1 cm"], "a number with an error", MEASURING),
        (SWEEP, "a .zarr file", ["dask", "zarr"]),
        ([*SWEEP, "--cluster", "localhost:8786"], "--cluster", ["distributed"]),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_a_command_names_the_extra_it_needs(arguments, what, modules, tmp_path):
    run = plain(COMMAND, *arguments, folder=tmp_path)
    missing = ", ".join(module for module in modules if module in BROUGHT)
    extra = "sweep" if modules[0] in EXTRAS["sweep"] else "lab"
    words = f"{what} needs {missing}: pip install 'stackbounce[{extra}]'"
    assert run.stderr == f"stackbounce: error: {words}\n"
    assert (run.returncode, run.stdout, list(tmp_path.iterdir())) == (2, "", [])


@pytest.mark.parametrize(
    "code",
    [
        "import stackbounce as sb; sb.read('sound.wav')",
        pytest.param("from stackbounce.plots import bounce", marks=pytest.mark.slow),
    ],
)
def test_a_function_names_the_extra_it_needs(code):
    run = plain(PLAIN + code)
    assert run.stderr.endswith(": pip install 'stackbounce[lab]'\n")
    assert "stackbounce.errors.MissingExtra: " in run.stderr
