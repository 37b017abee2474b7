"""Other sites may frame the page only where the user names them."""

import asyncio

import pytest

from stackbounce.cli import main
from stackbounce.errors import InvalidValue
from stackbounce.explorer import LIMITS
from stackbounce.explorer.framing import read_origin
from stackbounce.explorer.guard import Guard

SITE = "https://moodle.school.example"


@pytest.mark.parametrize(
    "text",
    [
        "",
        "moodle.school.example",
        "https://",
        f"{SITE}/",
        f"{SITE}/course?id=1",
        f"{SITE}:0",
        f"{SITE}:65536",
        f"{SITE}; script-src *",
        f"{SITE} https://other.example",
        f"{SITE}\n",
        "https://*.school.example",
        "https://user@school.example",
        "https://-school.example",
        "https://schüle.example",
        "file://school",
        "'self'",
        "**",
        f"https://{'a.' * 130}example",
    ],
)
def test_what_is_no_origin_is_refused(capsys, text):
    with pytest.raises(InvalidValue, match="--embed must be the origin of a site"):
        read_origin(text)
    assert main(["app", "--no-browser", "--embed", text]) == 2
    assert capsys.readouterr().err.count("\n") == 1


@pytest.mark.parametrize("text", [SITE, "http://localhost:8888", "http://192.168.1.5:80", "*"])
def test_an_origin_is_taken(text):
    assert read_origin(text.upper()) == text


async def answer(_, __, send):
    await send({"type": "http.response.start", "status": 200, "headers": []})
    await send({"type": "http.response.body", "body": b""})


def headers_of(path, framed_by):
    sent = []
    scope = {"type": "http", "method": "GET", "path": path, "headers": [(b"host", b"127.0.0.1")]}
    coming = [{"type": "http.request", "body": b""}, {"type": "http.disconnect"}]

    async def receive():
        return coming.pop(0)

    async def send(message):
        sent.append(message)

    asyncio.run(Guard(answer, LIMITS, framed_by)(scope, receive, send))
    return dict(sent[0]["headers"])


@pytest.mark.parametrize("path", ["/", "/index.html"])
def test_the_page_names_the_sites_that_may_frame_it(path):
    headers = headers_of(path, [SITE, "http://localhost:8888", SITE])
    policy = headers[b"content-security-policy"].decode()
    assert policy.endswith(f"; frame-ancestors {SITE} http://localhost:8888")
    assert b"x-frame-options" not in headers


@pytest.mark.parametrize(
    ("path", "framed_by"), [("/", []), ("/api/status", [SITE]), ("/paper/", [SITE])]
)
def test_nothing_else_can_be_framed(path, framed_by):
    headers = headers_of(path, framed_by)
    assert headers[b"content-security-policy"].decode().endswith("; frame-ancestors 'none'")
    assert headers[b"x-frame-options"] == b"DENY"


@pytest.mark.parametrize("name", ["explorer.html", "explorer"])
def test_an_export_says_which_header_its_server_must_send(capsys, tmp_path, name):
    assert main(["app", "--export", str(tmp_path / name), "--embed", SITE]) == 0
    told = capsys.readouterr().out.splitlines()
    assert told[-1] == f"Content-Security-Policy: frame-ancestors {SITE}"
