"""Sweeps larger than memory: stopped and resumed to the same bytes, on a cluster, lazily."""

import errno
import json
import os
import shutil
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import dask.array as da
import numpy as np
import pytest
import xarray as xr

import stackbounce as sb
from stackbounce.errors import FileError, InvalidValue
from stackbounce.sweeps import files, grid, opened, write
from stackbounce.sweeps.store import only_writer
from stopped_sweep import DROP, OVER, VALUES, content, write_some


def test_a_store_holds_what_sweep_returns(whole):
    with opened(whole) as data:
        stored, eager = data.load(), sb.sweep(DROP, VALUES)
    assert set(stored) == set(eager)
    assert all(stored[name].dims == eager[name].dims for name in eager)
    assert all(stored[name].dtype == eager[name].dtype for name in eager)
    assert all(np.array_equal(stored[name], eager[name]) for name in eager)
    assert all(np.array_equal(stored[name], eager[name]) for name in eager.coords)
    assert stored.attrs == eager.attrs
    for name in [*eager, *eager.coords]:
        assert stored[name].attrs.keys() == eager[name].attrs.keys()
        assert all(np.all(eager[name].attrs[k] == v) for k, v in stored[name].attrs.items())
    assert not [path for path in whole.parent.iterdir() if path != whole]


def test_a_complete_file_is_read_where_nothing_can_be_written(whole, monkeypatch):
    def refuse(*_, **__):
        raise PermissionError

    monkeypatch.setattr(os, "open", refuse)
    assert write(whole, DROP, VALUES, block=64) == whole


PAIRED = {
    "gaps.0": ("draw", np.linspace(0.0, 1e-3, 60)),
    "balls.0.mass": ("draw", np.geomspace(2.0, 1.0, 60)),
    "impact_speed": [0.5, 1.0],
}


def test_numbers_that_vary_together_are_resumed_to_the_same_bytes(tmp_path):
    one, other = tmp_path / "one.zarr", tmp_path / "other.zarr"
    write(one, DROP, PAIRED, block=50)
    for _ in range(2):
        write_some(other, PAIRED, block=50)
    write(other, DROP, PAIRED, block=7)
    assert content(one) == content(other)
    with opened(other) as data:
        assert data.load().identical(sb.sweep(DROP, PAIRED))
    again = {**PAIRED, "gaps.0": ("draw", np.linspace(0.0, 2e-3, 60))}
    with pytest.raises(FileError, match="is not this sweep"):
        write(other, DROP, again)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"gaps.0": ("x", [0.0]), "impact_speed": ("x", [1.0, 2.0])}, "as many values along x"),
        ({"gaps.0": ("a/b", [0.0])}, "must have one dimension in a file, with a name of letters"),
        ({"gaps.0": 0.0}, "gaps.0 must have one dimension in a file"),
        ({"gaps.0": ("draw", [0.0, -1.0]), "impact_speed": ("draw", [1.0, 2.0])}, r"\(at draw 1\)"),
        ({"gaps.0": ("status", [0.0])}, "dimension or coordinate named status, as"),
        ({"balls.0.mass": np.array([0.0, 1.0])}, r"balls.0.mass must be .* \(at balls_0_mass 0\)"),
    ],
)
def test_values_that_cannot_be_in_a_file(tmp_path, values, message):
    with pytest.raises(InvalidValue, match=message):
        write(tmp_path / "a.zarr", DROP, values)
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_two_workers_and_the_loss_of_one(whole, out):
    distributed = pytest.importorskip("distributed", reason="the extra 'cluster' is not installed")
    options = {"n_workers": 2, "threads_per_worker": 1, "processes": True}
    options["dashboard_address"] = "127.0.0.1:0"  # any free port: None would ask for 8787
    killed = []
    with distributed.LocalCluster(**options) as cluster, distributed.Client(cluster) as client:

        def progress(done, total):
            if 0 < done < total and not killed:
                killed.append(next(iter(client.run(os.getpid).values())))
                os.kill(killed[0], signal.SIGKILL)

        write(out, DROP, VALUES, client=client, block=64, progress=progress)
    assert killed
    assert content(out) == content(whole)


def test_chunks_of_dask_make_it_lazy():
    chunked = {path: da.from_array(axis, chunks=7) for path, axis in VALUES.items()}
    ds = sb.sweep(DROP, {path: xr.DataArray(axis, dims=path) for path, axis in chunked.items()})
    assert ds.rebound_ratio.chunks[:2] == ((7, 7, 7, 7, 2), (7, 7, 6))
    eager = sb.sweep(DROP, VALUES)
    assert all(np.array_equal(ds[name], eager[name]) for name in eager)
    bad = sb.sweep(DROP, {"gaps.0": da.from_array(np.array([0.0, -1.0]), chunks=1)})
    with pytest.raises(sb.StackbounceError, match=r"gaps.0 must be .* \(at gaps.0 = -1\)"):
        bad.compute()


def test_a_complete_store_is_left_alone_and_another_is_refused(whole):
    calls, before = [], content(whole)
    write(whole, DROP, VALUES, block=64, progress=lambda *done: calls.append(done))
    assert calls == [(600, 600)]
    for values, options in ((grid(DROP, OVER[:1]), {}), (VALUES, {"rtol": 1e-6})):
        with pytest.raises(sb.StackbounceError, match="exists, and is not this sweep"):
            write(whole, DROP, values, **options)
    assert content(whole) == before
    assert list(whole.parent.iterdir()) == [whole]


def test_part_of_another_sweep_is_not_lost(out, tmp_path):
    write_some(out)
    kept = content(tmp_path)
    with pytest.raises(sb.StackbounceError, match="is part of another sweep"):
        write(out, DROP, grid(DROP, OVER[1:]), block=64)
    assert content(tmp_path) == kept


def test_what_a_kill_leaves_half_written_is_removed(whole, out, tmp_path):
    blocks = []
    for _ in range(3):
        blocks += write_some(out)
        chunk = tmp_path / "map.zarr.partial" / "status" / f"1.{0:032x}.partial"
        chunk.write_bytes(b"half a chunk")
        with (tmp_path / f"{out.name}.progress").open("a") as lines:
            lines.write("# pro")  # of a writer that was killed
    assert blocks == [0, 60, 60, 120, 120, 180]
    assert content(write(out, DROP, VALUES, block=64)) == content(whole)


def test_killed_before_the_file_was_all_there_it_begins_anew(whole, out, tmp_path):
    begun = out.with_name(f"{out.name}.begun")
    begun.mkdir()
    (begun / ".zattrs").write_text("{")
    out.with_name(f"{out.name}.progress").write_text("# process 1 on here since yesterday\n")
    assert content(write(out, DROP, VALUES, block=64)) == content(whole)
    assert list(tmp_path.iterdir()) == [out]


def test_what_this_program_did_not_make_is_left_alone(out, tmp_path):
    partial = out.with_name(f"{out.name}.partial")
    partial.mkdir()
    (partial / ".zattrs").write_text("{")
    with pytest.raises(sb.StackbounceError, match=r"partial exists, and cannot be read"):
        write(out, DROP, VALUES, block=64)
    assert sorted(tmp_path.rglob("*")) == [partial, partial / ".zattrs"]
    begun = partial.rename(out.with_name(f"{out.name}.begun"))
    with pytest.raises(sb.StackbounceError, match=r"begun exists, and is not of a sweep"):
        write(out, DROP, VALUES, block=64)
    assert sorted(tmp_path.rglob("*")) == [begun, begun / ".zattrs"]


def damaged(chunk):
    chunk.write_bytes(chunk.read_bytes()[:7])


@pytest.mark.parametrize("harm", [Path.unlink, damaged])
def test_a_block_that_is_lost_is_computed_again(whole, out, harm):
    shutil.copytree(whole, out)
    blocks = []
    harm(out / "rebound_ratio" / "2.0.0")
    harm(out / "status" / "4.0")
    with pytest.warns(UserWarning, match=r"map.zarr: 2 of 10 blocks are missing or damaged"):
        write(out, DROP, VALUES, block=64, progress=lambda *now: blocks.append(now[0]))
    assert blocks == [480, 540, 600]
    assert content(out) == content(whole)
    assert list(out.parent.iterdir()) == [out]


def test_chunks_of_one_value_are_there(out):
    """No ball touches the other: all of a chunk is nan, zarr's value of what is not written."""
    drop = sb.Drop([sb.Ball(0.1), sb.Ball(1.0)], [sb.Spring(1e3)] * 2, velocities=[-1.0, 0.0])
    calls = []
    for _ in range(2):
        calls.clear()
        values = {"gaps.0": [0.5, 1.0]}
        write(out, drop, values, until=0.01, progress=lambda *now: calls.append(now))
    assert calls == [(2, 2)]


def test_a_tall_stack_and_no_number_that_varies(tmp_path):
    tall = sb.Drop([sb.Ball(0.01)] * 1500, [sb.Rigid(0.5)] * 1500, impact_speed=1.0)
    for number, values in enumerate([{}, {"impact_speed": np.array([1.0, 2.0])}]):
        out = write(tmp_path / f"{number}.zarr", tall, values, event_limit=100)
        with opened(out) as data:
            assert data.attrs["drop"] == tall.to_toml()
            assert np.isfinite(data.rebound_ratio.values).all()


@pytest.mark.slow
def test_a_cluster_that_is_lost_says_so_and_nothing_is_lost(out, tmp_path):
    distributed = pytest.importorskip("distributed", reason="the extra 'cluster' is not installed")
    command = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--no-dashboard"]
    command += ["--dashboard-address", "127.0.0.1:0"]
    command += ["--host", "127.0.0.1", "--port", "0", "--scheduler-file", str(tmp_path / "at")]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    with subprocess.Popen(command, **quiet) as scheduler:
        worker = [sys.executable, "-m", "distributed.cli.dask_worker", "--no-dashboard"]
        worker += ["--scheduler-file", str(tmp_path / "at"), "--nthreads", "1", "--no-nanny"]
        with subprocess.Popen([*worker, "--local-directory", str(tmp_path)], **quiet) as second:
            try:
                kill = {"progress": lambda done, _: scheduler.kill() if done else None}
                client = distributed.Client(scheduler_file=str(tmp_path / "at"), timeout="10s")
                client.wait_for_workers(1, timeout=30)
                with pytest.raises(sb.StackbounceError, match="cluster failed; the blocks done"):
                    write(out, DROP, VALUES, client=client, block=32, **kill)
                client.close(timeout=1)
            finally:
                scheduler.kill()
                second.kill()
    begun = []
    write(out, DROP, VALUES, progress=lambda done, _: begun.append(done))
    assert begun[0] > 0


def test_a_sweep_that_cannot_begin_leaves_nothing(tmp_path, monkeypatch):
    def create(path, _):
        path.mkdir()
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(files, "create", create)
    with pytest.raises(sb.StackbounceError, match="No space left on device"):
        write(tmp_path / "map.zarr", DROP, VALUES)
    assert list(tmp_path.iterdir()) == []


# --- stores that are damaged, and logs that are: mended or refused, never taken for whole
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
    (tmp_path / "map.zarr.partial" / "status" / "notes.partial").write_text("mine")
    write(out, DROP, VALUES, block=64)
    assert (out / "status" / "notes.partial").read_text() == "mine"


def harmed(text):
    """Return what replaces a file by a text."""
    return lambda path: path.write_text(text)


@pytest.mark.parametrize(
    ("name", "harm"),
    [
        (".zmetadata", Path.unlink),
        ("status/.zarray", Path.unlink),
        ("status/.zarray", harmed('{"zarr_format": 2}')),
        ("balls_0_mass/.zattrs", harmed('{"zarr_format": 2}')),
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
    (chunk,) = (out / "balls_0_mass").glob("[0-9]*")
    chunk.write_bytes(b"\xff" * chunk.stat().st_size)
    with pytest.raises(sb.StackbounceError, match=r"map.zarr exists, and (cannot be read|is not)"):
        write(out, DROP, VALUES, block=64)


def test_a_writer_is_named(out):
    words = rf"is being written by process {os.getpid()} on .* since \d{{4}}-.*: wait until"
    with only_writer(out), pytest.raises(sb.StackbounceError, match=words):
        write(out, DROP, VALUES, block=64)
    assert not list(out.parent.iterdir())


def test_a_writer_that_has_not_said_yet_who_it_is_is_waited_for(out):
    with only_writer(out), ThreadPoolExecutor(1) as pool:
        said = log_of(out).read_bytes()
        os.truncate(log_of(out), 0)
        other = pool.submit(write, out, DROP, VALUES, block=64)
        time.sleep(0.1)
        log_of(out).write_bytes(said)
        with pytest.raises(FileError, match=rf"is being written by process {os.getpid()} on "):
            other.result()
        os.truncate(log_of(out), 0)
        with pytest.raises(FileError, match="is being written by another process: wait until"):
            write(out, DROP, VALUES, block=64)


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
