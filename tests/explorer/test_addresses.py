"""The addresses that a class can type, of machines with several networks, and with none."""

import socket
from types import SimpleNamespace

import psutil
import pytest

from stackbounce.cli import explorer
from stackbounce.explorer import addresses

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
    ways = {socket.AF_INET: "192.168.1.5", socket.AF_INET6: None}
    monkeypatch.setattr(addresses, "_way_out", ways.get)
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
        ("::", ["http://192.168.1.5:80/", "http://10.1.2.3:80/", "http://[fd00::2]:80/"]),
    ],
)
@pytest.mark.usefixtures("machine")
def test_addresses_that_others_can_type(host, expected):
    assert [one.address for one in addresses.list_places(host, 80)] == expected


def test_a_machine_without_a_network_says_so(machine, capsys):
    for name in ("eth0", "wlan0"):
        del machine[name]
    places = addresses.list_places("0.0.0.0", 80)
    assert places == []
    explorer._tell_others(places)
    assert capsys.readouterr().out == (
        "This machine is in no network: others cannot open the page.\n"
    )


def test_a_code_has_its_three_corners():
    [place] = addresses.list_places("203.0.113.7", 8050)
    corner = ["1111111", "1000001", "1011101", "1011101", "1011101", "1000001", "1111111"]
    rows = place.code
    assert [row[:7] for row in rows[:7]] == corner
    assert [row[-7:] for row in rows[:7]] == corner
    assert [row[:7] for row in rows[-7:]] == corner
    lines = addresses.code_text(place.address).splitlines()
    assert len(lines) == (len(rows) + 5) // 2
