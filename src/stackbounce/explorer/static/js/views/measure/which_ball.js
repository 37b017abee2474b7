/** The choice of one ball of the stack; of several none is guessed. */

import { choice } from "../../set_up/fields.js";
import { t } from "../../words/language.js";
import { ballName, capital } from "../../words/words.js";

/** Offer the choice in an element; returns `{ask(drop), ball()}`. The button that needs the choice is disabled without it. */
export function whichBall(element, label, key, button) {
  let chosen = "";
  const take = (value) => {
    chosen = value;
    button.disabled = value === "";
  };
  const ask = (drop) => {
    const { balls } = drop;
    const named = balls.map((_, ball) => [String(ball), capital(ballName(drop, ball))]);
    const isOne = balls.length === 1;
    take(isOne ? "0" : "");
    const entries = isOne ? named : [["", t("Choose a ball")], ...named];
    element.replaceChildren(choice({ label, key, groups: [["", entries]], value: chosen, set: take }));
  };
  return { ask, ball: () => Number(chosen) };
}
