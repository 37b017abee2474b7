/** "Use this as a ball's bounce": what a file tells of one ball goes into that ball's contact. */

import { partsOf, write } from "../../dom.js";
import { withValue } from "../../set_up/drops.js";
import { sayProblem } from "../../set_up/fields.js";
import { t, translated } from "../../words/language.js";
import { asBounced } from "../../set_up/laws.js";
import { ballName, capital, contactName, formatMeasured, lawName } from "../../words/words.js";
import { whichBall } from "./fit_choices.js";

/** Return `{offer(answer), follow()}` of the card in `root`: `offer` takes the answer to a file, or null. */
export function bounceUse(root, store, api) {
  const { says, which: place, use, see, status, problem } = partsOf(root);
  const which = whichBall(place, t("Which ball bounced?"), "bounced", use);
  let answer = null;
  let names = "";
  const namesOf = (drop) => JSON.stringify(drop.balls.map((_, ball) => ballName(drop, ball)));

  const offer = (next) => {
    answer = next?.bounce ? next : null;
    root.hidden = !answer;
    see.hidden = true;
    sayProblem(problem);
    write(status, "");
    if (!answer) return;
    write(says, known(answer));
    offerBalls();
  };
  const offerBalls = () => {
    const { drop } = store.get();
    names = namesOf(drop);
    which.ask(drop);
  };
  const follow = () => {
    if (answer && names !== namesOf(store.get().drop)) offerBalls();
  };
  const apply = async () => {
    sayProblem(problem);
    write(status, "");
    const ball = which.ball();
    const { drop } = store.get();
    try {
      const contact = await asBounced(api, await api.catalogue(), drop, ball, answer.bounce);
      const notes = [];
      notes[ball] = source(answer.file, ball);
      store.set({ drop: withValue(drop, `contacts.${ball}`, contact), notes });
      const values = { contact: capital(contactName(drop, ball)), law: lawInWords(contact) };
      write(status, `${t("{contact} is set: {law}.", values)} ${ball > 0 ? ALONE : ""}`.trim());
      see.hidden = false;
    } catch (error) {
      sayProblem(problem, error.message);
    }
  };
  use.addEventListener("click", apply);
  see.addEventListener("click", () => store.set({ view: "play", t: null, replay: store.get().replay + 1 }));
  return { offer, follow };
}

const ALONE = t("It is the bounce of this ball alone: that the ball below gives way, too, is left out.");

function source(file, ball) {
  return `${t("As measured: {file}.", { file })} ${ball > 0 ? ALONE : ""}`.trim();
}

/** Return what a file tells of a bounce, as a sentence. */
function known({ file, bounce }) {
  const { restitution, contact_time: time, impact_speed: speed, contact } = bounce;
  if (contact) {
    const values = { file, law: lawInWords(contact) };
    return t("{file} tells how stiff a ball is when it is pressed slowly: {law}. In a bounce a ball is often stiffer.", values);
  }
  const parts = [
    restitution === null ? null : t("a restitution of {value}", { value: formatMeasured(restitution, null, "") }),
    time === null ? null : t("a contact time of {value}", { value: formatMeasured(time, null, "s") }),
    speed === null ? null : t("an impact speed of {value}", { value: formatMeasured(speed, null, "m/s") }),
  ];
  const values = { file, numbers: parts.filter(Boolean).join(", ") };
  return t("{file} gives {numbers}. If one ball bounced alone on the floor, this can be its bounce in the stack.", values);
}

function lawInWords({ law, ...numbers }) {
  const units = { stiffness: numbers.exponent === undefined || numbers.exponent === 1 ? "N/m" : "" };
  const parts = Object.entries(numbers)
    .filter(([, value]) => typeof value === "number")
    .map(([name, value]) => `${translated(name.replaceAll("_", " "))} ${formatMeasured(value, null, units[name] ?? "")}`);
  return `${lawName(law)}, ${parts.join(", ")}`;
}
