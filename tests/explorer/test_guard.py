"""Other sites and large requests are kept out, and every answer tells browsers what it may do."""

import socket
from types import SimpleNamespace

import psutil
import pytest

from explorer.conftest import ASKED
from stackbounce.explorer import LIMITS, addresses, guard
from stackbounce.explorer.addresses import Place
from stackbounce.explorer.made import made_file

HOSTS = [
    *("evil.example", "127.0.0.1.evil.example", "evil.example:8050", "", "[::1"),
    *("evil.example@localhost", "localhost/evil.example", "localhost:8050, evil.example"),
]
ORIGINS = ["http://[", "https://127.0.0.1", "http://evil.example", "null", "http://127.0.0.1:1"]


def test_other_sites_are_kept_out(server):
    for name, values, status in (("host", HOSTS, 400), ("origin", ORIGINS, 403)):
        for value in values:
            assert server.get("/api/places", headers={name: value}).status_code == status, value


@pytest.mark.slow
def test_the_page_itself_may_ask_by_each_name_of_this_machine(server, address_of_server):
    asked = {"json": ASKED, "headers": {"origin": address_of_server.rstrip("/")}}
    assert server.post("/api/predict", **asked).status_code == 200
    port = address_of_server.rstrip("/").rpartition(":")[2]
    own = socket.gethostname()
    for name in ("localhost", "[::1]", "192.168.0.7", own, f"{own.partition('.')[0]}.local"):
        assert server.get("/api/places", headers={"host": f"{name}:{port}"}).status_code == 200


def test_a_class_may_use_the_full_name_of_this_machine(monkeypatch):
    monkeypatch.setattr(socket, "gethostname", lambda: "desk")
    monkeypatch.setattr(socket, "getfqdn", lambda: "desk.school.example")
    hosts = guard._list_hosts([Place("http://[fd00::2]:8050/", [])])
    assert {"desk", "desk.local", "desk.school.example", "[fd00::2]"} <= set(hosts)


FIXED = {
    "x-content-type-options": "nosniff",
    "permissions-policy": "camera=(), geolocation=(), microphone=(self)",
    "cross-origin-resource-policy": "same-origin",
    "referrer-policy": "no-referrer",
}


@pytest.mark.parametrize("path", ["/", "/api/places", "/none", "/api/openapi.json"])
def test_every_answer_has_the_headers(server, path):
    headers = server.get(path).headers
    assert "default-src 'none'" in headers["content-security-policy"]
    assert "frame-ancestors 'none'" in headers["content-security-policy"]
    assert headers.items() >= FIXED.items()
    assert not {"set-cookie", "server"} & set(headers)


def test_files_of_the_page_come_compressed_and_no_others(server):
    script = server.get("/explorer.js")
    assert script.headers["content-encoding"] == "gzip"
    assert script.content == made_file("explorer.js")
    outside = ("/../app.py", "/%2e%2e/app.py", "/..%2fapp.py", "/js/../../app.py", "//etc/passwd")
    for path in outside:
        response = server.get(path)
        assert response.status_code in (400, 404)
        assert "import" not in response.text


@pytest.mark.parametrize(
    ("path", "most"), [("/api/predict", LIMITS.body_bytes), ("/api/measure", LIMITS.upload_bytes)]
)
def test_large_requests_are_refused(server, path, most):
    whole = server.post(path, content=b"x" * (most + 1))
    assert whole.status_code == 413
    assert "larger than" in whole.json()["detail"]
    assert server.post(path, content=iter([b"x"])).status_code == 411  # with no length told before


# --- the addresses that a class can type, of machines with several networks, and with none
OWN = {
    "lo": [(socket.AF_INET, "127.0.0.1"), (socket.AF_INET6, "::1")],
    "eth0": [(socket.AF_INET, "10.1.2.3"), (socket.AF_INET6, "fd00::2")],
    "wlan0": [(socket.AF_INET, "192.168.1.5"), (socket.AF_INET6, "fe80::1%wlan0")],
    "down0": [(socket.AF_INET, "10.9.9.9")],
}


@pytest.fixture
def machine(monkeypatch):
    """Give the machine the networks of OWN, of which wlan0 leads to others."""
    own = {
        name: [SimpleNamespace(family=family, address=address) for family, address in pairs]
        for name, pairs in OWN.items()
    }
    up = {name: SimpleNamespace(isup=not name.startswith("down")) for name in OWN}
    monkeypatch.setattr(psutil, "net_if_addrs", lambda: own)
    monkeypatch.setattr(psutil, "net_if_stats", lambda: up)
    monkeypatch.setattr(addresses, "_way_out", lambda: "192.168.1.5")
    return own


@pytest.mark.parametrize(
    ("host", "expected"),
    [
        ("127.0.0.1", []),
        ("::1", []),
        ("localhost", []),
        ("10.1.2.3", ["http://10.1.2.3:80/"]),
        ("fd00::2", ["http://[fd00::2]:80/"]),
        ("0.0.0.0", ["http://192.168.1.5:80/", "http://10.1.2.3:80/"]),
        ("::", ["http://192.168.1.5:80/", "http://10.1.2.3:80/"]),
    ],
)
@pytest.mark.usefixtures("machine")
def test_addresses_that_others_can_type(host, expected):
    assert [one.address for one in addresses.list_places(host, 80)] == expected


def test_a_machine_without_a_network_has_no_addresses(machine):
    for name in ("eth0", "wlan0"):
        del machine[name]
    assert addresses.list_places("0.0.0.0", 80) == []


def test_a_code_has_its_three_corners():
    [place] = addresses.list_places("203.0.113.7", 8050)
    corner = ["1111111", "1000001", "1011101", "1011101", "1011101", "1000001", "1111111"]
    rows = place.code
    assert [row[:7] for row in rows[:7]] == corner
    assert [row[-7:] for row in rows[:7]] == corner
    assert [row[:7] for row in rows[-7:]] == corner
