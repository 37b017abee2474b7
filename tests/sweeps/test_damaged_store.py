"""Stores that are damaged, and logs that are: mended or refused, never taken for whole."""

import json
import os
import shutil
from pathlib import Path

import pytest

import stackbounce as sb
from stackbounce.errors import FileError
from stackbounce.sweeps import grid, write
from stackbounce.sweeps.store import only_writer
from stopped_sweep import DROP, OVER, VALUES, content, write_some


def log_of(out):
    return out.with_name(f"{out.name}.progress")


def test_a_damaged_store_beside_one_that_is_not_complete(whole, out, tmp_path):
    write_some(out)
    shutil.copytree(whole, out)
    (out / "status" / "0.0").unlink()
    before = content(tmp_path)
    with pytest.raises(FileError, match=r"map\.zarr has lost blocks, and .*partial is a second"):
        write(out, DROP, VALUES, block=64)
    assert content(tmp_path) == before
    shutil.rmtree(out)
    assert write(out, DROP, VALUES, block=64) == out


def test_files_of_others_in_a_store_are_kept(out, tmp_path):
    write_some(out)
    own = tmp_path / "map.zarr.partial" / "status" / "notes.partial"
    own.write_text("mine")
    write(out, DROP, VALUES, block=64)
    assert (out / "status" / "notes.partial").read_text() == "mine"


def test_a_log_that_is_no_file_is_refused(out):
    os.mkfifo(log_of(out))
    with pytest.raises(FileError, match="is no ordinary file"):
        write(out, DROP, VALUES, block=64)


def harmed(text):
    """Return what replaces a file by a text."""
    return lambda path: path.write_text(text)


@pytest.mark.parametrize(
    ("name", "harm"),
    [
        (".zmetadata", Path.unlink),
        ("status/.zarray", Path.unlink),
        ("status/.zarray", harmed('{"zarr_format": 2}')),
        ("balls.0.mass/.zattrs", harmed('{"zarr_format": 2}')),
        ("status", shutil.rmtree),
    ],
)
def test_damaged_metadata_are_named(whole, out, name, harm):
    shutil.copytree(whole, out)
    harm(out / name)
    with pytest.raises(sb.StackbounceError, match="its metadata are damaged"):
        write(out, DROP, VALUES, block=64)
    assert json.loads((out / ".zgroup").read_bytes()) == {"zarr_format": 2}


def test_a_damaged_coordinate_is_named(whole, out):
    shutil.copytree(whole, out)
    (chunk,) = (out / "balls.0.mass").glob("[0-9]*")
    chunk.write_bytes(b"\xff" * chunk.stat().st_size)
    with pytest.raises(sb.StackbounceError, match=r"map.zarr exists, and (cannot be read|is not)"):
        write(out, DROP, VALUES, block=64)


def test_a_writer_is_named(out):
    words = rf"is being written by process {os.getpid()} on .* since \d{{4}}-.*: wait until"
    with only_writer(out), pytest.raises(sb.StackbounceError, match=words):
        write(out, DROP, VALUES, block=64)
    assert not list(out.parent.iterdir())


def test_another_sweep_leaves_no_log_behind(whole, out):
    shutil.copytree(whole, out)
    with pytest.raises(sb.StackbounceError, match="is not this sweep"):
        write(out, DROP, grid(DROP, OVER[:1]), block=64)
    assert list(out.parent.iterdir()) == [out]


@pytest.mark.parametrize("junk", [b"my own notes", b"3 2\n", b"# w\nready\n7\n", b"\0\xff\n", None])
def test_a_damaged_log_is_named_and_kept(out, junk):
    log_of(out).write_bytes(junk or b"")
    if junk is None:  # a file without an end
        os.truncate(log_of(out), 2**40)
    before = log_of(out).stat()
    with pytest.raises(FileError, match=r"map\.zarr\.progress is damaged"):
        write(out, DROP, VALUES, block=64)
    assert log_of(out).stat().st_mtime_ns == before.st_mtime_ns
    assert list(out.parent.iterdir()) == [log_of(out)]
