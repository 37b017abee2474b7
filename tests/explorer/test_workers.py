"""Jobs have limits of time and memory, and no client keeps the processes from the others."""

import asyncio
import dataclasses
import math
import os
import signal
import time

import pytest

from stackbounce.errors import InvalidValue, finite
from stackbounce.explorer import LIMITS
from stackbounce.explorer.workers import Busy, TooMuch, Workers

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
        assert await workers.run(takes_much, 100, seconds=60.0) == 100
        with pytest.raises(TooMuch, match="needs more memory than"):
            await workers.run(takes_much, 2000, seconds=60.0)
        async with asyncio.timeout(10.0):
            with pytest.raises(TooMuch, match=r"longer than the 0.5 s that one request may"):
                await workers.run(time.sleep, 60.0, seconds=0.5)
        with pytest.raises(TooMuch, match="the process that computed this ended"):
            await workers.run(os._exit, 1, seconds=60.0)
        with pytest.raises(InvalidValue, match="x must be a finite number, got nan"):
            await workers.run(finite, "x", math.nan, seconds=60.0)
        first = await workers.run(os.getpid, seconds=60.0)
        os.kill(first, signal.SIGKILL)
        await asyncio.sleep(1.0)  # the pool sees it a moment later
        assert await workers.run(os.getpid, seconds=60.0) != first

    workers = Workers(ONE)
    try:
        asyncio.run(run(workers))
    finally:
        workers.stop()
