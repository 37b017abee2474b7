"""Random actions: whatever is pressed, chosen, typed or moved is drawn without an error."""

import pytest

pytestmark = [pytest.mark.slow, pytest.mark.release]
STEPS = 1000

ACT = """async ([seed, steps]) => {
  let state = seed;
  const chance = () => (state = (state * 48271) % 2147483647) / 2147483647;
  const any = (list) => list[Math.floor(chance() * list.length)];
  const texts = ["0", "-3", "1e6", "0.001", "5 g", "2", "100", "x", "", "3 mm", "1e12"];
  const send = (one, ...names) =>
    names.forEach((name) => one.dispatchEvent(new Event(name, { bubbles: true })));
  const act = (one) => {
    if (one.tagName === "SELECT") one.value = any([...one.options]).value;
    else if (one.type === "range") one.value = Number(one.min) + chance() * (one.max - one.min);
    else if (one.type === "text") one.value = any(texts);
    else one.click();
    if (!["BUTTON", "SUMMARY"].includes(one.tagName)) send(one, "input", "change");
  };
  const parts = "button, select, input, summary";
  for (let step = 0; step < steps; step += 1) {
    const where = any(["#controls", "#controls", "#transport", "#history", ".tabs"]);
    const all = [...document.querySelectorAll(`${where} :is(${parts})`)];
    const free = all.filter((one) => !one.disabled && one.checkVisibility());
    if (free.length) act(any(free));
    if (chance() < 0.2) clock.wind(chance() * clock.film.length);
    if (chance() < 0.3) await new Promise(requestAnimationFrame);
    const failed = window.stackbounce.store.get().error?.detail ?? "";
    if (failed.includes("cannot be drawn")) throw new Error(`${failed} in ${location.hash}`);
    if (step % 10) continue;
    const { innerHTML: shown } = document.querySelector("main");
    const nonsense = shown.match(/.{60}(NaN|undefined|Infinity).{20}/);
    if (nonsense) throw new Error(`${nonsense[0]} after step ${step} in ${location.hash}`);
  }
}"""


@pytest.mark.parametrize("seed", range(1, 6))
def test_random_actions_leave_no_error(visit, page, seed):
    page.evaluate(ACT, [seed, STEPS])
    page.get_by_role("button", name="Reset", exact=True).click()
    visit.ready()
    assert visit.state("error") is None  # of what was typed last
