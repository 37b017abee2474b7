"""What the files around the package promise."""

import doctest
import functools
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import pytest
import yaml

import stackbounce
import stackbounce as sb
from stackbounce import measure, plots

ROOT = Path(__file__).parents[2]
PAGES = sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")])
SLOW = ("gaps-and-masses.md", "paper.md", "towers.md")  # pages whose examples take long


def read(name):
    return (ROOT / name).read_text(encoding="utf-8")


@functools.cache
def tracked():
    """Return the texts of the files that git tracks, by name."""
    if not (ROOT / ".git").exists():
        pytest.skip("not a git checkout")
    git = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    names = subprocess.run(git, cwd=ROOT, check=True, capture_output=True, text=True).stdout
    paths = {name: ROOT / name for name in names.split("\0") if name and (ROOT / name).is_file()}
    return {name: path.read_text("utf-8", errors="ignore") for name, path in paths.items()}


def test_the_version_is_one_and_the_paper_is_cited():
    newest = re.search(r"^## \[(\d[^\]]*)\]", read("CHANGELOG.md"), re.MULTILINE)
    assert newest is not None
    assert newest[1] == stackbounce.__version__
    citation = yaml.safe_load(read("CITATION.cff"))
    assert citation["version"] == stackbounce.__version__
    assert [paper["doi"] for paper in citation["references"]] == ["10.1119/1.2772286"]


def test_constraints_are_versions_and_nothing_else():
    lines = [line for line in read("constraints.txt").splitlines() if not line.startswith("#")]
    assert lines
    assert not [line for line in lines if not re.fullmatch(r"[\w.-]+==[\w.]+", line)]


def test_readme_is_short_and_make_knows_its_two_commands():
    readme = read("README.md")
    assert len(readme.splitlines()) <= 120
    assert ".venv/bin/" not in readme
    commands = re.findall(r"^\$? *make (\w+)", readme, re.MULTILINE)
    assert commands == ["paper", "test"]
    makefile = read("Makefile")
    assert all(re.search(rf"^{target}:", makefile, re.MULTILINE) for target in commands)


@pytest.mark.parametrize(
    "pattern",
    [
        r"(?<![\w.-])/(?:work|home|root|Users)/\w|[Cc]:\\Users",
        r"--(?:extra-index-url|index-url|find-links)\b|\bindex[-_]url\s*=",
        r"\bhttps?://[^\s'\"<>)]+(?:\.whl|\.tar\.gz|/simple/?)(?![\w-])",
    ],
    ids=["path of one machine", "index of packages", "address of a package"],
)
def test_no_tracked_file_has_what_holds_on_one_machine_only(pattern):
    assert not {name for name, text in tracked().items() if re.search(pattern, text)}


def test_every_public_name_is_documented():
    api = read("docs/api.md")
    rooms = set(stackbounce.__all__) | set(measure.__all__) | set(plots.__all__)
    entries = re.findall(r"^.. auto(?:class|function|exception|data):: (\w+)$", api, re.MULTILINE)
    assert set(entries) == rooms - {"__version__", "laws"}  # a module: its members have entries


@pytest.mark.parametrize(
    "page",
    [
        pytest.param(page, id=page.name, marks=[pytest.mark.slow] if page.name in SLOW else [])
        for page in PAGES
    ],
)
def test_examples_on_pages_come_out_as_written(page):
    text = page.read_text("utf-8")
    fences = re.findall(r"^```(?:python|pycon)\n(>>> .*?)^```", text, re.MULTILINE | re.DOTALL)
    example = doctest.DocTestParser().get_doctest("\n".join(fences), {}, page.name, str(page), 0)
    flags = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
    assert doctest.DocTestRunner(optionflags=flags).run(example).failed == 0


@pytest.mark.parametrize(
    "page",
    [
        '<script src="https://cdn.example/x.js"></script>',
        '<img src="http://cdn.example/x.png">',
        "<style>@font-face { src: url('https://cdn.example/x.woff2') }</style>",
    ],
)
def test_a_page_that_fetches_is_seen(page, tmp_path):
    from offline import fetched

    (tmp_path / "local.html").write_text(
        '<a href="https://doi.example/1"><img src="_static/x.png"></a><script src="x.js"></script>'
    )
    assert not list(fetched(tmp_path))
    (tmp_path / "page.html").write_text(page)
    assert [path.name for path, _ in fetched(tmp_path)] == ["page.html"]


@pytest.mark.parametrize("latex", [r"\frac{a}", r"\nothing", r"\begin{gathered}a\\b\end{gathered}"])
def test_a_formula_that_is_not_understood_is_refused(latex):
    from mathml import mathml

    with pytest.raises(ValueError, match=r"unknown|parts"):
        mathml(latex, display=True)


def test_lines_of_a_formula_are_aligned():
    from mathml import mathml

    lines = r"a &= b \\ c &= d"
    assert mathml(lines, display=True).count("<mtr>") == 2
    aligned = rf"\begin{{aligned}} {lines} \end{{aligned}}"
    assert mathml(lines, display=True) == mathml(aligned, display=True)


# --- the package's front door: its names come when they are used, and its functions stay
def test_every_name_is_there():
    assert {name for name in sb.__all__ if not hasattr(sb, name)} == set()
    assert len(dir(sb)) <= 20
    assert {name for name in dir(sb) if not hasattr(sb, name)} == set()
    for package in (sb, measure):
        stub = Path(package.__file__).with_suffix(".pyi").read_text("utf-8")
        names = {*package.__all__, *(dir(sb) if package is sb else ())}
        assert sorted(re.findall(r"as (\w+)$", stub, re.MULTILINE)) == sorted(names)


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
