/** The choice of one ball of the stack; of several none is guessed. */

import { h } from "../../dom.js";
import { choice } from "../../set_up/fields.js";
import { t } from "../../words/language.js";
import { ballName, capital } from "../../words/words.js";

/** Return `{element, ask(drop), ball()}`; the button that needs the choice is disabled without it. */
export function whichBall(label, key, button) {
  const element = h("div");
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
  return { element, ask, ball: () => Number(chosen) };
}
