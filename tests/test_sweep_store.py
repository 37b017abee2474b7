"""Sweeps larger than memory: killed and resumed to the same bytes, on a cluster, lazily."""

import hashlib
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import dask.array as da
import numpy as np
import pytest
import xarray as xr

import stackbounce as sb
from stackbounce.sweep import grid, write

DROP = sb.Drop(
    [sb.Ball(0.15), sb.Ball(0.057)], [sb.Spring(2500.0), sb.Spring(1000.0)], impact_speed=3.53
)
OVER = ["balls.0.mass=50g:500g:30:log", "gaps.0=0mm:4mm:20"]


def digest(store):
    """Return a hash of every file's name and bytes."""
    found = hashlib.sha256()
    for path in sorted(store.rglob("*")):
        if path.is_file():
            found.update(f"{path.relative_to(store)}\n".encode() + path.read_bytes())
    return found.hexdigest()


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    path = write(tmp_path_factory.mktemp("whole") / "map.zarr", DROP, grid(DROP, OVER), block=64)
    return path, digest(path)


def test_a_store_holds_what_sweep_returns(whole):
    stored, eager = xr.open_zarr(whole[0]).load(), sb.sweep(DROP, grid(DROP, OVER))
    assert set(stored) == set(eager)
    assert all(np.array_equal(stored[name], eager[name]) for name in eager)
    assert stored.attrs == eager.attrs
    assert stored.status.attrs["flag_meanings"] == eager.status.attrs["flag_meanings"]
    assert not [path for path in whole[0].parent.iterdir() if path != whole[0]]


SCRIPT = """
import sys, time
import stackbounce as sb
from stackbounce.sweep import grid, write
sys.path.insert(0, {tests!r})
from test_sweep_store import DROP, OVER
def progress(done, total):
    print(done, flush=True)
    time.sleep(0.05)
write({out!r}, DROP, grid(DROP, OVER), block=64, progress=progress)
"""


def test_killed_at_any_moment_it_goes_on_and_ends_with_the_same_bytes(whole, tmp_path):
    out = tmp_path / "map.zarr"
    script = SCRIPT.format(tests=str(Path(__file__).parent), out=str(out))
    command = [sys.executable, "-c", script]
    first = []
    for patience in (1, 3, 4):  # blocks until the kill
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
            lines = [int(process.stdout.readline()) for _ in range(patience)]
            time.sleep(0.02 * patience)  # somewhere within the next block
            process.send_signal(signal.SIGKILL)
        first.append(lines[0])
        assert not out.exists()
    assert first == sorted(first)
    assert first[-1] > 0
    last = subprocess.run(command, capture_output=True, text=True, check=True, timeout=120)
    assert int(last.stdout.split()[0]) >= first[-1]
    assert digest(out) == whole[1]
    assert list(tmp_path.iterdir()) == [out]


def test_two_workers_and_the_loss_of_one(whole, tmp_path):
    distributed = pytest.importorskip("distributed", reason="the extra 'cluster' is not installed")
    options = {
        "n_workers": 2,
        "threads_per_worker": 1,
        "processes": True,
        "dashboard_address": None,
    }
    killed = []
    with distributed.LocalCluster(**options) as cluster, distributed.Client(cluster) as client:

        def progress(done, total):
            if 0 < done < total and not killed:
                killed.append(next(iter(client.run(os.getpid).values())))
                os.kill(killed[0], signal.SIGKILL)

        out = write(
            tmp_path / "map.zarr",
            DROP,
            grid(DROP, OVER),
            client=client,
            block=64,
            progress=progress,
        )
    assert killed
    assert digest(out) == whole[1]


def test_chunks_of_dask_make_it_lazy():
    values = grid(DROP, OVER)
    lazy = {
        path: xr.DataArray(da.from_array(axis, chunks=7), dims=path)
        for path, axis in values.items()
    }
    ds = sb.sweep(DROP, lazy)
    assert ds.rebound_ratio.chunks[:2] == ((7, 7, 7, 7, 2), (7, 7, 6))
    eager = sb.sweep(DROP, values)
    assert all(np.array_equal(ds[name], eager[name]) for name in eager)
    bad = sb.sweep(DROP, {"gaps.0": da.from_array(np.array([0.0, -1.0]), chunks=1)})
    with pytest.raises(sb.StackbounceError, match=r"gaps.0 must be .* \(at gaps.0 = -1\)"):
        bad.compute()


def test_a_complete_store_is_left_alone_and_another_is_refused(whole):
    calls = []
    again = write(
        whole[0], DROP, grid(DROP, OVER), block=64, progress=lambda *done: calls.append(done)
    )
    assert again == whole[0]
    assert calls == [(600, 600)]
    with pytest.raises(sb.StackbounceError, match="exists, and is not this sweep"):
        write(whole[0], DROP, grid(DROP, OVER[:1]))
    with pytest.raises(sb.StackbounceError, match="exists, and is not this sweep"):
        write(whole[0], DROP, grid(DROP, OVER), block=64, rtol=1e-6)
    assert digest(whole[0]) == whole[1]


def test_part_of_another_sweep_is_not_lost(tmp_path):
    class Stopped(Exception):
        pass

    def progress(done, _):
        if done:
            raise Stopped

    with pytest.raises(Stopped):
        write(tmp_path / "map.zarr", DROP, grid(DROP, OVER), block=64, progress=progress)
    kept = digest(tmp_path)
    with pytest.raises(sb.StackbounceError, match="is part of another sweep"):
        write(tmp_path / "map.zarr", DROP, grid(DROP, OVER[1:]), block=64)
    assert digest(tmp_path) == kept


def test_what_a_kill_leaves_of_a_chunk_is_removed(whole, tmp_path):
    class Stopped(Exception):
        pass

    def progress(done, _):
        if done:
            raise Stopped

    with pytest.raises(Stopped):
        write(tmp_path / "map.zarr", DROP, grid(DROP, OVER), block=64, progress=progress)
    store = tmp_path / "map.zarr.partial"
    (store / "status" / "1.0.0123456789abcdef.partial").write_bytes(b"half a chunk")
    with (tmp_path / "map.zarr.progress").open("a") as lines:
        lines.write("1")  # a line that was being written
    out = write(tmp_path / "map.zarr", DROP, grid(DROP, OVER), block=64)
    assert digest(out) == whole[1]


def test_a_wrong_value_is_told_before_anything_is_written(tmp_path):
    with pytest.raises(sb.StackbounceError, match=r"balls.0.mass must be .* \(at balls.0.mass 0\)"):
        write(tmp_path / "map.zarr", DROP, {"balls.0.mass": np.array([0.0, 1.0])})
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("balls.0.mass=1:3:3", [1.0, 2.0, 3.0]),
        ("balls.0.mass=1g,20g", [0.001, 0.02]),
        ("contacts.0.stiffness=1kN/m:100kN/m:3:log", [1e3, 1e4, 1e5]),
        ("gaps.0=0mm:4mm:3:lin", [0.0, 0.002, 0.004]),
    ],
)
def test_over_is_read(text, values):
    ((_, found),) = grid(DROP, [text]).items()
    assert found == pytest.approx(values, rel=1e-15)


@pytest.mark.parametrize(
    ("texts", "message"),
    [
        (["balls.0.mass"], "--over must be PATH="),
        (["balls.0.mass=1:2"], "--over must be PATH="),
        (["balls.0.mass=1:2:x"], "--over must be PATH="),
        (["balls.0.mass=1:2:3:cubic"], "--over must be PATH="),
        (["balls.0.mass=1:2:0"], "must have from 1 to"),
        (["gaps.0=0:1:3:log"], "numbers of one sign for :log"),
        (["balls.0.mass=1m:2m:3"], "balls.0.mass must be a mass"),
        (["balls.9.mass=1:2:3"], "is no number of this drop"),
        (["gaps.0=0:1:3", "gaps.0=1"], "gaps.0 twice"),
    ],
)
def test_over_that_cannot_be_read(texts, message):
    with pytest.raises(sb.StackbounceError, match=message):
        grid(DROP, texts)
