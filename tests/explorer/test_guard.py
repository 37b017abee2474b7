"""Other sites, large and slow requests are kept out; a job that takes too long is ended."""

import asyncio
import dataclasses
import os
import signal
import socket
import time

import pytest
import uvicorn

from stackbounce.errors import InvalidValue
from stackbounce.explorer import LIMITS, connections
from stackbounce.explorer.guard import Guard
from stackbounce.explorer.shares import Busy
from stackbounce.explorer.worker_pool import TooMuch, Workers

FOREIGN = [
    ({"host": "evil.example"}, 400),
    ({"host": "127.0.0.1.evil.example"}, 400),
    ({"host": "evil.example:8050"}, 400),
    ({"host": ""}, 400),
    ({"host": "[::1"}, 400),
    ({"host": "evil.example@localhost"}, 400),
    ({"host": "localhost/evil.example"}, 400),
    ({"host": "localhost:8050, evil.example"}, 400),
    ({"origin": "http://["}, 403),
    ({"origin": "https://127.0.0.1"}, 403),
    ({"sec-fetch-site": "Cross-Site"}, 403),
    ({"origin": "http://evil.example"}, 403),
    ({"origin": "null"}, 403),
    ({"origin": "http://127.0.0.1:1"}, 403),
    ({"sec-fetch-site": "cross-site"}, 403),
    ({"sec-fetch-site": "same-site", "sec-fetch-mode": "cors"}, 403),
]


@pytest.mark.parametrize(("headers", "status"), FOREIGN)
def test_other_sites_are_kept_out(server, headers, status):
    response = server.get("/api/status", headers=headers)
    assert response.status_code == status
    assert "detail" in response.json()


def test_a_link_may_lead_here_and_the_page_itself_may_ask(server, address):
    link = {"sec-fetch-site": "cross-site", "sec-fetch-mode": "navigate"}
    assert server.get("/", headers=link).status_code == 200
    assert server.post("/api/stack", headers=link, json={"balls": ["B1"]}).status_code == 403
    own = {"origin": address.rstrip("/"), "sec-fetch-site": "same-origin"}
    assert server.post("/api/stack", headers=own, json={"balls": ["B1"]}).status_code == 200
    port = address.rstrip("/").rpartition(":")[2]
    own = socket.gethostname()
    for name in ("localhost", "[::1]", "192.168.0.7", own, f"{own.partition('.')[0]}.local"):
        assert server.get("/api/status", headers={"host": f"{name}:{port}"}).status_code == 200


def test_the_full_name_of_this_machine_is_answered_and_no_other(monkeypatch):
    monkeypatch.setattr(socket, "gethostname", lambda: "desk")
    monkeypatch.setattr(socket, "getfqdn", lambda: "desk.school.example")
    guard = Guard(echo, LIMITS)
    for name, status in (("desk.school.example", 200), ("Desk", 200), ("desk.evil.example", 400)):
        head, _ = asked(guard, [{"type": "http.request", "body": b""}], host=name.encode())
        assert head["status"] == status


@pytest.mark.parametrize("path", ["/", "/api/status", "/none", "/api/openapi.json"])
def test_every_answer_has_the_headers(server, path):
    headers = server.get(path).headers
    assert "default-src 'none'" in headers["content-security-policy"]
    assert "frame-ancestors 'none'" in headers["content-security-policy"]
    assert headers["x-content-type-options"] == "nosniff"
    assert headers["permissions-policy"] == "camera=(), geolocation=(), microphone=(self)"
    assert headers["cross-origin-resource-policy"] == "same-origin"
    assert headers["referrer-policy"] == "no-referrer"
    assert "set-cookie" not in headers
    assert "server" not in headers


def test_no_file_beside_the_page_is_served(server):
    for path in (
        "/../app.py",
        "/%2e%2e/app.py",
        "/..%2fapp.py",
        "/js/../../app.py",
        "//etc/passwd",
    ):
        response = server.get(path)
        assert response.status_code in (400, 404)
        assert "import" not in response.text


@pytest.mark.parametrize(
    ("path", "most"), [("/api/simulate", LIMITS.body_bytes), ("/api/measure", LIMITS.upload_bytes)]
)
def test_large_requests_are_refused(server, path, most):
    def parts():
        for _ in range(most // 65_536 + 2):
            yield b"x" * 65_536

    whole = server.post(path, content=b"x" * (most + 1))
    assert whole.status_code == 413
    assert "larger than" in whole.json()["detail"]
    assert server.post(path, content=parts()).status_code == 413  # with no length told before


def asked(app, messages, path="/api/simulate", host=b"127.0.0.1"):
    """Return head and body of an answer to a request that comes in these parts."""
    headers = [(b"host", host)]
    scope = {"type": "http", "method": "POST", "path": path, "headers": headers}
    sent = []

    async def run():
        left = iter(messages)

        async def receive():
            message = next(left, None)
            if message is None:
                await asyncio.sleep(3600.0)
            return message

        async def send(message):
            sent.append(message)

        await app(scope, receive, send)

    asyncio.run(run())
    return sent[0], sent[1]["body"]


@pytest.mark.slow
def test_a_request_that_does_not_come_is_ended():
    guard = Guard(None, dataclasses.replace(LIMITS, upload_seconds=0.05))
    part = {"type": "http.request", "body": b"{", "more_body": True}
    head, body = asked(guard, [part])
    assert head["status"] == 408
    assert b"did not come in whole within 0.05 s" in body
    head, _ = asked(guard, [part, {"type": "http.disconnect"}])
    assert head["status"] == 400


def test_all_requests_together_are_bounded():
    guard = Guard(echo, dataclasses.replace(LIMITS, held_bytes=5))
    for body, status in ((b"123456", 503), (b"12345", 200), (b"123456", 503), (b"12345", 200)):
        head, _ = asked(guard, [{"type": "http.request", "body": body, "more_body": False}])
        assert head["status"] == status


async def pages(_, __, send):
    headers = [(b"content-security-policy", b"own")]
    await send({"type": "http.response.start", "status": 200, "headers": headers})
    await send({"type": "http.response.body", "body": b""})


@pytest.mark.parametrize(("path", "kept"), [("/paper/index.html", True), ("/", False)])
def test_a_page_of_the_paper_tells_its_own_scripts(path, kept):
    head, _ = asked(
        Guard(pages, LIMITS), [{"type": "http.request", "body": b"", "more_body": False}], path
    )
    policies = [value for name, value in head["headers"] if name == b"content-security-policy"]
    assert len(policies) == 1
    assert (policies[0] == b"own") is kept


async def echo(_, receive, send):
    message = await receive()
    await send(
        {"type": "http.response.start", "status": 200, "headers": [(b"x-frame-options", b"")]}
    )
    await send({"type": "http.response.body", "body": message["body"]})


@pytest.mark.parametrize(
    ("path", "scripts"), [("/", True), ("/api/map", True), ("/paper/index.html", False)]
)
def test_pages_of_the_paper_run_no_script(path, scripts):
    parts = [
        {"type": "http.request", "body": b"ab", "more_body": True},
        {"type": "http.request", "body": b"c", "more_body": False},
    ]
    head, body = asked(Guard(echo, LIMITS), parts, path)
    headers = dict(head["headers"])
    assert body == b"abc"
    assert headers[b"x-frame-options"] == b"DENY"
    assert (b"script-src" in headers[b"content-security-policy"]) is scripts
    assert (b"unsafe-inline" in headers[b"content-security-policy"]) is not scripts


def sleeps(seconds):
    time.sleep(seconds)
    return "slept"


def dies():
    os._exit(1)


def fails():
    raise InvalidValue("x must be 3, got 4")


@pytest.fixture
def workers():
    made = Workers(dataclasses.replace(LIMITS, workers=1, waiting=2))
    yield made
    made.stop()


@pytest.mark.slow
def test_a_job_that_takes_too_long_is_ended_and_others_go_on(workers):
    async def run():
        with pytest.raises(TooMuch, match=r"longer than the 0.5 s that one request may"):
            await workers.run(sleeps, 60.0, seconds=0.5)
        with pytest.raises(TooMuch, match="the process that computed this ended"):
            await workers.run(dies, seconds=60.0)
        with pytest.raises(InvalidValue, match="x must be 3"):
            await workers.run(fails, seconds=60.0)
        return await workers.run(sleeps, 0.0, seconds=60.0)

    assert asyncio.run(run()) == "slept"


def here():
    return os.getpid()


@pytest.mark.slow
def test_processes_that_were_ended_while_idle_are_made_anew(workers):
    async def run():
        first = await workers.run(here, seconds=60.0)
        os.kill(first, signal.SIGKILL)
        for _ in range(100):  # the pool sees it a moment later
            try:
                second = await workers.run(here, seconds=60.0)
            except TooMuch:
                continue
            if second != first:
                return first, second
        return first, first

    first, second = asyncio.run(run())
    assert second != first


def test_silent_connections_are_closed():
    async def run():
        protocol = connections.make_protocol(dataclasses.replace(LIMITS, head_seconds=0.2))
        config = uvicorn.Config(echo, http=protocol, log_level="error", lifespan="off")
        config.load()
        server = uvicorn.Server(config)
        with socket.socket() as listening:
            listening.bind(("127.0.0.1", 0))
            listening.listen()
            serving = asyncio.create_task(server.serve([listening]))
            address = listening.getsockname()
            silent = await asyncio.open_connection(*address)
            begun = await asyncio.open_connection(*address)
            begun[1].write(b"GET / HTT")
            asks = await asyncio.open_connection(*address)
            asks[1].write(b"POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 2\r\n\r\nab")
            closed = [await asyncio.wait_for(reader.read(), 5.0) for reader, _ in (silent, begun)]
            answer = await asyncio.wait_for(asks[0].readuntil(b"ab"), 5.0)
            for _, writer in (silent, begun, asks):
                writer.close()
            server.should_exit = True
            await serving
        return closed, answer

    closed, answer = asyncio.run(run())
    assert closed == [b"", b""]
    assert answer.startswith(b"HTTP/1.1 200")


def test_too_many_at_once_are_sent_away(workers):
    async def run():
        jobs = [asyncio.create_task(workers.run(sleeps, 0.5, seconds=60.0)) for _ in range(2)]
        await asyncio.sleep(0.1)
        with pytest.raises(Busy, match="try again in 5 s"):
            await workers.run(sleeps, 0.0, seconds=60.0)
        assert await asyncio.gather(*jobs) == ["slept", "slept"]
        return await workers.run(sleeps, 0.0, seconds=60.0)

    assert asyncio.run(run()) == "slept"
