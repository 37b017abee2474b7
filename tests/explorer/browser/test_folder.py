"""The explorer as a folder on a web server: it plays, after a visit without a network too."""

from pathlib import Path

import pytest
from page_build import assembly
from page_build.build import build

import stackbounce as sb
from stackbounce.cli import main
from stackbounce.engine import native
from stackbounce.explorer import made
from stackbounce.files import write_folder

pytestmark = [pytest.mark.slow, pytest.mark.release]
FORMS = ("folder",)

KEPT = "() => navigator.serviceWorker.ready.then(() => caches.keys())"


@pytest.fixture
def folder(site):
    """Return the address of a folder with the explorer, further down on a server."""
    write_new(site.folder, made.folder_files())
    return f"http://127.0.0.1:{site.server_port}/class/explorer/"


def write_new(folder, files):
    place = folder / "class" / "explorer"
    place.mkdir(parents=True, exist_ok=True)
    write_folder(place, files)


def test_it_plays_without_a_network_after_a_visit(visit, page, site):
    assert "1.803" in page.locator("#numbers").inner_text()
    (kept,) = page.evaluate(KEPT)
    assert kept.startswith(f"stackbounce {visit.address} ")
    page.goto("about:blank")
    (site.folder / "class").rename(site.folder / "away")
    for address in ("", "index.html"):
        page.goto(f"{visit.address}{address}{visit.paper.replace('play', 'map')}")
        visit.ready()
        page.wait_for_function(
            "() => /largest/.test(document.querySelector('#map-summary')?.textContent)"
        )
        page.evaluate("() => store.set({ drop: { ...store.get().drop, impact_speed: 2.5 } })")
        page.wait_for_function("() => state.result.drop.impact_speed === 2.5")
        speeds = sb.simulate(visit.drop()).rebound_speeds
        assert visit.state("result.rebound_speeds") == speeds.tolist()
    assert visit.state("error") is None
    (site.folder / "away").rename(site.folder / "class")


def test_a_newer_version_takes_the_place_of_an_older_one(
    visit, page, site, in_firefox, tmp_path, monkeypatch
):
    (old,) = page.evaluate(KEPT)
    read, title = assembly.read_static, ("the explorer</title>", "newer</title>")
    monkeypatch.setattr(assembly, "read_static", lambda name: read(name).replace(*title))
    build(Path(native.FOLDER), tmp_path / "made")
    monkeypatch.setattr(made, "FOLDER", tmp_path / "made")
    write_new(site.folder, made.folder_files())
    page.reload()  # the page is still the older one, and the browser looks for a newer
    assert page.title() == "stackbounce: the explorer"
    # Without a window Chromium looks for it in its second minute, but at a new address at once.
    address = "offline.js" if in_firefox else "offline.js?newer"
    page.evaluate(
        """(address) => navigator.serviceWorker.register(address).then(async (found) => {
             while (!found.waiting) await new Promise((done) => setTimeout(done, 20)); })""",
        address,
    )
    other = page.context.new_page()
    page.close()
    other.wait_for_timeout(300)
    other.goto(visit.address)
    other.wait_for_function("() => document.title === 'stackbounce: newer'")
    (new,) = other.evaluate(KEPT)
    assert new != old


def test_nothing_in_it_has_an_absolute_address():
    for name, content in made.folder_files().items():
        if not name.endswith(".wasm"):
            text = content.decode().replace("http://www.w3.org/", "")
            assert "http://" not in text, name
            assert 'href="/' not in text


def test_its_policy_is_in_the_page(visit, page):
    policy = page.locator("meta[http-equiv]").get_attribute("content")
    assert policy.startswith("default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; ")
    assert "unsafe-inline" not in policy
    assert visit.script_is_refused()


def test_the_page_of_the_server_has_no_service_worker(visit, address_of_server):
    visit.address = address_of_server
    visit.open()
    assert visit.page.evaluate("() => navigator.serviceWorker.getRegistrations()") == []


def test_a_folder_that_is_opened_from_a_disk_says_what_it_needs(visit, tmp_path):
    write_new(tmp_path, made.folder_files())
    visit.address = (tmp_path / "class" / "explorer").as_uri()
    visit.page.goto(f"{visit.address}/index.html")
    told = visit.page.locator("#old")
    told.wait_for(state="visible")
    assert "opens from a web server only" in told.inner_text()
    assert visit.page.evaluate("() => window.stackbounce === undefined")
    visit.complaints.clear()  # it asks for files that a page from a disk must not read


def test_a_folder_is_written_whole_and_again(tmp_path, capsys):
    place = tmp_path / "new" / "explorer"
    for _ in range(2):
        assert main(["app", "--export", str(place)]) == 0
    assert capsys.readouterr().out.startswith(f"{place}: the explorer in 9 files, ")
    assert {str(Path(path).relative_to(place)) for path in place.rglob("*") if path.is_file()} == {
        *made.folder_files(),
        "stackbounce.sha256",
    }
