"""A page of the explorer in Chromium; whatever it complains about or asks for elsewhere fails."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from playwright.sync_api import sync_playwright

NAMES = ("chromium", "chromium-browser", "google-chrome")
PICTURES = Path("build/screenshots")
LAPTOP = {"width": 1366, "height": 768}


def chromium():
    found = next(filter(None, map(shutil.which, NAMES)), None)
    if found is None and os.environ.get("STACKBOUNCE_BROWSER") == "required":
        pytest.fail("there is no Chromium, which STACKBOUNCE_BROWSER=required asks for")
    if found is None:
        pytest.skip("there is no Chromium on this machine")
    return found


@pytest.fixture(scope="module")  # while it runs, its event loop is in the way of other tests' own
def browser():
    path = chromium()
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=path)
        yield started
        started.close()


@pytest.fixture(scope="session")
def one_file(tmp_path_factory):
    """Write the explorer as one file; return its path."""
    path = tmp_path_factory.mktemp("one file") / "explorer ä.html"
    command = [sys.executable, "-m", "stackbounce", "app", "--export", path]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.startswith(f"{path}: the explorer, ")
    return path


@pytest.fixture(params=["served", "one file"])
def address(request):
    """Return the address of the page in both of its forms, one after the other."""
    if request.param == "served":
        return request.getfixturevalue("address_of_server")
    return request.getfixturevalue("one_file").as_uri()


class Visit:
    """A page, and what it complained about or asked for."""

    def __init__(self, page, address):
        self.page, self.address = page, address
        self.complaints, self.requests = [], []
        page.on("console", self._heard)
        page.on("pageerror", lambda error: self.complaints.append(str(error)))
        page.on("request", lambda request: self.requests.append(request.url))

    def _heard(self, message):
        if message.type in ("error", "warning"):
            self.complaints.append(message.text)

    def open(self, fragment=""):
        self.page.goto(f"{self.address}{fragment}")
        self.ready()
        return self.page

    def ready(self):
        """Wait until the page shows the result of the drop that it has."""
        self.page.wait_for_function(
            "() => { const s = window.stackbounce?.store.get();"
            " return s?.result && !s.busy && document.querySelector('#controls').children.length; }"
        )

    def state(self, path):
        return self.page.evaluate(f"() => window.stackbounce.store.get().{path}")

    def note(self, name, text):
        PICTURES.mkdir(parents=True, exist_ok=True)
        (PICTURES / f"{name}.txt").write_text(f"{text}\n")

    def picture(self, name, **options):
        PICTURES.mkdir(parents=True, exist_ok=True)
        self.page.screenshot(path=PICTURES / f"{name}.png", **options)

    def foreign(self):
        inside = (self.address, "data:", "blob:")
        return [url for url in self.requests if not url.startswith(inside)]


@pytest.fixture
def visits(browser, address):
    """Open pages of their own settings; check at the end that none complained."""
    opened = []

    def visit(**settings):
        context = browser.new_context(**{"viewport": LAPTOP} | settings)
        context.set_default_timeout(60_000)
        opened.append(Visit(context.new_page(), address))
        return opened[-1]

    yield visit
    for one in opened:
        one.page.context.close()
    assert [one.complaints for one in opened] == [[]] * len(opened)
    assert [one.foreign() for one in opened] == [[]] * len(opened)


@pytest.fixture
def visit(visits):
    """Open a page as a laptop shows it."""
    return visits()
