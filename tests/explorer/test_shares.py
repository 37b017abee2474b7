"""No client keeps the server from the others: turns, shares, and clients that have gone."""

import asyncio
import contextlib
import dataclasses
import json
import socket
import time

import httpx
import pytest
import uvicorn

from adversary.requests_server import LONG_MAP, serving
from stackbounce.explorer import LIMITS, connections
from stackbounce.explorer.guard import Guard
from stackbounce.explorer.shares import Busy, Shares, client_of
from stackbounce.explorer.turns import Turns
from stackbounce.explorer.worker_pool import TooMuch, Workers


def order(places, jobs):
    """Return the order in which jobs were called, each of which ends when it is called."""

    async def run():
        turns, called = Turns(places), []

        async def job(client, number):
            async with turns.turn(client):
                called.append((client, number))
                await asyncio.sleep(0.01)

        await asyncio.gather(*(job(client, i) for i, client in enumerate(jobs)))
        return called

    return asyncio.run(run())


def test_clients_have_their_turns_one_after_another():
    assert [client for client, _ in order(1, "aaaabc")] == list("aabcaa")
    assert [number for _, number in order(1, "aaa")] == [0, 1, 2]


def test_a_client_never_has_the_last_place():
    async def run():
        turns = Turns(2)
        async with turns.turn("a"):
            waiting = asyncio.create_task(turns.turn("a").__aenter__())
            await asyncio.sleep(0.01)
            assert not waiting.done()
            async with asyncio.timeout(1.0), turns.turn("b"):
                pass
            waiting.cancel()

    asyncio.run(run())


def test_a_job_that_is_cancelled_leaves_its_place_to_others():
    async def run():
        turns = Turns(1)

        async def job(client):
            async with turns.turn(client):
                await asyncio.sleep(3600.0)

        jobs = [asyncio.create_task(job(client)) for client in "aab"]
        await asyncio.sleep(0.01)
        for one in jobs:  # one has the place, two wait
            one.cancel()
        async with asyncio.timeout(1.0), turns.turn("c"):
            pass

    asyncio.run(run())


def test_shares_are_given_back():
    shares = Shares("too much", 5, 3)
    shares.take("a", 3)
    with pytest.raises(Busy, match="too much from your address at once: try again in 5 s") as own:
        shares.take("a")
    shares.take("b", 2)
    with pytest.raises(Busy, match="too much at once: try again in 5 s") as all_together:
        shares.take("c")
    assert (own.value.status, all_together.value.status) == (429, 503)
    shares.give_back("a", 3)
    shares.take("c", 3)


@pytest.mark.parametrize(
    ("host", "client"),
    [
        ("192.168.0.7", "192.168.0.7"),
        ("::ffff:192.168.0.7", "192.168.0.7"),
        ("2001:db8::1:0:0:7", "2001:db8::/64"),
        ("unknown", "unknown"),
    ],
)
def test_a_client_is_an_address_or_a_network(host, client):
    assert client_of({"client": (host, 1)}) == client
    assert client_of({"client": None}) == ""


def test_what_its_client_no_longer_waits_for_is_cancelled():
    ended = []

    async def app(*_):
        try:
            await asyncio.sleep(3600.0)
        finally:
            ended.append(True)

    async def run():
        messages = [{"type": "http.request", "body": b"", "more_body": False}]

        async def receive():
            await asyncio.sleep(0.01)
            return messages.pop() if messages else {"type": "http.disconnect"}

        async def send(message):
            raise AssertionError(message)

        headers = [(b"host", b"127.0.0.1")]
        scope = {"type": "http", "method": "GET", "path": "/", "headers": headers}
        async with asyncio.timeout(5.0):
            await Guard(app, LIMITS)(scope, receive, send)

    asyncio.run(run())
    assert ended == [True]


def takes_much(count):
    return len([bytearray(1 << 20) for _ in range(count)])


def rests(seconds):
    time.sleep(seconds)


@pytest.mark.slow
def test_a_job_has_limits_and_is_ended_with_its_client():
    workers = Workers(dataclasses.replace(LIMITS, workers=1, worker_bytes=1 << 30))

    async def run():
        assert await workers.run(takes_much, 100, seconds=60.0) == 100
        with pytest.raises(TooMuch, match="needs more memory than"):
            await workers.run(takes_much, 2000, seconds=60.0)
        gone = [asyncio.create_task(workers.run(rests, 60.0, seconds=90.0)) for _ in range(50)]
        await asyncio.sleep(0.5)
        for one in gone:
            one.cancel()
        start = time.monotonic()
        assert await workers.run(takes_much, 1, seconds=60.0) == 1
        return time.monotonic() - start

    try:
        waited = asyncio.run(run())
    finally:
        workers.stop()
    assert waited < 30.0  # a single one of them takes twice as long


async def answers(_, receive, send):
    await receive()
    await send({"type": "http.response.start", "status": 200, "headers": []})
    await send({"type": "http.response.body", "body": b"here"})


def test_a_client_with_too_many_connections_loses_the_oldest():
    async def run():
        limits = dataclasses.replace(LIMITS, client_connections=2)
        protocol = connections.make_protocol(limits)
        config = uvicorn.Config(answers, http=protocol, log_level="error", lifespan="off")
        config.load()
        server = uvicorn.Server(config)
        with contextlib.closing(open_socket()) as listening:
            serving_task = asyncio.create_task(server.serve([listening]))
            place = listening.getsockname()
            silent = [await asyncio.open_connection(*place) for _ in range(2)]
            reader, writer = await asyncio.open_connection(*place)
            writer.write(b"GET / HTTP/1.1\r\nHost: x\r\n\r\n")
            answer = await asyncio.wait_for(reader.readuntil(b"0\r\n\r\n"), 5.0)
            with contextlib.suppress(ConnectionResetError):
                assert await asyncio.wait_for(silent[0][0].read(), 5.0) == b""
            assert not silent[1][0].at_eof()
            for _, one in (*silent, (reader, writer)):
                one.close()
            server.should_exit = True
            await serving_task
        return answer

    assert b"here" in asyncio.run(run())


def open_socket():
    listening = socket.socket()
    listening.bind(("127.0.0.1", 0))
    listening.listen()
    return listening


@pytest.mark.slow
def test_a_school_behind_one_address_can_use_it():
    """Thirty pupils move sliders, look at small maps, and some ask for large ones."""
    drop = LONG_MAP["drop"] | {"balls": LONG_MAP["drop"]["balls"][:2]}
    drop["contacts"] = [{"law": "Spring", "stiffness": 1000.0 * (i + 1)} for i in range(2)]
    small = {side: LONG_MAP[side] | {"count": 50} for side in "xy"}

    async def pupil(client, number):
        statuses = []
        for _ in range(3):
            asked = {"drop": drop | {"impact_speed": 1.0 + number}}
            statuses += [(await client.post("/api/simulate", json=asked)).status_code]
            await asyncio.sleep(0.5)
        statuses += [(await client.post("/api/map", json=asked | small)).status_code]
        return statuses

    async def run(address):
        limits = httpx.Limits(max_connections=None)
        async with httpx.AsyncClient(base_url=address, timeout=120.0, limits=limits) as client:
            large = [asyncio.create_task(client.post("/api/map", json=LONG_MAP)) for _ in range(2)]
            seen = await asyncio.gather(*(pupil(client, number) for number in range(30)))
            for one in large:
                one.cancel()
        return seen

    with serving() as server:
        seen = asyncio.run(run(server.address))
    assert seen == [[200] * 4] * 30


def test_a_refusal_says_when_to_try_again():
    limits = dataclasses.replace(LIMITS, client_bytes=3)

    async def run():
        sent = []

        async def receive():
            return {"type": "http.request", "body": b"1234", "more_body": False}

        async def send(message):
            sent.append(message)

        headers = [(b"host", b"127.0.0.1")]
        scope = {"type": "http", "method": "POST", "path": "/", "headers": headers}
        await Guard(answers, limits)(scope, receive, send)
        return sent

    head, body = asyncio.run(run())
    assert head["status"] == 429
    assert dict(head["headers"])[b"retry-after"] == b"5"
    assert "try again in 5 s" in json.loads(body["body"])["detail"]
