"""Fifty users of one server: all load the page at once, play, and then ask it for nothing."""

import asyncio
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from urllib.parse import urlsplit

import httpx
import numpy as np
import pytest

pytestmark = [pytest.mark.slow, pytest.mark.release]
FORMS = ("served",)

USERS = 50
PAGES = 3  # of the users have a browser, the others load what it loads
TOGETHER = 6  # connections of a browser to one server


async def load(address, paths, number):
    """Load files as a browser does; return the time in s, the status and the size of each."""
    # each user of a class has an address; on Linux 127.0.1.1, 127.0.1.2 and so on are this machine
    own = f"127.0.1.{number}" if sys.platform == "linux" else None
    limits = httpx.Limits(max_connections=TOGETHER)
    transport = httpx.AsyncHTTPTransport(local_address=own, limits=limits)
    async with httpx.AsyncClient(base_url=address, transport=transport, timeout=60.0) as client:

        async def get(path):
            begin = time.perf_counter()
            answer = await client.get(path)
            return time.perf_counter() - begin, answer.status_code, len(answer.content)

        first = await get(paths[0])
        return [first, *await asyncio.gather(*(get(path) for path in paths[1:]))]


async def load_all(address, paths, users):
    return await asyncio.gather(*(load(address, paths, 1 + user) for user in range(users)))


def whole(visit):
    visit.page.wait_for_function("() => window.stackbounce?.whole")
    visit.page.evaluate("() => whole.then(() => null)")
    visit.page.wait_for_load_state("networkidle")


def play(visit):
    """Play another law, drag a slider, and look at a map."""
    page = visit.page
    page.locator("[data-key=law-0]").select_option("Hysteretic")
    page.wait_for_function("() => state.result.drop.contacts[0].law === 'Hysteretic'")
    slider = page.locator('[data-slider="balls.0.mass"]')
    slider.focus()
    for _ in range(10):
        page.keyboard.press("ArrowRight")
    visit.ready()
    page.locator("#tab-map").click()
    page.wait_for_function(
        "() => /largest/.test(document.querySelector('#map-summary')?.textContent)"
    )
    assert visit.state("error") is None


def test_fifty_users_load_the_page_and_ask_for_nothing_more(visits, address):
    opened = [visits() for _ in range(PAGES)]
    first, *others = opened
    first.open()
    whole(first)
    paths = [urlsplit(url).path for url in first.requests]
    assert paths[0] == "/"
    assert {"/made/engine.wasm", "/js/engine/worker.js", "/js/views/map/map.js"} <= set(paths)

    with ThreadPoolExecutor(1) as beside:  # Playwright has an event loop of its own in this thread
        loading = beside.submit(asyncio.run, load_all(address, paths, USERS - PAGES))
        for visit in others:
            visit.open()
            whole(visit)
        seen = np.array(loading.result())
    times, statuses, sizes = np.moveaxis(seen, 2, 0)
    assert (statuses == 200).all()
    assert (sizes == sizes[0]).all()
    assert (sizes > 0).all()
    # Kept to be looked at: no test depends on how fast this machine is.
    median, late, longest = 1e3 * np.quantile(times, (0.5, 0.95, 1.0))
    visit.note(
        "class",
        f"{USERS} users, {len(paths)} requests and {sizes[0].sum() / 1e3:.0f} kB each: an answer "
        f"takes {median:.0f} ms at the median, 95 % {late:.0f} ms, at most {longest:.0f} ms",
    )
    before = [list(visit.requests) for visit in opened]
    for visit in opened:
        play(visit)
    assert [visit.requests[len(old) :] for visit, old in zip(opened, before, strict=True)] == (
        [[]] * PAGES
    )
