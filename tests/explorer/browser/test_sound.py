"""The sound of a drop: a knock at the begin of each contact, while the film plays."""

import shutil

import numpy as np
import pytest
from playwright.sync_api import sync_playwright
from scipy.io import wavfile

import stackbounce as sb
from stackbounce.measure import bounces, knocks
from synthetic.falls import falls
from synthetic.sound import sound

pytestmark = [pytest.mark.slow, pytest.mark.release]
FORMS = ("served",)

STUB = """
window.contexts = 0;
window.knocks = [];
class Node {
  constructor(context, { frequency, gain }) {
    Object.assign(this, { frequency });
    this.gain = { value: gain, setValueAtTime() {}, exponentialRampToValueAtTime() {} };
  }
  connect(other) { this.to = other; return other; }
  start() {
    const { reel } = stackbounce.clock;
    knocks.push({ reel, pitch: this.frequency, gain: this.to.gain.value });
  }
  stop() {}
}
window.OscillatorNode = window.GainNode = Node;
window.AudioContext = class { constructor() { contexts += 1; this.currentTime = 0; } resume() {} };
"""
PLAYED = "() => clock.reel >= clock.film.length"
BEGINS = """() => state.result.intervals.map(({ start, end, peak_force }) =>
  ({ reel: clock.film.toFilm(start), force: peak_force, lasts: end - start }))"""
FRAME = 0.1 * 4  # s of film, at most: the longest frame at this speed


@pytest.fixture
def page(visit):
    visit.page.add_init_script(STUB)
    return visit.open("#speed=4")


def replay(page):
    page.get_by_role("button", name="Replay").click()
    page.wait_for_function(PLAYED)


def test_each_contact_knocks_once_at_its_moment_of_the_film(page, visit):
    replay(page)
    assert page.evaluate("() => [contexts, knocks.length]") == [0, 0]  # it is off by default
    page.get_by_label("Sound").check()
    replay(page)
    knocks, begins = page.evaluate("() => knocks"), page.evaluate(BEGINS)
    assert page.evaluate("() => contexts") == 1
    assert len(knocks) == len(begins) > 1
    for knock, begin in zip(knocks, sorted(begins, key=lambda one: one["reel"]), strict=True):
        assert 0.0 <= knock["reel"] - begin["reel"] <= FRAME
        assert knock["pitch"] == pytest.approx(min(max(1 / begin["lasts"], 90), 4000))
    loud = max(zip(knocks, begins, strict=True), key=lambda pair: pair[0]["gain"])[1]
    assert loud["force"] == max(one["force"] for one in begins)
    page.wait_for_function("() => location.hash.includes('sound=1')")
    page.get_by_role("button", name="Previous event").click()
    assert page.evaluate("() => knocks.length") == len(knocks)  # a step is silent
    assert visit.complaints == []


# --- A bounce recorded in the page: from a microphone that plays a file, to the results
RATE = 44_100
RESTITUTION = 0.75
NOISE = 0.02


@pytest.fixture(scope="module")
def browser(request, tmp_path_factory):
    """Start Chromium with a microphone that hears a ball bounce, and that asks nobody."""
    path = shutil.which("chromium")
    if request.param != "chromium" or path is None:
        pytest.skip("only Chromium has a microphone that plays a file")
    heard = tmp_path_factory.mktemp("microphone") / "bounces.wav"
    recording = sound(falls(0.2, lambda _: RESTITUTION, bounces=6), noise=NOISE, seed=1, rate=RATE)
    quiet = np.random.default_rng(2).normal(0.0, NOISE, 5 * RATE)  # after it, as in a room
    samples = np.concatenate([recording.sound.values, quiet])
    wavfile.write(heard, RATE, (samples / np.abs(samples).max() * 20_000).astype("<i2"))
    options = [f"--use-fake-{name}-for-media-stream" for name in ("device", "ui")]
    options += [f"--use-file-for-fake-audio-capture={heard}%noloop"]
    with sync_playwright() as playwright:
        started = playwright.chromium.launch(executable_path=path, args=options)
        yield started
        started.close()


def test_a_recorded_bounce_is_measured_and_can_be_saved(visit, tmp_path):
    page = visit.open("#view=measure")
    page.get_by_role("button", name="Record a bounce").click()
    page.get_by_role("meter", name="Loudness").wait_for()
    page.wait_for_timeout(2200)
    page.get_by_role("button", name="Stop").click()
    page.locator(".recognised button").wait_for()
    file = tmp_path / "recording.wav"
    save = page.get_by_role("button", name="Save the recording")
    file.write_bytes(visit.saved(save.click))
    found = bounces(knocks(sb.read(file))).restitutions
    assert len(found) >= 3
    assert np.median([one.nominal_value for one in found]) == pytest.approx(RESTITUTION, abs=0.01)
    assert "sound" in page.locator(".recognised").inner_text()


def test_where_there_is_no_microphone_it_says_why(visit):
    page = visit.page
    page.add_init_script("Object.defineProperty(window, 'isSecureContext', { value: false })")
    visit.open("#view=measure")
    page.get_by_text("browsers give the microphone only to").wait_for()
    assert page.get_by_role("button", name="Record a bounce").count() == 0


def test_a_microphone_that_is_refused_is_told(visit):
    page = visit.page
    page.add_init_script(
        """navigator.mediaDevices.getUserMedia = () =>
             Promise.reject(new DOMException('no', 'NotAllowedError'))"""
    )
    visit.open("#view=measure")
    record = page.get_by_role("button", name="Record a bounce")
    record.click()
    page.get_by_text("does not let this page use the microphone").wait_for()
    assert record.is_enabled()
