"""Other sites may frame the page only where the user names them."""

import asyncio

import httpx
import pytest

from stackbounce.cli import main
from stackbounce.errors import InvalidValue
from stackbounce.explorer import LIMITS
from stackbounce.explorer.app import create_app
from stackbounce.explorer.framing import read_origin

SITE = "https://moodle.school.example"


@pytest.mark.parametrize(
    "text",
    [
        *("", "moodle.school.example", f"{SITE}/", f"{SITE}:655360", f"{SITE}; script-src *"),
        *(f"{SITE}\n", "https://*.school.example", "https://user@school.example", "**"),
        *("https://-school.example", "https://schüle.example", "file://school"),
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


def policy_of(path, framed_by):
    transport = httpx.ASGITransport(create_app(LIMITS, framed_by=framed_by))

    async def ask():
        async with httpx.AsyncClient(transport=transport, base_url="http://localhost") as client:
            return await client.get(path)

    return asyncio.run(ask()).headers["content-security-policy"]


def test_the_page_names_the_sites_that_may_frame_it():
    policy = policy_of("/", [SITE, "http://localhost:8888", SITE])
    assert policy.endswith(f"; frame-ancestors {SITE} http://localhost:8888")
    assert policy_of("/", []).endswith("; frame-ancestors 'none'")


@pytest.mark.parametrize("name", ["explorer.html", "explorer"])
def test_an_export_says_which_header_its_server_must_send(capsys, tmp_path, name):
    path = tmp_path / name
    assert main(["app", "--export", str(path), "--embed", SITE]) == 0
    told = capsys.readouterr().out.splitlines()
    files = [part for part in (path, *path.rglob("*")) if part.is_file()]
    size = sum(part.stat().st_size for part in files if part.suffix != ".sha256")
    assert told[0].startswith(f"{path}: the explorer")
    assert told[0].endswith(f", {size / 1000:.0f} kB")
    assert told[-1] == f"Content-Security-Policy: frame-ancestors {SITE}"
