"""Stores that are damaged, and logs that are: mended or refused, never taken for whole."""

import json
import os
import shutil
import threading

import pytest

import stackbounce as sb
from slow_sweep import DROP, OVER
from stackbounce.errors import FileError
from stackbounce.sweeps import grid, write
from stackbounce.sweeps.progress import only_writer

VALUES = grid(DROP, OVER)


class Stopped(Exception):
    pass


def content(store):
    paths = sorted(store.rglob("*")) if store.is_dir() else [store]
    return {str(one.relative_to(store)): one.read_bytes() for one in paths if one.is_file()}


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    return write(tmp_path_factory.mktemp("whole") / "map.zarr", DROP, VALUES, block=64)


@pytest.fixture
def out(whole, tmp_path):
    return tmp_path / whole.name


def begin(out):
    """Write the first block, and stop."""

    def stop(done, _):
        if done:
            raise Stopped

    with pytest.raises(Stopped):
        write(out, DROP, VALUES, block=64, progress=stop)


def log_of(out):
    return out.with_name(f"{out.name}.progress")


def test_blocks_that_only_the_log_has_are_computed(whole, out):
    begin(out)
    with log_of(out).open("a") as log:
        log.write("".join(f"{number}\n" for number in range(10)))
    assert content(write(out, DROP, VALUES, block=64)) == content(whole)


def test_a_damaged_store_beside_one_that_is_not_complete(tmp_path):
    out, kept = tmp_path / "map.zarr", tmp_path / "kept"
    shutil.move(write(out, DROP, VALUES, block=64), kept)
    begin(out)
    shutil.move(kept, out)
    (out / "status" / "0.0").unlink()
    before = content(tmp_path)
    with pytest.raises(
        FileError, match=r"map\.zarr has lost blocks, and .*partial is a second one"
    ):
        write(out, DROP, VALUES, block=64)
    assert content(tmp_path) == before
    shutil.rmtree(out)
    assert write(out, DROP, VALUES, block=64) == out


def test_blocks_of_another_shape_than_the_stores(tmp_path):
    out = tmp_path / "map.zarr"
    begin(out)
    log_of(out).write_text("# process 1 on x since then\n30 20\n0\n")
    expected = content(write(tmp_path / "other.zarr", DROP, VALUES, block=64))
    assert content(write(out, DROP, VALUES, block=64)) == expected


@pytest.mark.parametrize("sides", ["0 0", "7 7 7", "-3 2"])
def test_sides_that_cannot_be_are_those_of_the_store(whole, out, sides):
    begin(out)
    log_of(out).write_text(f"# process 1 on x since then\n{sides}\n1\n")
    assert content(write(out, DROP, VALUES, block=64)) == content(whole)


def test_files_of_others_in_a_store_are_kept(tmp_path):
    out = tmp_path / "map.zarr"
    begin(out)
    own = tmp_path / "map.zarr.partial" / "status" / "notes.partial"
    own.write_text("mine")
    write(out, DROP, VALUES, block=64)
    assert (out / "status" / "notes.partial").read_text() == "mine"


@pytest.mark.parametrize("name", [".zmetadata", "status/.zarray", "balls.0.mass/.zattrs"])
@pytest.mark.parametrize("text", [None, "{", '{"zarr_format": 2}'])
def test_damaged_metadata_are_named(tmp_path, name, text):
    out = write(tmp_path / "map.zarr", DROP, VALUES, block=64)
    (out / name).unlink()
    if text is not None:
        (out / name).write_text(text)
    with pytest.raises(sb.StackbounceError, match="its metadata are damaged"):
        write(out, DROP, VALUES, block=64)
    assert json.loads((out / ".zgroup").read_bytes()) == {"zarr_format": 2}


def test_a_store_without_an_array_is_refused(tmp_path):
    out = write(tmp_path / "map.zarr", DROP, VALUES, block=64)
    shutil.rmtree(out / "status")
    with pytest.raises(sb.StackbounceError, match="its metadata are damaged"):
        write(out, DROP, VALUES, block=64)


def test_a_damaged_coordinate_is_named(tmp_path):
    out = write(tmp_path / "map.zarr", DROP, VALUES, block=64)
    (chunk,) = (out / "balls.0.mass").glob("[0-9]*")
    chunk.write_bytes(b"\xff" * chunk.stat().st_size)
    with pytest.raises(sb.StackbounceError, match=r"map.zarr exists, and (cannot be read|is not)"):
        write(out, DROP, VALUES, block=64)


def test_a_writer_that_has_just_begun_is_named(out):
    with only_writer(out) as log:
        threading.Timer(0.1, log.sign).start()
        with pytest.raises(sb.StackbounceError, match="is being written by process"):
            write(out, DROP, VALUES, block=64)


def test_killed_when_all_was_done_it_leaves_nothing(whole, out):
    (shutil.copytree if whole.is_dir() else shutil.copy)(whole, out)
    log_of(out).write_text("# process 1 on x since then\n3 2\n0\n")
    write(out, DROP, VALUES, block=64)
    assert list(out.parent.iterdir()) == [out]


def test_another_sweep_leaves_no_log_behind(whole, out):
    (shutil.copytree if whole.is_dir() else shutil.copy)(whole, out)
    with pytest.raises(sb.StackbounceError, match="is not this sweep"):
        write(out, DROP, grid(DROP, OVER[:1]), block=64)
    assert list(out.parent.iterdir()) == [out]


def test_a_log_that_is_no_file_is_refused(tmp_path):
    out = tmp_path / "map.zarr"
    os.mkfifo(tmp_path / "map.zarr.progress")
    with pytest.raises(FileError, match="is no ordinary file"):
        write(out, DROP, VALUES, block=64)


def test_a_log_without_an_end_is_refused(tmp_path):
    with (tmp_path / "map.zarr.progress").open("wb") as log:
        log.truncate(2**40)
    with pytest.raises(FileError, match="damaged"):
        write(tmp_path / "map.zarr", DROP, VALUES, block=64)
