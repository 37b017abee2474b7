/** "Use this as a ball's bounce": what a file tells of one ball goes into that ball's contact. */

import { button, h, write } from "../../dom.js";
import { withValue } from "../../set_up/drops.js";
import { problemLine } from "../../set_up/fields.js";
import { t, translated } from "../../words/language.js";
import { asBounced } from "../../set_up/laws.js";
import { formatMeasured } from "../../words/quantity.js";
import { ballName, capital, contactName, lawName } from "../../words/words.js";
import { whichBall } from "./which_ball.js";

/** Return `{element, offer(answer), follow()}`: `offer` takes the answer to a file, or null. */
export function bounceUse(store, api) {
  const says = h("p");
  const status = h("p", { class: "note", role: "status" });
  const problem = problemLine();
  const use = button(t("Use this as the ball’s bounce"), () => apply(), { class: "primary" });
  const see = button(t("See it in Play"), () => store.set({ view: "play", t: null, replay: store.get().replay + 1 }), { hidden: true });
  const which = whichBall(t("Which ball bounced?"), "bounced", use);
  const element = h(
    "section",
    { class: "measure-card bounce-use", "aria-labelledby": "bounce-title", hidden: true },
    h("h2", { id: "bounce-title", text: t("Put it into the stack") }),
    says,
    which.element,
    h("div", { class: "fit-buttons" }, use, see),
    status,
    problem.element,
  );
  let answer = null;
  let names = "";
  const namesOf = (drop) => JSON.stringify(drop.balls.map((_, ball) => ballName(drop, ball)));

  const offer = (next) => {
    answer = next?.bounce ? next : null;
    element.hidden = !answer;
    see.hidden = true;
    problem.show();
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
    problem.show();
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
      problem.show(error.message);
    }
  };
  return { element, offer, follow };
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
