"""Build all wheels and the sdist into `dist`, and check them: ``make wheels``, on Linux.

Six wheels: one for each platform of `kernel_build.targets`, compiled and linked here, and one in
plain Python for every other. The checks stop at the first that fails:

* the names are those of the targets, and all wheels hold the same but for the library
* twine and check-wheel-contents find nothing
* pip picks the platform's wheel on each platform, and the one in plain Python on any other
* in an empty environment commands and the examples of docstrings run, with the wheel in plain
  Python and with the compiled one, which also gives the bits that `tests/frozen` keeps
* the unpacked sdist gives all of them a second time, compiled anew, with the same bytes
"""

import os
import subprocess
import sys
import time
import zipfile
from pathlib import Path
from shutil import rmtree

from hatch_build import ANY, BUILT, NATIVE
from kernel_build.targets import TARGETS, WASM

from stackbounce.version import __version__

ROOT = Path(__file__).parent
DIST, ROOM = ROOT / "dist", ROOT / "build" / "wheels"
WHEELS = {  # the names of the files, by platform
    **{
        name: f"stackbounce-{__version__}-py3-none-{target.wheel}.whl"
        for name, target in TARGETS.items()
        if name != WASM
    },
    ANY: f"stackbounce-{__version__}-py3-none-any.whl",
}
SDIST = f"stackbounce-{__version__}.tar.gz"
ELSEWHERE = ("win32", "win_arm64", "linux_armv7l", "pyodide_2025_0_wasm32")
LOCAL = {"PIP_NO_INDEX": "1", "PIP_FIND_LINKS": str(DIST)}
PIP = ("-m", "pip", "--disable-pip-version-check", "--quiet", "--quiet")
CONSTRAINTS = ("--constraint", str(ROOT / "constraints.txt"))
ROOMS = ("engine", "model", "run")  # of the package, whose examples need no extra


def main() -> None:
    """Build and check, and tell how long each step took."""
    for folder in (DIST, ROOM):
        rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
    start = time.perf_counter()
    for step in STEPS:
        step()
        sys.stdout.write(f"{step.__name__}: {time.perf_counter() - start:.0f} s\n")
        sys.stdout.flush()


def build_all() -> None:
    """Compile the libraries that are not up to date, and write the wheels and the sdist."""
    _build(ROOT, DIST)


def check_contents() -> None:
    """Compare the files, of `dist` with the list, and of each wheel with those of the others."""
    assert {file.name for file in DIST.iterdir()} == {SDIST, *WHEELS.values()}
    whole = {name: _contents(DIST / file) for name, file in WHEELS.items()}
    plain = whole[ANY]
    for name, target in TARGETS.items():
        if name != WASM:
            library = {f"{NATIVE}/{target.file}", f"{NATIVE}/manifest.json"}
            assert whole[name].keys() == plain.keys() | library, name
            assert {file: whole[name][file] for file in plain} == plain, name


def check_with_tools() -> None:
    """Let the usual tools check the metadata and the contents."""
    python = _environment("tools", "twine", "check-wheel-contents")
    files = [str(file) for file in sorted(DIST.iterdir())]
    run(python, "-m", "twine", "check", "--strict", *files)
    run(python, "-m", "check_wheel_contents", *(file for file in files if file.endswith(".whl")))


def check_choice() -> None:
    """Ask pip which wheel it takes, on each platform."""
    expected = {
        tag: WHEELS[name]
        for name, target in TARGETS.items()
        if name != WASM
        for tag in target.wheel.split(".")
    } | dict.fromkeys(ELSEWHERE, WHEELS[ANY])
    for tag, file in expected.items():
        folder = ROOM / "picked" / tag
        only = ("--no-deps", "--only-binary", ":all:", "--platform", tag, "--dest", str(folder))
        run(sys.executable, *PIP, "download", *only, "stackbounce", **LOCAL)
        assert [picked.name for picked in folder.iterdir()] == [file], tag


def check_installed() -> None:
    """Try the wheel in plain Python, then the one that pip takes, in an empty environment."""
    python = _environment("empty", "pytest", str(DIST / WHEELS[ANY]))
    _try(python, compiled=False)
    again = ("install", "--no-deps", "--force-reinstall", "stackbounce")
    run(python, *PIP, *again, **LOCAL)
    _try(python, compiled=True)


def check_again() -> None:
    """Build everything from the unpacked sdist, with nothing compiled before; compare the bytes."""
    run("tar", "--extract", "--file", str(DIST / SDIST), "--directory", str(ROOM))
    _build(ROOM / SDIST.removesuffix(".tar.gz"), ROOM / "again")
    for file in DIST.iterdir():
        assert (ROOM / "again" / file.name).read_bytes() == file.read_bytes(), file.name


def run(*command: str, cwd: Path = ROOT, **variables: str) -> None:
    """Run a command, with more variables of the environment; an error ends the build."""
    subprocess.run(command, cwd=cwd, check=True, env=os.environ | variables)


def _build(root: Path, folder: Path) -> None:
    """Write the wheels and the sdist of a source tree to a folder."""
    own = {"cwd": root, "PYTHONPATH": str(root / "src")}
    run(sys.executable, "-m", "kernel_build", "--all", "--folder", f"{BUILT}/native", **own)
    hatchling = (sys.executable, "-m", "hatchling", "build", "--directory", str(folder))
    for name in WHEELS:
        run(*hatchling, "--target", "wheel", STACKBOUNCE_PLATFORM=name, **own)
    run(*hatchling, "--target", "sdist", **own)


def _try(python: str, compiled: bool) -> None:
    """Run commands, examples and random drops with what is installed, not with the sources."""
    ask = f"from stackbounce.engine import native; assert native.available() is {compiled}"
    flags = "doctest_optionflags=ELLIPSIS NORMALIZE_WHITESPACE"
    own = {"PYTHONPATH": "", "PYTHONWARNINGS": "ignore:drops run as plain Python"}
    examples = [f"stackbounce.{name}" for name in ROOMS]
    pytest = ("pytest", "-q", "-c", os.devnull, "-p", "no:cacheprovider", "--doctest-modules")
    run(python, "-c", ask, cwd=ROOM, **own)
    run(python, "-m", "stackbounce", "simulate", "basketball", "tennis", cwd=ROOM, **own)
    page = ("app", "--export", f"explorer-{compiled}.html")
    run(python, "-m", "stackbounce", *page, cwd=ROOM, **own)
    run(python, "-m", *pytest, "-o", flags, "--pyargs", *examples, cwd=ROOM, **own)
    if compiled:  # these run some drops in plain Python, too
        run(python, "-m", "frozen", "fuzz", cwd=ROOT / "tests", **own)


def _environment(name: str, *needs: str) -> str:
    """Return the interpreter of a new environment with what it needs."""
    run(sys.executable, "-m", "venv", str(ROOM / name))
    python = str(ROOM / name / "bin" / "python")
    run(python, *PIP, "install", "--no-compile", *CONSTRAINTS, *needs)
    return python


def _contents(wheel: Path) -> dict[str, bytes]:
    """Return the files of a wheel, but for what names its platform and lists its files."""
    with zipfile.ZipFile(wheel) as archive:
        return {
            name: archive.read(name)
            for name in archive.namelist()
            if not name.endswith((".dist-info/WHEEL", ".dist-info/RECORD"))
        }


STEPS = (
    build_all,
    check_contents,
    check_with_tools,
    check_choice,
    check_installed,
    check_again,
)

if __name__ == "__main__":
    main()
