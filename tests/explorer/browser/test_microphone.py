"""A bounce recorded in the page: from a microphone that plays a file, to the results."""

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
