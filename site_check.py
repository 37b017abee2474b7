"""Visit all of the site in Chromium, served and as files: ``make site``.

The exit status is 1 if there is a finding:

* a link to a page, a file or a place on a page that is not there, and a page that no link leads to
* a request to anywhere but the site's own folder, or one that failed; the site is served below a
  folder of the server, and opened from the disk, as from a stick
* an error or warning of the console
* a violation of what axe-core knows of WCAG and ARIA, on each page, wide and narrow, light and dark
* a page, or a part of one that does not scroll, wider than the window; a search that finds nothing
"""

import shutil
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from importlib.resources import files
from pathlib import Path
from urllib.parse import unquote, urldefrag

from playwright.sync_api import (
    Browser,
    ConsoleMessage,
    Request,
    Response,
    TimeoutError,  # noqa: A004 # playwright's own
    sync_playwright,
)

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
BELOW = "/a/folder/"
EXPLORER = "explorer.html"  # whose fragments are drops, not places
SEARCH = "search.html?q=tennis"
SEARCHED = 10_000  # ms; idle, one takes 200
INSIDE = ("data:", "blob:")
WIDE, NARROW = {"width": 1366, "height": 800}, {"width": 390, "height": 800}
COLORED = {  # a page of each kind, whose contrasts are measured: slow, and alike on all of a kind
    "index.html": "html",
    "notebooks/first-drop.html": "html",
    "lessons/gap.html": "html",
    "fit.html": "html",
    "api.html": "dl:has(> #stackbounce\\.Ball)",
    "explorer.html": "html",
    "genindex.html": "html",
}
AXE = (files("axe_playwright_python") / "axe.min.js").read_text("utf-8")
LINKS = """() => [...document.querySelectorAll("a[href], form[action]")]
  .filter((link) => !link.closest("[hidden]"))
  .map((link) => link.href ?? link.action)"""
PLACES = """() => [...document.querySelectorAll("[id], a[name]")]
  .flatMap(({ id, name }) => [id, name])"""
VIOLATIONS = """async ([part, rules]) => {
  // Until what follows the window's size has followed.
  await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
  const asked = { iframes: false, selectors: false, resultTypes: ["violations"], ...rules };
  const { violations } = await axe.run(part, asked);
  return violations.flatMap(
    ({ id, nodes }) => nodes.map(({ html }) => `${id}: ${html.slice(0, 120)}`),
  );
}"""
STRUCTURE = {"rules": {"color-contrast": {"enabled": False}}}
CONTRAST = {"runOnly": ["color-contrast"]}
SCROLLED = {"runOnly": ["scrollable-region-focusable"]}
WIDER = """() => {
  const html = document.documentElement;
  const scrolls = (part) => part.tagName !== "ARTICLE"
    && (/auto|scroll/.test(getComputedStyle(part).overflowX) || scrolls(part.parentElement));
  const isOut = (part) => part.getBoundingClientRect().right > innerWidth + 1 && !scrolls(part);
  return html.scrollWidth > html.clientWidth
    || [...document.querySelectorAll("article *")].some(isOut);
}"""


def main(folder: Path) -> int:
    """Check a folder, print what was found, and return the exit status."""
    folder = folder.resolve()
    browser_path = next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser_path is None:
        sys.stderr.write("The site is checked in Chromium (on Debian: apt install chromium)\n")
        return 1
    with serve(folder) as address, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=browser_path)
        served = Visit(browser, folder, address)
        served.visit_all(with_axe=True)
        from_disk = Visit(browser, folder, f"{folder.as_uri()}/")
        from_disk.visit_all(with_axe=False)
        browser.close()
    found = len(served.found) + len(from_disk.found)
    sys.stdout.write(f"{folder}: {len(served.places)} pages, {found} findings\n")
    return int(found > 0)


@contextmanager
def serve(folder: Path) -> Iterator[str]:
    """Serve a folder below the server's own; yield its address."""

    class Below(SimpleHTTPRequestHandler):
        def translate_path(self, path: str) -> str:
            inside = path.startswith(BELOW)
            return super().translate_path(path.removeprefix(BELOW)) if inside else ""

        def log_message(self, *_: object) -> None:
            pass

    def handler(*given: object) -> Below:
        return Below(*given, directory=str(folder))

    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        thread = threading.Thread(target=server.serve_forever, args=(0.05,))
        thread.start()
        yield f"http://127.0.0.1:{server.server_port}{BELOW}"
        server.shutdown()
        thread.join()


class Visit:
    """A visit of all pages below an address, and what was found."""

    def __init__(self, browser: Browser, folder: Path, address: str) -> None:
        self.folder, self.address, self.now = folder, address, ""
        self.found: list[str] = []
        self.places: dict[str, set[str]] = {}  # of each page: the names of its parts
        self.page = browser.new_context(bypass_csp=True, reduced_motion="reduce").new_page()
        self.page.on("console", self._hear)
        self.page.on("pageerror", lambda error: self._find(str(error)))
        self.page.on("request", self._request)
        self.page.on("requestfailed", lambda request: self._find(f"failed: {request.url}"))
        self.page.on("response", self._response)

    def visit_all(self, with_axe: bool) -> None:
        """Visit the page that opens and, of each page, all pages that it leads to; then search."""
        links: dict[str, set[str]] = {}
        left = {"index.html"}
        while left:
            name = min(left)
            links[name] = self._open(name)
            self.places[name] = set(self.page.evaluate(PLACES))
            if with_axe:
                self._look()
            pages = {urldefrag(link).url for link in links[name]}
            left |= {page for page in pages if page.endswith(".html") and self._is_there(page)}
            left -= links.keys()
        for self.now, given in links.items():
            for link in sorted(given):
                self._follow(link)
        self._open(SEARCH)
        try:
            self.page.locator("#search-results li a").first.wait_for(timeout=SEARCHED)
        except TimeoutError:
            self._find("finds nothing")
        for path in self.folder.rglob("*.html"):
            self.now = path.relative_to(self.folder).as_posix()
            if self.now not in links:
                self._find("no link leads to it")

    def _open(self, name: str) -> set[str]:
        """Open a page, and return the links that stay on the site, relative to it."""
        self.now = name
        self.page.goto(self.address + name, wait_until="load")
        inside = set()
        for link in self.page.evaluate(LINKS):
            if link.startswith(self.address):
                inside.add(unquote(link.removeprefix(self.address)))
            elif link.startswith(("file:", self.address.removesuffix(BELOW))):
                self._find(f"leads out of the folder: {link}")
        return inside

    def _is_there(self, name: str) -> bool:
        return (self.folder / name).is_file()

    def _follow(self, link: str) -> None:
        name, place = urldefrag(link)
        if not self._is_there(name):
            self._find(f"leads to {name}, which is not there")
        elif place and name != EXPLORER and place not in self.places.get(name, ()):
            self._find(f"leads to {link}, and there is no such place")

    def _look(self) -> None:
        self.page.evaluate(AXE)
        for size, rules in ((NARROW, SCROLLED), (WIDE, STRUCTURE)):
            self.page.set_viewport_size(size)
            self._violations(f"{size['width']} wide", "html", rules)
            if self.page.evaluate(WIDER):
                self._find(f"{size['width']} wide: is wider")
        for colors in ("dark", "light") if self.now in COLORED else ():
            self.page.emulate_media(color_scheme=colors)
            self._violations(colors, COLORED[self.now], CONTRAST)

    def _violations(self, how: str, part: str, rules: dict[str, object]) -> None:
        for violation in self.page.evaluate(VIOLATIONS, [part, rules]):
            self._find(f"{how}: {violation}")

    def _hear(self, message: ConsoleMessage) -> None:
        if message.type in ("error", "warning"):
            self._find(message.text)

    def _request(self, request: Request) -> None:
        if not request.url.startswith((self.address, *INSIDE)):
            self._find(f"asks for {request.url}")

    def _response(self, response: Response) -> None:
        if response.status >= 400:
            self._find(f"{response.status}: {response.url}")

    def _find(self, finding: str) -> None:
        if (text := f"{self.now}: {finding}\n") not in self.found:
            self.found.append(text)
            sys.stdout.write(text)
            sys.stdout.flush()


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))
