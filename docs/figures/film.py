"""The film of README, docs/_static/film.gif: a basketball and a tennis ball in the explorer.

``python docs/figures/film.py`` makes it anew, in the environment of ``make venv`` and with Chromium
(``tests/explorer/browser/browsers.sh`` finds or installs it). Texts have the font of the machine.
"""

import io
import math
import shutil
from pathlib import Path
from tempfile import TemporaryDirectory

from PIL import Image
from playwright.sync_api import sync_playwright

from stackbounce.cli import main

FILM = Path(__file__).parents[1] / "_static" / "film.gif"
VIEW = {"width": 640, "height": 570}  # px
FRAME = 80  # ms, of each picture
REST = 900  # ms, of the last one
COLORS = Image.Quantize.MAXCOVERAGE  # others lose white and the arrows' green
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
PRESSED = ".full-screen, .guess, .guess-go, .sentence-more"  # in a film nothing is pressed
READY = "() => window.stackbounce?.store.get().result && !window.stackbounce.store.get().busy"
SHOW = """(time) => {
  window.stackbounce.clock.pause();
  window.stackbounce.clock.wind(time);
  return new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
}"""


def shoot(page):
    """Return the film's pictures, of sentence and stage."""
    page.wait_for_function(READY)
    page.evaluate("() => window.stackbounce.whole")
    page.evaluate(f"() => document.querySelectorAll('{PRESSED}').forEach((one) => one.remove())")
    stage = page.locator("#stage").bounding_box()
    clip = {"x": 0, "y": 0, "width": VIEW["width"], "height": stage["y"] + stage["height"] + 1}
    length = page.evaluate("() => window.stackbounce.clock.film.length")
    for count in range(math.ceil(1e3 * length / FRAME) + 1):
        page.evaluate(SHOW, 1e-3 * FRAME * count)
        yield Image.open(io.BytesIO(page.screenshot(clip=clip))).convert("RGB")


def write(pictures):
    """Write pictures to the film, in colours that all of them share."""
    width, height = pictures[0].size
    some = pictures[:: len(pictures) // 8]
    strip = Image.new("RGB", (width, height * len(some)))
    for place, picture in enumerate(some):
        strip.paste(picture, (0, height * place))
    palette = strip.quantize(method=COLORS)
    first, *rest = (one.quantize(palette=palette, dither=Image.Dither.NONE) for one in pictures)
    lasts = [FRAME] * len(rest) + [REST]
    first.save(FILM, save_all=True, append_images=rest, duration=lasts, loop=0, optimize=True)


with TemporaryDirectory() as folder, sync_playwright() as playwright:
    explorer = Path(folder) / "explorer.html"
    main(["app", "--export", str(explorer)])
    path = next(filter(None, map(shutil.which, BROWSERS)))
    browser = playwright.chromium.launch(executable_path=path)
    page = browser.new_page(viewport=VIEW)
    page.goto(f"{explorer.as_uri()}?embed")
    write(list(shoot(page)))
    browser.close()
