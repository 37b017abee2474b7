/** The sentence at the head of the play view, and the same for screen readers. */

import { partsOf, put, write } from "../dom.js";
import { t } from "./language.js";
import { called, storyOf } from "./sentence.js";
import { metres } from "./words.js";

const SETTLED = 700; // ms without a new result before it is said

/** Write what happened into `root`, and into `live`; before a guess, the question. */
export function mountSentence(root, live, store) {
  const { lead, more } = partsOf(root);
  let timer = 0;
  const show = () => {
    const { result, until, predict, guess } = store.get();
    if (!result) return;
    const asked = predict && until === null;
    const said = asked && guess === null ? question(result) : storyOf(result, until);
    const about = asked && guess !== null ? `${judged(result, guess)} ` : "";
    write(lead, said.lead);
    write(more, `${about}${said.more}`);
    put(root, "class", asked && guess === null ? "sentence asks" : "sentence");
    clearTimeout(timer);
    timer = setTimeout(() => write(live, `${said.lead} ${about}${said.more}`), SETTLED);
  };
  store.watch(["result", "predict", "guess"], show);
}

function question({ drop }) {
  const name = called(drop, drop.balls.length - 1);
  return { lead: t("How high will {ball} fly?", { ball: name }), more: t("Drag the mark on the ruler to where you think it goes, then let the balls go.") };
}

/** Return how far off a guess in m was. */
function judged(result, guess) {
  const { drop, rebound_heights: heights } = result;
  const top = drop.balls.length - 1;
  const reached = Math.max(0, heights[top] ?? 0);
  const off = guess - reached;
  const values = { guess: metres(guess), ball: called(drop, top), height: metres(reached), apart: metres(Math.abs(off)) };
  if (Math.abs(off) < 0.005) return t("You thought {guess}; {ball} rises {height}: just there.", values);
  if (off > 0) return t("You thought {guess}; {ball} rises {height}: {apart} too high.", values);
  return t("You thought {guess}; {ball} rises {height}: {apart} too low.", values);
}
