"""`stackbounce app`: where it listens, what it says, how it ends."""

import asyncio
import base64
import contextlib
import dataclasses
import gc
import hashlib
import json
import math
import os
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import httpx
import psutil
import pytest

from adversary.server import LONG_RUN, PATIENCE, Server, running, serving
from explorer.conftest import ASKED
from stackbounce.cli import main
from stackbounce.errors import FileError, InvalidValue, finite
from stackbounce.explorer import LIMITS, paper_pages
from stackbounce.explorer.serve import PORT
from stackbounce.explorer.workers import Busy, TooMuch, Workers

APP = [sys.executable, "-m", "stackbounce", "app", "--no-browser", "--workers", "1"]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--port", "70000"], "port must be a whole number from 0 to 65535, got 70000"),
        (["--port", "x"], "valid integer"),
        (["--host", "no.such.host.invalid"], "--host must be an address of this machine"),
        (["--host", ""], "--host must be an address of this machine, such as 127.0.0.1, or"),
        (["--host", "203.0.113.7"], "--host must be an address of this machine"),  # RFC 5737
        (["--workers", "0"], "--workers must be a whole number from 1 to 64, got 0"),
    ],
)
def test_what_is_wrong_is_told(capsys, options, message):
    assert main(["app", "--no-browser", *options]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert message in err
    assert err.count("\n") == 1


def test_a_port_that_is_taken(capsys):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        assert main(["app", "--no-browser", "--port", str(port)]) == 2
    assert f"127.0.0.1, port {port} cannot be used" in capsys.readouterr().err


@pytest.mark.slow
@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM])
def test_it_serves_until_it_is_interrupted_and_leaves_nothing(how):
    with running([*APP, "--json", "--port", "0"], stderr=subprocess.PIPE) as process:
        told = json.loads("".join(process.stdout.readline() for _ in range(6)))
        address = told["address"]
        assert (told["others"], told["measures"]) == ([], True)
        httpx.post(f"{address}api/predict", json=ASKED, timeout=PATIENCE).raise_for_status()
        workers = Server(address, process).children()
        assert workers
        os.kill(process.pid, how)
        assert process.communicate(timeout=30) == ("", "")
    assert process.returncode == 0
    assert not left_of(workers)


def left_of(processes):
    """Return those of the processes that do not end by themselves."""
    return psutil.wait_procs(processes, timeout=10.0)[1]


@pytest.mark.slow
@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGKILL])
def test_open_requests_do_not_keep_it_from_ending(how):
    large = json.dumps(LONG_RUN).encode()
    head = b"POST /api/predict HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\n"
    begun = [
        b"",
        b"GET / HTT",
        head + b"Content-Length: %d\r\n\r\n" % len(large),
        head + b"Content-Length: %d\r\n\r\n" % len(large) + large,
        b"GET /paper/ HTTP/1.1\r\nHost: localhost\r\n\r\n",
    ]
    with serving(stderr=subprocess.PIPE) as server, contextlib.ExitStack() as stack:
        httpx.post(f"{server.address}api/predict", json=ASKED, timeout=PATIENCE)
        for request in begun * 3:
            stack.enter_context(socket.create_connection(server.place)).sendall(request)
        time.sleep(1.0)
        workers = server.children()
        assert workers
        os.kill(server.process.pid, how)
        _, err = server.process.communicate(timeout=15)
        assert not left_of(workers)
    if how == signal.SIGTERM:
        assert (server.process.returncode, err) == (0, "")


@pytest.mark.slow
def test_without_a_port_the_first_free_one_is_taken():
    with socket.socket() as first:
        first.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        with contextlib.suppress(OSError):  # somebody else has it, which does as well
            first.bind(("127.0.0.1", PORT))
            first.listen()
        with running(APP) as process:
            line = process.stdout.readline()
    port = int(line.split()[2].rstrip("/").rpartition(":")[2])
    assert PORT < port < PORT + 20
    assert line.endswith("(Ctrl+C ends it)\n")


def test_a_class_is_told_addresses_that_it_can_type():
    command = [*APP, "--host", "0.0.0.0", "--port", "0"]
    with running(command) as process:
        first, others = (process.stdout.readline() for _ in range(2))
        port = first.split()[2].rstrip("/").rpartition(":")[2]
        if "in no network" in others:
            pytest.skip("this machine is in no network")
        addresses = others.partition(": ")[2].partition(" (")[0].split(" or ")
        assert all(one.strip().endswith(f":{port}/") for one in addresses)
        assert not any("127.0.0.1" in one or "localhost" in one for one in addresses)
        places = httpx.get(f"{addresses[0].strip()}api/places", timeout=PATIENCE).json()["places"]
    assert [one["address"] for one in places] == [one.strip() for one in addresses]
    assert len(places[0]["code"]) == len(places[0]["code"][0])


class Stub(Workers):
    """Workers that write a page at once, or fail."""

    error = None

    async def run(self, job, folder, seconds):
        assert (job, seconds) == (paper_pages._write, LIMITS.paper_seconds)
        if self.error:
            raise self.error
        Path(folder, "index.html").write_text("<h1>The paper</h1><script>let a = 1;</script>")


def pages(stub, folder, names):
    made = paper_pages.Papers(stub, folder, LIMITS.paper_seconds)
    scope = {"type": "http", "method": "GET", "headers": []}

    async def ask():
        answers = []
        for name in names:
            answers += await asyncio.gather(made.page(name, scope), return_exceptions=True)
            await asyncio.sleep(0.01)
        return answers

    return asyncio.run(ask())


def test_pages_of_the_paper(tmp_path):
    (tmp_path / "secret").write_text("secret")
    folder = tmp_path / "pages"
    folder.mkdir()
    others = ["none.html", "../secret", "../pages/../secret", "figures", "\0", "a" * 5000, "."]
    names = ["", "", "index.html", "/etc/passwd", *others]
    waiting, lead, page, *others = pages(Stub(LIMITS), folder, names)
    assert b"is being recomputed" in Path(waiting.path).read_bytes()
    assert waiting.headers["refresh"] == "2"
    assert lead.headers["location"] == "/paper/index.html"
    assert b"The paper" in Path(page.path).read_bytes()
    digest = base64.b64encode(hashlib.sha256(b"let a = 1;").digest()).decode()
    policy = page.headers["content-security-policy"]
    assert policy.endswith(f"; script-src 'sha256-{digest}'")  # its own script, and no other
    assert "frame-ancestors 'none'" in policy
    assert [other.status_code for other in others] == [404] * 8


def test_a_paper_that_failed_says_so_and_is_tried_again(tmp_path, caplog):
    stub = Stub(LIMITS)
    stub.error = FileError("no room left")
    first, second, third = pages(stub, tmp_path, [""] * 3)
    assert str(second) == "no room left"
    assert first.headers["refresh"] == third.headers["refresh"] == "2"
    gc.collect()
    assert not caplog.records  # that nobody asked for the third answer


# --- jobs have limits of time and memory, and no client keeps the processes from the others
ONE = dataclasses.replace(LIMITS, workers=1, worker_bytes=1 << 30, client_jobs=2)


def order(clients):
    """Return the order in which the jobs of clients have their turns at one process."""

    async def run():
        workers, called = Workers(dataclasses.replace(LIMITS, workers=1)), []

        async def job(client, number):
            async with workers.turn(client):
                called.append((client, number))
                await asyncio.sleep(0.01)

        await asyncio.gather(*(job(client, i) for i, client in enumerate(clients)))
        return called

    return asyncio.run(run())


def test_clients_have_their_turns_one_after_another():
    assert "".join(client for client, _ in order("aaaabc")) == "abcaaa"
    assert [number for _, number in order("aaa")] == [0, 1, 2]


def test_a_client_never_has_the_last_process():
    async def run():
        workers = Workers(dataclasses.replace(LIMITS, workers=2))
        async with workers.turn("a"):
            waiting = asyncio.create_task(workers.turn("a").__aenter__())
            await asyncio.sleep(0.01)
            assert not waiting.done()
            async with asyncio.timeout(1.0), workers.turn("b"):
                pass
            waiting.cancel()

    asyncio.run(run())


def test_a_client_with_too_many_jobs_is_sent_away_and_no_other():
    async def run():
        workers = Workers(ONE)

        async def job(client):
            async with workers.turn(client):
                await asyncio.sleep(3600.0)

        jobs = [asyncio.create_task(job("a")) for _ in range(2)]
        await asyncio.sleep(0.01)
        with pytest.raises(Busy, match="try again in 5 s"):
            await job("a")
        waiting = asyncio.create_task(job("b"))
        await asyncio.sleep(0.01)
        for task in (*jobs, waiting):  # one has the process, two wait
            task.cancel()
        await asyncio.wait([*jobs, waiting])
        async with asyncio.timeout(1.0), workers.turn("a"):
            pass

    asyncio.run(run())


def takes_much(count):
    return len([bytearray(1 << 20) for _ in range(count)])


@pytest.mark.slow
def test_a_job_has_limits_and_others_go_on():
    async def run(workers):
        workers.start()
        assert await workers.run(takes_much, 100, seconds=PATIENCE) == 100
        with pytest.raises(TooMuch, match="needs more memory than"):
            await workers.run(takes_much, 2000, seconds=PATIENCE)
        async with asyncio.timeout(50.0):
            with pytest.raises(TooMuch, match=r"longer than the 0.5 s that one request may"):
                await workers.run(time.sleep, 60.0, seconds=0.5)
        with pytest.raises(TooMuch, match="the process that computed this ended"):
            await workers.run(os._exit, 1, seconds=PATIENCE)
        with pytest.raises(InvalidValue, match="x must be a finite number, got nan"):
            await workers.run(finite, "x", math.nan, seconds=PATIENCE)
        first = await workers.run(os.getpid, seconds=PATIENCE)
        os.kill(first, signal.SIGKILL)
        await asyncio.sleep(1.0)  # the pool sees it a moment later
        assert await workers.run(os.getpid, seconds=PATIENCE) != first

    workers = Workers(ONE)
    try:
        asyncio.run(run(workers))
    finally:
        workers.stop()
