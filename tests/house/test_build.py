"""How kernels are compiled and the page is made when the package is built, and their wheel."""

import hashlib
import json
import re
import sys
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from types import SimpleNamespace

import hatch_build
import pytest
import wheel_build
from kernel_build import __main__ as command
from kernel_build import build as builder
from kernel_build import machine_code
from kernel_build.targets import TARGETS, WASM
from packaging.utils import parse_wheel_filename
from page_build import build as page_builder

from stackbounce.engine import native
from stackbounce.errors import FileError
from stackbounce.explorer import made
from stackbounce.version import __version__

ROOT = Path(__file__).parents[2]
NAMES = ["linux-x86_64", WASM]


@pytest.fixture
def quick(monkeypatch):
    """Let libraries be long files of nothing, quick to make."""
    monkeypatch.setattr(builder, "compile_entries", lambda _, names: [[b""]] * len(names))
    monkeypatch.setattr(machine_code, "link", lambda *_: _[-1].file.encode() * 100_000)


def test_the_tools_have_the_versions_of_the_constraints():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    needs = [one.split(";")[0].strip() for one in project["build-system"]["requires"]]
    pinned = (ROOT / "constraints.txt").read_text("utf-8").splitlines()
    names = [one.partition("==")[0] for one in needs]
    assert names == ["hatchling", "llvmlite", "numba", "numpy", "Pint", "scipy", "ziglang"]
    assert set(needs) - {"hatchling"} <= set(pinned)


def test_the_metadata_have_the_licence_of_all_that_is_vendored():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    named = {path for pattern in project["license-files"] for path in ROOT.glob(pattern)}
    vendored = [path for path in (ROOT / "src").rglob("vendor/*") if path.is_dir()]
    assert vendored
    assert {ROOT / "LICENSE", *(path / "LICENSE" for path in vendored)} == named
    assert project["license"] == "BSD-3-Clause AND MIT"


def test_the_long_description_has_whole_addresses_of_what_there_is():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    source = project["urls"]["Source"]
    hatch_build.ReadmeHook(str(ROOT), {}).update(project)
    links = re.findall(r"\]\(([^)]+)\)", project["readme"]["text"])
    assert f"{source}/raw/v{__version__}/docs/_static/film.gif" in links
    assert f"{source}/releases/latest" in links
    pages = [link.removeprefix(f"{source}/blob/v{__version__}/") for link in links]
    pages = [page.partition("#")[0] for page in pages if not page.startswith(source)]
    assert len(pages) > 10
    assert [page for page in pages if not (ROOT / page).is_file()] == []


@pytest.mark.usefixtures("quick")
def test_a_build_is_up_to_date_until_something_changes(tmp_path, monkeypatch):
    assert not builder.is_up_to_date(tmp_path, NAMES)
    builder.build(NAMES, tmp_path)
    assert builder.is_up_to_date(tmp_path, NAMES)
    assert not builder.is_up_to_date(tmp_path, [*NAMES, "macos-aarch64"])
    for digest in ("digest_of_sources", "_digest_of_builder"):
        with monkeypatch.context() as patch:
            patch.setattr(builder, digest, lambda: "another")
            assert not builder.is_up_to_date(tmp_path, NAMES)
    (tmp_path / "engine.wasm").write_bytes(b"")
    assert not builder.is_up_to_date(tmp_path, NAMES)


@pytest.mark.usefixtures("quick")
def test_builds_at_once_never_show_half_a_file(tmp_path):
    """Two threads build the same while another one reads."""
    names = ["layout.json", "manifest.json", *(TARGETS[name].file for name in NAMES)]
    builder.build(NAMES, tmp_path)
    whole = {name: (tmp_path / name).read_bytes() for name in names}
    with ThreadPoolExecutor(2) as pool:
        builds = [pool.submit(builder.build, NAMES, tmp_path) for _ in range(20)]
        while not all(build.done() for build in builds):
            for name in names:
                assert (tmp_path / name).read_bytes() == whole[name]
    assert [build.result() for build in builds] == [None] * 20
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(names)


def test_what_cannot_be_compiled_is_said_in_a_line(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(sys, "argv", ["", "--platform", "sunos-sparc"])
    assert command.main() == command.IMPOSSIBLE
    monkeypatch.setattr(sys, "argv", ["", "--folder", str(tmp_path)])
    monkeypatch.setitem(sys.modules, "numba", None)
    assert command.main() == command.NO_COMPILER
    monkeypatch.undo()
    monkeypatch.setattr(sys, "argv", ["", "--folder", str(tmp_path)])
    monkeypatch.setattr(sys, "executable", "no-such-python")
    assert command.main() == command.NO_COMPILER
    platform, numba, zig = capsys.readouterr().err.splitlines()
    assert platform == "kernels are not compiled for sunos-sparc; drops run as plain Python"
    assert numba.startswith("compiling kernels needs numba: ")
    assert zig.startswith("compiling kernels needs zig: ")


class Aborted(Exception):
    """What hatchling's abort raises here."""


def hook_with(monkeypatch, status, platform=""):
    """Return a hook for which the compilation ends with a status, and the commands that it ran."""
    commands = []

    def run(command, **_):
        commands.append(command)
        folder = Path(command[-1])
        if status == 0 and not folder.exists() and "--engine" in command:
            page_builder.build(Path(native.FOLDER), folder)
        elif status == 0 and not folder.exists():
            builder.build([platform, WASM], folder)
        return SimpleNamespace(returncode=status)

    monkeypatch.setattr(hatch_build.subprocess, "run", run)
    monkeypatch.setenv("STACKBOUNCE_PLATFORM", platform)
    monkeypatch.setattr(sys, "path", [*sys.path])

    def abort_with(message):
        raise Aborted(message)

    hook = object.__new__(hatch_build.KernelHook)
    monkeypatch.setattr(hatch_build.KernelHook, "root", str(ROOT))
    monkeypatch.setattr(hatch_build.KernelHook, "app", SimpleNamespace(abort=abort_with))
    return hook, commands


def put(hook, version="standard"):
    """Return what a hook sets of a build, and the files that it puts into the wheel."""
    data = {"force_include": {}}
    hook.initialize(version, data)
    return data, {place: Path(file) for file, place in data["force_include"].items()}


def test_a_wheel_of_this_machine_has_its_library_and_the_page(monkeypatch):
    hook, commands = hook_with(monkeypatch, 0)
    data, files = put(hook)
    target = TARGETS[native.platform_name()]
    assert (data["pure_python"], data["tag"]) == (False, f"py3-none-{target.wheel}")
    prefix = "stackbounce/engine/native/"
    manifest = json.loads(files.pop(f"{prefix}manifest.json").read_text())
    assert manifest["sources"] == native.digest_of_sources()
    (entry,) = manifest["libraries"].values()
    content = files.pop(prefix + target.file).read_bytes()
    assert hashlib.sha256(content).hexdigest() == entry["sha256"]
    page = {path.name: path.read_bytes() for path in files.values()}
    assert set(files) == {f"stackbounce/explorer/made/{name}" for name in page}
    assert page == page_builder.list_files(Path(native.FOLDER))  # whatever the order of sets
    assert len(commands) == 2


def test_a_page_is_up_to_date_until_something_changes(monkeypatch, tmp_path):
    engine, page = Path(native.FOLDER), tmp_path / "page"
    page_builder.build(engine, page)
    assert page_builder.is_up_to_date(engine, page)
    monkeypatch.setattr(page_builder, "_read_engine", lambda _: {"engine.wasm": b""})
    assert not page_builder.is_up_to_date(engine, page)
    monkeypatch.setattr(native, "digest_of_sources", lambda: "another")
    assert not page_builder.has_engine(engine)
    monkeypatch.setattr(made, "FOLDER", tmp_path)
    with pytest.raises(FileError, match=r"folder\.html is not in this installation"):
        made.folder_files()


@pytest.mark.usefixtures("quick")
def test_a_wheel_of_another_platform_leaves_the_sources_alone(monkeypatch, tmp_path):
    monkeypatch.setattr(hatch_build, "BUILT", str(tmp_path))
    hook, commands = hook_with(monkeypatch, 0, "macos-aarch64")
    data, files = put(hook)
    assert data["tag"] == "py3-none-macosx_11_0_arm64"
    assert "stackbounce/engine/native/macos-aarch64.dylib" in files
    assert all(tmp_path in file.parents for file in files.values())
    kernels, page = tmp_path / "native", tmp_path / "page"
    assert commands[0][-3:] == ["macos-aarch64", "--folder", str(kernels)]
    assert commands[1][-4:] == ["--engine", str(kernels), "--folder", str(page)]
    assert files["stackbounce/explorer/made/model.json"] == page / "model.json"


@pytest.mark.usefixtures("quick")
def test_the_wheel_for_any_machine_has_the_page_and_no_library(monkeypatch, tmp_path):
    monkeypatch.setattr(hatch_build, "BUILT", str(tmp_path))
    hook, commands = hook_with(monkeypatch, 0, wheel_build.ANY)
    builder.build([WASM], tmp_path / "native")
    data, files = put(hook)
    assert set(data) == {"force_include"}
    assert set(files) == {f"stackbounce/explorer/made/{path.name}" for path in files.values()}
    assert WASM in commands[0]


def test_each_platform_has_a_wheel_and_the_others_have_one():
    parsed = {name: parse_wheel_filename(file) for name, file in wheel_build.WHEELS.items()}
    assert parsed.keys() == TARGETS.keys() - {WASM} | {wheel_build.ANY}
    assert {str(version) for _, version, *_ in parsed.values()} == {__version__}
    tags = [str(tag) for *_, tags in parsed.values() for tag in tags]
    assert len(set(tags)) == len(tags)
    assert [str(tag) for tag in parsed[wheel_build.ANY][-1]] == ["py3-none-any"]


def test_an_installation_of_the_sources_takes_their_folder(monkeypatch):
    hook, commands = hook_with(monkeypatch, 0, "macos-aarch64")
    assert put(hook, "editable")[0] == {"force_include": {}}
    assert commands[0][-1] == native.FOLDER
    assert commands[0][-3] == native.platform_name()


@pytest.mark.parametrize("status", [command.IMPOSSIBLE, command.NO_COMPILER])
def test_where_nothing_can_be_compiled_the_wheel_is_pure(status, monkeypatch):
    hook, _ = hook_with(monkeypatch, status)
    assert put(hook)[0] == {"force_include": {}}


@pytest.mark.parametrize(("status", "platform"), [(1, ""), (command.IMPOSSIBLE, "macos-aarch64")])
def test_a_failure_ends_the_build(status, platform, monkeypatch):
    hook, _ = hook_with(monkeypatch, status, platform)
    with pytest.raises(Aborted, match="the kernels could not be compiled for"):
        put(hook)
