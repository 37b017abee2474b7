"""The explorer in Firefox, served and as one file: it plays, changes a law and draws a map."""

import json

import pytest

import stackbounce as sb
from web.browser.marionette import firefox

pytestmark = pytest.mark.slow

STORE = "window.wrappedJSObject?.stackbounce?.store ?? window.stackbounce?.store"


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    with firefox(tmp_path_factory.mktemp("profile")) as started:
        if started is None:
            pytest.skip("there is no Firefox on this machine")
        yield started


def state(browser, path):
    return browser.run(f"return JSON.stringify(({STORE}).get().{path})")


def test_a_drop_and_a_map(browser, address):
    browser.open(address)
    browser.wait(f"({STORE})?.get().result")
    drop = sb.Drop(
        [sb.Ball(0.150), sb.Ball(0.057)], [sb.Spring(2500), sb.Spring(1000)], impact_speed=3.53
    )
    expected = sb.simulate(drop).rebound_ratios.tolist()
    assert json.loads(state(browser, "result.rebound_ratios")) == expected
    browser.run(
        "const select = document.querySelector('[data-key=law-0]'); select.value = 'Viscoelastic';"
        "select.dispatchEvent(new Event('change', { bubbles: true }));"
    )
    browser.wait(f"({STORE}).get().result.drop.contacts[0].law === 'Viscoelastic'")
    browser.run("document.querySelector('#tab-map').click();")
    browser.wait("document.querySelector('#map-summary')?.textContent.includes('largest')")
    assert state(browser, "error") == "null"
