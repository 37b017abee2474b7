"""The sound of a drop: a knock at the beginning of each contact, while the film plays."""

import pytest

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
        assert knock["pitch"] == pytest.approx(min(max(4 / begin["lasts"], 330), 6000))
    loud = max(zip(knocks, begins, strict=True), key=lambda pair: pair[0]["gain"])[1]
    assert loud["force"] == max(one["force"] for one in begins)
    page.wait_for_function("() => location.hash.includes('sound=1')")
    page.get_by_role("button", name="Previous event").click()
    assert page.evaluate("() => knocks.length") == len(knocks)  # a step is silent
    assert visit.complaints == []
