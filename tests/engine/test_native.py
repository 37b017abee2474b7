"""A library that does not fit is never loaded: plain Python gives the same bits, with a warning."""

import functools
import hashlib
import json
import shutil

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


def change(folder, spoil):
    manifest = json.loads((folder / "manifest.json").read_text())
    spoil(manifest)
    (folder / "manifest.json").write_text(json.dumps(manifest))


def write_entry(entry):
    """Return what puts another entry of this machine's library into a manifest."""
    return lambda manifest: manifest.update(libraries={native.platform_name(): entry})


def truncated(folder):
    content = library(folder).read_bytes()
    library(folder).write_bytes(content[: len(content) // 2])


def unreadable(folder):
    library(folder).unlink()
    library(folder).mkdir()


def not_loadable(folder):
    library(folder).write_bytes(b"nothing to run")
    digest = {"sha256": hashlib.sha256(b"nothing to run").hexdigest()}
    change(folder, lambda manifest: manifest["libraries"][native.platform_name()].update(digest))


DAMAGED = "manifest.json is damaged: install stackbounce again"
MANIFESTS = {  # what a damaged manifest is, or how it comes from a good one
    "garbage": b"\xff{",
    "another": b'{"sources": 1, "libraries": [2]}',
    "deep": b"[" * 100_000,
    "no entry": lambda manifest: manifest["entries"].pop("run_batch"),
    "odd kind": lambda manifest: manifest["entries"]["run_drop"].append("text"),
    "other kinds": lambda manifest: manifest["entries"]["run_drop"].reverse(),
    "no digest": lambda manifest: manifest.pop("digest"),
    "empty entry": write_entry({}),
    "half an entry": write_entry({"file": "x.so"}),
    "odd levels": write_entry({"file": "x.so", "sha256": "", "levels": ["new"]}),
    "negative levels": write_entry({"file": "x.so", "sha256": "", "levels": ["v-1"]}),
}
FOLDERS = {  # how the folder of libraries is spoilt, and what is said of it
    "no manifest": (
        lambda folder: (folder / "manifest.json").unlink(),
        "was built without compiled code (install a wheel that has it, or run make ker",
    ),
    "no folder": (shutil.rmtree, "was built without compiled code"),
    "truncated": (truncated, "is damaged or foreign: install stackbounce again"),
    "foreign": (
        lambda folder: shutil.copyfile(folder / "engine.wasm", library(folder)),
        "is damaged or foreign: install stackbounce again",
    ),
    "no library": (
        lambda folder: library(folder).unlink(),
        "cannot be read (No such file or directory): install stackbounce again",
    ),
    "unreadable": (unreadable, "cannot be read (Is a directory): install stackbounce again"),
    "not loadable": (not_loadable, "cannot be loaded ("),
}
MACHINES = {  # what is another function of `native`, its answer, and what is said
    "changed": ("digest_of_sources", "0" * 64, "the engine's sources have changed: run make ker"),
    "unknown": ("platform_name", "sunos-sparc", "no compiled code for sunos-sparc: install one"),
    "old": ("_processor_level", 1, "this processor lacks instructions of x86-64-v2: use a newer"),
}


@pytest.mark.parametrize("name", MANIFESTS)
def test_a_damaged_manifest_is_not_trusted(name, folder):
    how = MANIFESTS[name]
    if callable(how):
        change(folder, how)
    else:
        (folder / "manifest.json").write_bytes(how)
    assert_plain(DAMAGED)


@pytest.mark.parametrize("name", FOLDERS)
def test_what_does_not_fit_is_not_loaded(name, folder):
    spoil, words = FOLDERS[name]
    spoil(folder)
    assert_plain(words)


@pytest.mark.parametrize("name", MACHINES)
def test_on_another_machine_nothing_is_loaded(name, folder, monkeypatch):
    function, answer, words = MACHINES[name]
    manifest = json.loads((folder / "manifest.json").read_text())
    if name == "old" and not manifest["libraries"][native.platform_name()]["levels"]:
        pytest.skip("the library of this platform has one level")
    monkeypatch.setattr(native, function, lambda *_: answer)
    assert_plain(words)


def assert_plain(words):
    """Assert that plain Python runs, with the same bits and a warning that has some words."""
    one, many = good()
    with pytest.warns(native.NoCompiledCode) as seen:
        plain = simulate(DROP), sb.sweep(DROP, MASSES), simulate(DROP)
    (warning,) = [str(found.message) for found in seen]
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
    truncated(folder)
    assert main(["simulate", "basketball", "tennis", "--height", "1m"]) == 0
    shown = capsys.readouterr()
    assert shown.err == (
        "stackbounce: drops run as plain Python, about a hundred times slower: "
        f"{library(folder).name} is damaged or foreign: install stackbounce again\n"
    )
    assert "tennis" in shown.out


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
