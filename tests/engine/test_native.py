"""A library that does not fit is never loaded: plain Python gives the same bits, with a warning."""

import functools
import hashlib
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import stackbounce as sb
from stackbounce.cli import main
from stackbounce.engine import native
from stackbounce.errors import InvalidValue
from stackbounce.run.driver import simulate

DROP = sb.Drop(
    [sb.Ball(0.6), sb.Ball(0.06)],
    [sb.Hertz(5e5), sb.Hysteretic(4e4, restitution=0.8)],
    impact_speed=3.0,
)
MASSES = {"balls.0.mass": [0.4, 0.6]}
SOURCE = Path(sb.__file__).parent
SAYS_BITS = """
import sys, stackbounce as sb
drop = sb.Drop([sb.Ball(0.6), sb.Ball(0.06)], [sb.Hertz(5e5), sb.Hertz(4e4)], impact_speed=3.0)
print(sb.simulate(drop, compiled=True).rebound_speeds.tobytes().hex())
print(sb.sweep(drop, {"balls.0.mass": [0.4, 0.6]}).rebound_ratio.values.tobytes().hex())
assert sys.modules.keys().isdisjoint({"numba", "llvmlite"})
"""


def forget():
    native._library.cache_clear()
    native.compiled.cache_clear()


@functools.cache
def good():
    """Return what compiled code gives, of the package's own library."""
    return simulate(DROP, compiled=True), sb.sweep(DROP, MASSES)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Return a copy of the folder of libraries, from which they are loaded."""
    good()
    copy = tmp_path / "native"
    shutil.copytree(native.FOLDER, copy)
    monkeypatch.setattr(native, "FOLDER", copy)
    forget()
    yield copy
    forget()


def library(folder):
    entry = json.loads((folder / "manifest.json").read_text())["libraries"]
    return folder / entry[native.platform_name()]["file"]


def no_manifest(folder, _):
    (folder / "manifest.json").unlink()


def no_folder(folder, _):
    shutil.rmtree(folder)


def garbage(folder, _):
    (folder / "manifest.json").write_bytes(b"\xff{")


def another_manifest(folder, _):
    (folder / "manifest.json").write_text('{"sources": 1, "libraries": [2]}')


def deep(folder, _):
    (folder / "manifest.json").write_text("[" * 100_000)


def change(folder, spoil):
    manifest = json.loads((folder / "manifest.json").read_text())
    spoil(manifest)
    (folder / "manifest.json").write_text(json.dumps(manifest))


def no_entry(folder, _):
    change(folder, lambda manifest: manifest["entries"].pop("run_batch"))


def odd_kind(folder, _):
    change(folder, lambda manifest: manifest["entries"]["run_drop"].append("text"))


def other_kinds(folder, _):
    change(folder, lambda manifest: manifest["entries"]["run_drop"].reverse())


def no_digest(folder, _):
    change(folder, lambda manifest: manifest.pop("digest"))


def write_entry(folder, entry):
    change(folder, lambda manifest: manifest.update(libraries={native.platform_name(): entry}))


def empty_entry(folder, _):
    write_entry(folder, {})


def half_an_entry(folder, _):
    write_entry(folder, {"file": "x.so"})


def odd_levels(folder, _):
    write_entry(folder, {"file": "x.so", "sha256": "", "levels": ["new"]})


def negative_levels(folder, _):
    write_entry(folder, {"file": "x.so", "sha256": "", "levels": ["v-1"]})


def truncated(folder, _):
    content = library(folder).read_bytes()
    library(folder).write_bytes(content[: len(content) // 2])


def foreign(folder, _):
    shutil.copyfile(folder / "engine.wasm", library(folder))


def no_library(folder, _):
    library(folder).unlink()


def unreadable(folder, _):
    library(folder).unlink()
    library(folder).mkdir()


def not_loadable(folder, _):
    library(folder).write_bytes(b"nothing to run")
    digest = {"sha256": hashlib.sha256(b"nothing to run").hexdigest()}
    change(folder, lambda manifest: manifest["libraries"][native.platform_name()].update(digest))


def changed(_, monkeypatch):
    monkeypatch.setattr(native, "digest_of_sources", lambda: "0" * 64)


def unknown_platform(_, monkeypatch):
    monkeypatch.setattr(native, "platform_name", lambda: "sunos-sparc")


def old_processor(folder, monkeypatch):
    manifest = json.loads((folder / "manifest.json").read_text())
    if not manifest["libraries"][native.platform_name()]["levels"]:
        pytest.skip("the library of this platform has one level")
    monkeypatch.setattr(native, "_processor_level", lambda _: 1)


BAD = {
    no_manifest: "was built without compiled code (install a wheel that has it, or run make ker",
    no_folder: "was built without compiled code",
    garbage: "manifest.json is damaged: install stackbounce again",
    another_manifest: "manifest.json is damaged: install stackbounce again",
    empty_entry: "manifest.json is damaged: install stackbounce again",
    odd_levels: "manifest.json is damaged: install stackbounce again",
    half_an_entry: "manifest.json is damaged: install stackbounce again",
    negative_levels: "manifest.json is damaged: install stackbounce again",
    deep: "manifest.json is damaged: install stackbounce again",
    no_entry: "manifest.json is damaged: install stackbounce again",
    odd_kind: "manifest.json is damaged: install stackbounce again",
    other_kinds: "manifest.json is damaged: install stackbounce again",
    no_digest: "manifest.json is damaged: install stackbounce again",
    truncated: "is damaged or foreign: install stackbounce again",
    foreign: "is damaged or foreign: install stackbounce again",
    no_library: "cannot be read (No such file or directory): install stackbounce again",
    unreadable: "cannot be read (Is a directory): install stackbounce again",
    not_loadable: "cannot be loaded (",
    changed: "the engine's sources have changed: run make kernels",
    unknown_platform: "no compiled code for sunos-sparc: install one for it, if there is one",
    old_processor: "this processor lacks instructions of x86-64-v2: use a newer one",
}


@pytest.mark.parametrize(("spoil", "words"), BAD.items(), ids=lambda v: getattr(v, "__name__", ""))
def test_what_does_not_fit_is_not_loaded(spoil, words, folder, monkeypatch):
    one, many = good()
    spoil(folder, monkeypatch)
    with pytest.warns(native.NoCompiledCode) as seen:
        plain = simulate(DROP), sb.sweep(DROP, MASSES), simulate(DROP)
    (warning,) = [str(one.message) for one in seen]
    assert words in warning
    assert warning.startswith("drops run as plain Python, about a hundred times slower: ")
    for result in (plain[0], plain[2]):
        assert result.rebound_speeds.tobytes() == one.rebound_speeds.tobytes()
        assert result.intervals.tobytes() == one.intervals.tobytes()
    for name, array in many.data_vars.items():
        assert np.array_equal(plain[1][name], array, equal_nan=array.dtype.kind == "f"), name
    with pytest.raises(InvalidValue) as refused:
        simulate(DROP, compiled=True)
    assert words in str(refused.value)
    assert str(refused.value).startswith("compiled must be False or None here: ")
    assert "\n" not in warning + str(refused.value)


@pytest.mark.filterwarnings("default::stackbounce.engine.native.NoCompiledCode")
def test_the_command_line_warns_in_one_line(folder, capsys):
    truncated(folder, None)
    assert main(["simulate", "basketball", "tennis", "--height", "1m"]) == 0
    shown = capsys.readouterr()
    assert shown.err == f"stackbounce: {native_words(library(folder).name)}\n"
    assert "tennis" in shown.out


def native_words(name):
    return (
        f"drops run as plain Python, about a hundred times slower: {name} is damaged or foreign: "
        "install stackbounce again"
    )


def test_levels_below_the_processors_are_taken(folder, monkeypatch):
    manifest = json.loads((folder / "manifest.json").read_text())
    levels = manifest["libraries"][native.platform_name()]["levels"]
    bits = set()
    for level in levels:
        monkeypatch.setattr(native, "_processor_level", lambda _, n=level: int(n[1:]))
        forget()
        if int(level[1:]) <= 2:  # a processor of today has it
            assert native._library().level == level
            bits.add(simulate(DROP, compiled=True).rebound_speeds.tobytes())
    assert bits <= {good()[0].rebound_speeds.tobytes()}


def start(code, site, cwd):
    """Start Python where there is no home, with a copy of the package."""
    needed = {"PATH", "SYSTEMROOT", "LD_LIBRARY_PATH"}
    environment = {name: value for name, value in os.environ.items() if name in needed}
    return subprocess.Popen(
        [sys.executable, "-B", "-c", code],
        env=environment | {"PYTHONPATH": str(site), "TMPDIR": str(cwd)},
        cwd=cwd,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def files(folder):
    return {path: path.stat().st_mtime_ns for path in folder.rglob("*")}


@pytest.fixture
def site(tmp_path):
    """Return a folder with a read-only copy of the package."""
    site = tmp_path / "site"
    shutil.copytree(SOURCE, site / "stackbounce", ignore=shutil.ignore_patterns("__pycache__"))
    for path in [*site.rglob("*"), site]:
        path.chmod(0o555 if path.is_dir() else 0o444)
    yield site
    for path in [site, *site.rglob("*")]:
        path.chmod(0o755)


@pytest.mark.slow
def test_processes_at_once_without_a_home_write_nothing(site, tmp_path):
    empty = tmp_path / "empty"
    empty.mkdir()
    before = files(tmp_path)
    running = [start(SAYS_BITS, site, empty) for _ in range(2)]
    (one, says), (other, says_too) = [process.communicate(timeout=120) for process in running]
    assert (says, says_too) == ("", "")
    assert one == other
    assert len(one.split()) == 2
    assert files(tmp_path) == before
