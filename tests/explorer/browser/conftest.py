"""A page of the explorer in Chromium and in Firefox; a page that complains fails."""

import functools
import http.server
import os
import shutil
import threading
import time
import zlib

import pytest
from playwright.sync_api import sync_playwright

import stackbounce as sb
from stackbounce.cli import main
from stackbounce.cross2007.cases import explorer_address, list_cases

BROWSERS = {
    "chromium": ("chromium", "chromium-browser", "google-chrome"),
    "firefox": ("firefox-esr", "firefox"),
}
ASKED = os.environ.get("STACKBOUNCE_BROWSERS", "").split()
IN_BOTH = ["test_one_file"]  # the others are slow in Firefox: only `make browsers` runs them there
FORMS = ("served", "one file")
LAPTOP = {"width": 1366, "height": 768}
[PAPER] = [explorer_address(one.drop, {}) for one in list_cases() if one.name == "figure-9"]


def path_of(name):
    found = next(filter(None, map(shutil.which, BROWSERS[name])), None)
    if found is None and name in ASKED:
        pytest.fail(f"there is no {name}, which STACKBOUNCE_BROWSERS asks for")
    if found is None:
        pytest.skip(f"there is no {name} on this machine")
    return found


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """Serve an empty folder, as `python -m http.server` does, at another address."""
    folder = tmp_path_factory.mktemp("site")
    handler = functools.partial(Quiet, directory=folder)
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        server.folder = folder
        thread = threading.Thread(target=server.serve_forever, args=(0.05,))
        thread.start()
        yield server
        server.shutdown()
        thread.join()


@pytest.fixture(scope="module")
def downloads(tmp_path_factory):
    """Return the folder in which Firefox saves files."""
    return tmp_path_factory.mktemp("downloads")


def pytest_generate_tests(metafunc):
    """Run tests in the browsers that STACKBOUNCE_BROWSERS names, else in Chromium, some in both.

    The forms of the page are those that a module names in `FORMS`. Of several one is chosen by the
    test's name: all of them take too long, and Firefox is asked for where time does not count.
    """
    if "browser" in metafunc.fixturenames:
        both = metafunc.module.__name__.rpartition(".")[2] in IN_BOTH
        names = ASKED if "firefox" in ASKED else list(BROWSERS) if both else ["chromium"]
        metafunc.parametrize("browser", names, indirect=True, scope="module")
    if "address" in metafunc.fixturenames:
        marks = metafunc.definition.iter_markers("forms")
        forms = next((mark.args for mark in marks), getattr(metafunc.module, "FORMS", FORMS))
        place = zlib.crc32(metafunc.function.__name__.encode()) % len(forms)
        chosen = forms if "firefox" in ASKED else forms[place : place + 1]
        metafunc.parametrize("address", chosen, indirect=True)


@pytest.fixture(scope="module")
def browser(request, downloads):
    """Start one browser after the other; while it runs, its event loop is in the way of others."""
    path = path_of(request.param)
    with sync_playwright() as playwright:
        options = {"executable_path": path, "downloads_path": downloads}
        if request.param == "firefox":
            options["channel"] = "moz-firefox"  # as it is installed, by WebDriver BiDi
        started = getattr(playwright, request.param).launch(**options)
        yield started
        started.close()


@pytest.fixture
def in_firefox(browser):
    return browser.browser_type.name == "firefox"


@pytest.fixture(scope="session")
def one_file(tmp_path_factory):
    path = tmp_path_factory.mktemp("one file") / "explorer ä.html"
    assert main(["app", "--export", str(path)]) == 0
    return path


@pytest.fixture
def address(request):
    if request.param == "one file":
        return request.getfixturevalue("one_file").as_uri()
    name = {"served": "address_of_server", "folder": "folder"}[request.param]
    return request.getfixturevalue(name)


SHORT = """for (const name of ["store", "clock", "whole"]) {
  Object.defineProperty(window, name, { get: () => window.stackbounce?.[name] });
}
Object.defineProperty(window, "state", { get: () => window.store?.get() });
"""  # what the scripts of these tests call the parts of `window.stackbounce`


class Visit:
    """A page, and what it complained about or asked for."""

    paper = PAPER

    def __init__(self, page, address, downloads):
        page.add_init_script(SHORT)
        self.page, self.address, self.downloads = page, address, downloads
        self.complaints, self.requests, self.expected = [], [], None
        page.on("console", self._heard)
        page.on("pageerror", lambda error: self._complained(str(error)))
        page.on("request", lambda request: self.requests.append(request.url))

    def _heard(self, message):
        if message.type in ("error", "warning"):
            self._complained(message.text)

    def _complained(self, text):
        if not (self.expected and self.expected in text):
            self.complaints.append(text)

    def open(self, fragment=PAPER, playback=True):
        """Open the whole page with the paper's drop, or a fragment's; show all playback."""
        first = "" if "balls." in fragment or not fragment else PAPER.removeprefix("#view=play")
        self.page.goto(f"{self.address}{fragment}{first}")
        self.ready()
        if playback:
            self.page.locator("#film-more").evaluate("(one) => { one.open = true; }")
        return self.page

    def ready(self):
        """Wait until the page shows the result of the drop that it has."""
        self.page.wait_for_function(
            "() => state?.result && !state.busy"
            " && document.querySelector('#controls').children.length"
        )

    def state(self, path):
        return self.page.evaluate(f"() => state.{path}")

    def type(self, path, text):
        """Type a number of the drop into its field; return the field."""
        field = self.page.locator(f"#controls [data-path='{path}']")
        field.fill(text)
        field.press("Enter")
        return field

    def drop(self):
        return sb.Drop.from_mapping(self.state("drop"))

    def script_is_refused(self):
        """Return whether a script that somebody adds does nothing; the browser complains of it."""
        self.expected = "-src"  # Firefox tells of it late, as a message or as an error
        self.page.evaluate(
            """() => { const script = document.createElement('script');
                 script.textContent = 'window.hit = true'; document.body.append(script); }"""
        )
        self.complaints.clear()
        return self.page.evaluate("() => window.hit") is None

    def saved(self, act):
        """Return the content of the file that the page saves when something is done."""
        if self.page.context.browser.browser_type.name == "chromium":
            with self.page.expect_download() as saved:
                act()
            return saved.value.path().read_bytes()
        before = set(self.downloads.iterdir())  # Playwright is not told of what Firefox saves
        act()
        end = time.monotonic() + 30.0
        while time.monotonic() < end:
            self.page.wait_for_timeout(50)
            new = set(self.downloads.iterdir()) - before
            if len(new) == 1 and (content := min(new).read_bytes()):
                return content
        raise AssertionError("no file was saved")

    def foreign(self):
        inside = (self.address, "data:", "blob:")
        return [url for url in self.requests if not url.startswith(inside)]


@pytest.fixture
def visits(browser, address, downloads):
    """Open pages of their own settings; check at the end that none complained."""
    opened = []

    def visit(**settings):
        context = browser.new_context(**{"viewport": LAPTOP} | settings)
        context.set_default_timeout(60_000)
        opened.append(Visit(context.new_page(), address, downloads))
        return opened[-1]

    yield visit
    for one in opened:
        one.page.context.close()
    assert [one.complaints for one in opened] == [[]] * len(opened)
    assert [one.foreign() for one in opened] == [[]] * len(opened)


@pytest.fixture
def visit(visits):
    return visits()


@pytest.fixture
def page(visit):
    """Open the page as a laptop shows it, with its first drop."""
    return visit.open()
