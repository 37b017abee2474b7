"""Other sites and large requests are kept out, and every answer tells browsers what it may do."""

import socket

import pytest

from stackbounce.explorer import LIMITS, guard
from stackbounce.explorer.addresses import Place

HOSTS = [
    "evil.example",
    "127.0.0.1.evil.example",
    "evil.example:8050",
    "",
    "[::1",
    "evil.example@localhost",
    "localhost/evil.example",
    "localhost:8050, evil.example",
]
ORIGINS = ["http://[", "https://127.0.0.1", "http://evil.example", "null", "http://127.0.0.1:1"]


def test_other_sites_are_kept_out(server):
    for name, values, status in (("host", HOSTS, 400), ("origin", ORIGINS, 403)):
        for value in values:
            assert server.get("/api/places", headers={name: value}).status_code == status, value


def test_the_page_itself_may_ask_by_each_name_of_this_machine(server, address_of_server, drop):
    asked = {"json": {"drop": drop}, "headers": {"origin": address_of_server.rstrip("/")}}
    assert server.post("/api/simulate", **asked).status_code == 200
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


def test_no_file_beside_the_page_is_served(server):
    outside = ("/../app.py", "/%2e%2e/app.py", "/..%2fapp.py", "/js/../../app.py", "//etc/passwd")
    for path in outside:
        response = server.get(path)
        assert response.status_code in (400, 404)
        assert "import" not in response.text


@pytest.mark.parametrize(
    ("path", "most"), [("/api/simulate", LIMITS.body_bytes), ("/api/measure", LIMITS.upload_bytes)]
)
def test_large_requests_are_refused(server, path, most):
    whole = server.post(path, content=b"x" * (most + 1))
    assert whole.status_code == 413
    assert "larger than" in whole.json()["detail"]
    assert server.post(path, content=iter([b"x"])).status_code == 411  # with no length told before
