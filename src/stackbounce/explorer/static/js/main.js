/** The explorer: assembles the parts of the page. */

import * as address from "./state/address.js";
import * as api from "./asking/api.js";
import { mountLooks } from "./stage/looks.js";
import { Clock } from "./stage/clock.js";
import { mountControls } from "./set_up/controls.js";
import { button, h } from "./dom.js";
import { takeFiles } from "./views/measure/dropped.js";
import { mountEmbed } from "./embed.js";
import { onFailure } from "./failure.js";
import { direct } from "./stage/director.js";
import { mountFullScreen } from "./stage/full_screen.js";
import { mountGuess } from "./stage/guess.js";
import { mountHands } from "./stage/hands.js";
import { mountHistory } from "./state/history.js";
import { t, translated, translatePage, writeTold } from "./words/language.js";
import { mountLanguage } from "./words/language_view.js";
import { mountLessons } from "./lessons/lessons.js";
import { mount as mountLine } from "./views/line/line.js";
import { mount as mountMap } from "./views/map/map.js";
import { mount as mountMeasure } from "./views/measure/measure.js";
import { mountMomentum } from "./stage/momentum.js";
import { mountNumbers } from "./views/numbers.js";
import { mount as mountPaper } from "./views/paper.js";
import { hasServer } from "./origin/web.js";
import { mountPlots } from "./plots/plots.js";
import { carryErrors } from "./asking/prediction.js";
import { retry } from "./asking/retry.js";
import { run } from "./asking/runner.js";
import { mountSentence } from "./words/sentence.js";
import { mountShare } from "./state/share.js";
import { mountSound } from "./stage/sound.js";
import { mountStage } from "./stage/stage.js";
import { markStale } from "./asking/stale.js";
import { createStore } from "./state/store.js";
import { mountTabs } from "./views/tabs.js";
import { mountTransport } from "./stage/transport.js";

const place = (id) => document.getElementById(id);
const LATE = 5000; // ms, after which the page is shown without its first drop
const reduced = matchMedia("(prefers-reduced-motion: reduce)");

const store = createStore(address.read());
const clock = new Clock(() => reduced.matches);
window.stackbounce = { store, clock };
onFailure(({ message }) => {
  clock.pause();
  if (!store.get().error) store.set({ error: { detail: t("This drop cannot be drawn: {reason}", { reason: message }) } });
});
if (typeof WebAssembly === "object" && typeof Worker === "function") place("old").remove();

translatePage();
address.follow(store);
mountLooks(store);
const runner = run(store, api);
carryErrors(store, api);
takeFiles(store);
direct(store, clock, () => reduced.matches);
mountStage(place("stage"), store, clock, mountGuess(place("stage"), store, clock));
mountMomentum(place("momentum"), store, clock);
mountSound(store, clock);
mountSentence(place("sentence"), place("live"), store);
mountTransport(place("transport"), store, clock);
mountPlots(place("plots"), store, clock);
mountNumbers({ root: place("numbers"), table: place("intervals") }, store);
mountShare(place("share"), store, api);
mountLanguage(place("language"), store);
mountHistory(place("history"), store);
mountHands(place("stage"), store, clock, api);
mountEmbed(place("transport"), store);
mountFullScreen(place("play"), place("stage"));
const giveLessons = mountLessons({ root: place("lesson"), button: place("lessons-open") }, store);
mountTabs(store, {
  line: (section) => open(mountLine, section),
  map: (section) => open(mountMap, section),
  measure: (section) => open(mountMeasure, section),
  paper: (section) => open(mountPaper, section),
});
place("closer").addEventListener("click", () => {
  store.set({ closer: true, predict: false });
  place("stage-box").focus(); // the button is gone
});
const showWhole = ({ closer }) => document.body.classList.toggle("first", !closer);
store.watch(["closer"], showWhole);
store.derive(({ error, closer }) => (error && !error.offline && !closer ? { closer: true } : null)); // where it is told
showWhole(store.get());
store.watch(["view"], () => placeSetUp());
place("skip").addEventListener("click", (event) => {
  event.preventDefault(); // the fragment holds the state
  place("stage-box").focus();
});
store.watch(["view"], ({ view }) => view !== "play" && clock.pause());
const show = () => document.querySelectorAll(".starting").forEach((part) => part.classList.remove("starting"));
setTimeout(show, LATE);
const endShow = store.subscribe(({ result, error }) => {
  if (!result && !error) return;
  endShow();
  show();
});
const end = store.subscribe(({ result }) => {
  if (!result) return;
  end();
  window.stackbounce.whole = api.prepare(result.drop); // from here on nothing is loaded
});
addEventListener("beforeprint", () => (place("intervals").closest("details").open = true));
showBanner();
markStale(store, document.body);
const catalogueAgain = loadCatalogue();

/** Build a view when it is first opened; where that fails, say so and offer to show the page anew. */
async function open(mount, section) {
  try {
    await mount(section, store, api, clock);
    placeSetUp();
  } catch (error) {
    const reason = translated(error.message);
    const said = h("p", { class: "field-error", role: "alert", text: t("This view could not be opened yet: {reason}", { reason }) });
    section.append(h("div", { class: "unopened" }, said, button(t("Try again"), () => location.reload(), { class: "small" })));
  }
}

/** Move the set-up, which is one form, to the view that is shown, if that has a place for it. */
function placeSetUp() {
  const there = place(store.get().view).querySelector(".set-up-place");
  const form = place("controls");
  if (there && form.parentElement !== there) there.append(form);
}

for (const part of document.querySelectorAll("[data-home]")) part.hidden = (part.dataset.home === "server") !== hasServer;

/** The controls need the catalogue; until it is loaded there are none. Returns what tries at once. */
function loadCatalogue() {
  return retry(
    async () => {
      const known = await api.catalogue();
      mountControls(place("controls"), store, api, known);
      giveLessons(known.lessons);
      if (store.get().error?.offline) runner.again();
    },
    ({ message }) => store.set({ error: { detail: message, offline: true } }),
  );
}

/** Report that the server does not answer, and offer to try again. */
function showBanner() {
  const text = place("banner-text");
  place("banner-again").addEventListener("click", () => {
    store.set({ error: null });
    if (!place("controls").hasChildNodes()) catalogueAgain();
    runner.again();
  });
  const show = ({ error, busy }) => {
    place("banner").hidden = !error?.offline;
    writeTold(text, error?.offline ? error.detail : "");
    document.body.classList.toggle("busy", busy);
  };
  store.subscribe(show);
  show(store.get());
}
