"""How a sweep grows with the number of drops: time, memory, threads, and workers of a cluster.

Each sweep runs in a process of its own, whose largest memory Linux tells in ``/proc/self/status``;
elsewhere it is unknown. Up to a million drops stay in memory; more go to a file, block by block, so
that memory does not grow any more.
"""

import json
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from tempfile import TemporaryDirectory

LAWS = {"rigid": "sb.Rigid(0.9)", "springs": "sb.Spring(1e4)", "Hertz": "sb.Hertz(1e6)"}
SIZES = tuple(10**n for n in range(3, 8))
LARGEST = 10**8  # of Hertz contacts only: it takes minutes
IN_MEMORY, SHARED = 10**6, 10**6  # the most drops in memory; those of workers
THREADED = 10**7  # those of threads: with fewer, what is around the engine counts
RTOL = 1e-4  # that of a picture
FILE, WORKERS = "file", "file, two workers"
_CODE = """
import json, os, pathlib, time
import numpy as np, xarray
import stackbounce as sb
law, count, how, threads, folder = {law}, {count}, {how!r}, {threads}, {folder!r}
if threads:
    os.cpu_count = lambda: threads
drop = sb.Drop([sb.Ball(0.2), sb.Ball(0.05)], [law] * 2, [1e-3], impact_speed=2.0)
columns = max(1, int(count**0.5))
values = {{
    "balls.1.mass": np.geomspace(0.02, 0.2, columns),
    "gaps.0": np.linspace(0.0, 3e-3, count // columns),
}}
def run(name, client=None):
    if how == "memory":
        sb.sweep(drop, values, rtol={rtol})
    else:
        sb.sweeps.write(f"{{folder}}/{{name}}.zarr", drop, values, rtol={rtol}, client=client)
sb.sweep(drop, {{"gaps.0": [0.0, 1e-3]}}, rtol={rtol})
client = None
if how == "{workers}":
    from distributed import Client, LocalCluster
    client = Client(LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None))
    few = {{"gaps.0": [0.0]}}
    client.gather([client.submit(sb.sweep, drop, few, pure=False) for _ in range(8)])
spent = []
for number in range(3 if how == "memory" or count <= 10**6 else 1):
    begin = time.perf_counter()
    run(f"sweep{{number}}", client)
    spent.append(time.perf_counter() - begin)
status = pathlib.Path("/proc/self/status")  # `getrusage` counts the parent's memory, too
most = status.read_text().split("VmHWM:")[1].split()[0] if status.exists() else "nan"
print(json.dumps([min(spent), float(most) / 1024]))
"""


@dataclass(frozen=True)
class Sweep:
    """What one sweep took: drops, how it ran, time by the clock in s, largest memory in MiB.

    In memory, and up to a million drops, the time is the shortest of three.
    """

    law: str
    drops: int
    how: str
    threads: int  # 0: as many as there are cores
    seconds: float
    memory: float


def measure(
    progress: Callable[[str], None],
    sizes: Sequence[int] = SIZES,
    shared: int = SHARED,
    threaded: int = THREADED,
    *,
    largest: bool = True,
) -> list[Sweep]:
    """Return what sweeps took: by size, on one thread and all, and on a cluster's two workers."""
    ways = [(law, n, "memory" if n <= IN_MEMORY else FILE, 0) for law in LAWS for n in sizes]
    ways += [(law, threaded, "memory", threads) for law in LAWS for threads in (1, 2)]
    ways += [("Hertz", shared, how, 0) for how in (FILE, WORKERS)]
    ways += [("Hertz", LARGEST, FILE, 0)] if largest else []
    found = []
    for law, count, how, threads in ways:
        progress(f"{law}, {count:,} drops, {how}")
        found.append(_run(law, count, how, threads))
    return found


def _run(law: str, count: int, how: str, threads: int) -> Sweep:
    with TemporaryDirectory() as folder:
        code = _CODE.format(
            law=LAWS[law],
            count=count,
            how=how,
            threads=threads,
            folder=folder,
            rtol=RTOL,
            workers=WORKERS,
        )
        done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True)
    columns = max(1, int(count**0.5))
    return Sweep(law, columns * (count // columns), how, threads, *json.loads(done.stdout))
