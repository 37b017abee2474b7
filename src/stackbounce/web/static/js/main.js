/** The explorer: assembles the parts of the page. */

import * as address from "./address.js";
import * as api from "./api.js";
import { mountLooks } from "./ball_looks.js";
import { Clock } from "./clock.js";
import { mountControls } from "./controls.js";
import { h, hide, write } from "./dom.js";
import { takeFiles } from "./dropped.js";
import { mountEmbed } from "./embed.js";
import { direct } from "./film_director.js";
import { mountFullScreen } from "./full_screen.js";
import { mountGuess } from "./guess.js";
import { mountHands } from "./hands.js";
import { mountHistory } from "./history.js";
import { t, translated, translatePage, writeTold } from "./language.js";
import { mountLanguage } from "./language_view.js";
import { mountLessons } from "./lessons.js";
import { mountMomentum } from "./momentum.js";
import { mountNumbers } from "./numbers.js";
import { hasServer, loadMeasure } from "./origin/served.js";
import { mountPlots } from "./plots.js";
import { carryErrors } from "./prediction.js";
import { retry } from "./retry.js";
import { run } from "./runner.js";
import { mountSentence } from "./sentence_view.js";
import { mountShare } from "./share.js";
import { mountSound } from "./sound.js";
import { mountStage } from "./stage.js";
import { markStale } from "./stale.js";
import { createStore } from "./store.js";
import { mountTabs } from "./tabs.js";
import { mountTransport } from "./transport.js";

const place = (id) => document.getElementById(id);
const LATE = 5000; // ms, after which the page is shown without its first drop
const reduced = matchMedia("(prefers-reduced-motion: reduce)");

const store = createStore(address.read(location.hash));
const clock = new Clock(() => reduced.matches);
window.stackbounce = { store, clock };
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
const loadLine = () => import("./line.js");
const loadMap = () => import("./map.js");
mountTabs(store, {
  line: (section) => open(loadLine, section),
  map: (section) => open(loadMap, section),
  measure: (section) => (loadMeasure ? open(loadMeasure, section) : explain(section)),
});
store.subscribe((state, before) => state.view !== before.view && placeSetUp());
place("skip").addEventListener("click", (event) => {
  event.preventDefault(); // the fragment holds the state
  place("stage-box").focus();
});
store.subscribe((state, before) => state.view !== before.view && state.view !== "play" && clock.pause());
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
  const views = [loadLine, loadMap].map((load) => load().catch(() => null)); // what fails is tried again when it is opened
  window.stackbounce.whole = Promise.all([api.prepare(result.drop), ...views]); // from here on nothing is loaded
});
addEventListener("beforeprint", () => (place("intervals").closest("details").open = true));
showBanner();
markStale(store, document.body);
const catalogueAgain = loadCatalogue();

/** Build a view from its own module when it is first opened; while that fails, say so and try again. */
function open(load, section) {
  const said = h("p", { class: "field-error", role: "alert" });
  const button = h("button", { type: "button", class: "small", text: t("Try again"), onclick: () => again() });
  const unopened = h("div", { class: "unopened", hidden: true }, said, button);
  section.append(unopened);
  const again = retry(
    async () => {
      const { mount } = await loaded(load);
      await mount(section, store, api, clock);
      unopened.remove();
      placeSetUp();
    },
    (error) => {
      unopened.hidden = false;
      write(said, t("This view could not be opened yet: {reason}", { reason: translated(error.message) }));
    },
  );
}

/** Return a module; a browser that keeps in mind that it could not be loaded is shown the page anew. */
async function loaded(load) {
  try {
    return await load();
  } catch {
    const { ok } = await fetch("icon.svg", { cache: "no-store" }).catch(() => ({ ok: false }));
    if (!ok) throw new Error(t("The server does not answer."));
    return load().catch((error) => {
      const [{ type }] = performance.getEntriesByType("navigation");
      if (type !== "reload") location.reload(); // the address holds what is shown
      throw error;
    });
  }
}

/** Move the set-up, which is one form, to the view that is shown, if that has a place for it. */
function placeSetUp() {
  const there = place(store.get().view).querySelector(".set-up-place");
  const form = place("controls");
  if (there && form.parentElement !== there) there.append(form);
}

/** Say what cannot be done without stackbounce itself. */
function explain(section) {
  section.append(
    h(
      "div",
      { class: "prose" },
      h("h2", { text: t("Measure and fit") }),
      h("p", {
        text: t(
          "Reading a measurement and fitting a drop to it need stackbounce itself: install it as its documentation says, and start “stackbounce app”, which opens this page with both.",
        ),
      }),
    ),
  );
}

for (const one of document.querySelectorAll("[data-home]")) one.hidden = (one.dataset.home === "server") !== hasServer;

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
    hide(place("banner"), !error?.offline);
    writeTold(text, error?.offline ? error.detail : "");
    document.body.classList.toggle("busy", busy);
  };
  store.subscribe(show);
  show(store.get());
}
