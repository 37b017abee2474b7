/** The results: speeds, ratios, heights, collisions and energy, beside those of separate collisions. */

import { h, partsOf, write } from "../dom.js";
import { GRAVITY, speedOf } from "../set_up/drops.js";
import { t, translated } from "../words/language.js";
import { ENDED } from "../words/sentence.js";
import { ballName, capital, contactName, count, fixed, format, highest, percent, setUp, shortContact, withSpread } from "../words/words.js";

/** Write the numbers into `root`, and the contact intervals into `table`. */
export function mountNumbers({ root, table }, store) {
  const box = table.closest("details");
  const showIntervals = () => {
    const { result } = store.get();
    if (result && box.open) showRows(partsOf(table), result);
  };
  box.addEventListener("toggle", showIntervals);
  const show = () => {
    const { result, until, prediction, kept } = store.get();
    if (!result) return;
    const compared = kept && until === null ? [h("h3", { class: "kept-title", text: t("Kept to compare") }), ballTable(kept, null, null)] : [];
    root.replaceChildren(ballTable(result, until, prediction), facts(result, until, prediction), ...compared);
    showIntervals();
  };
  store.watch(["result", "prediction", "kept"], show);
}

function row(name, index, ...cells) {
  const swatch = h("span", { class: "swatch", "aria-hidden": "true", "--ball": `var(--ball-${index % 6})` });
  return h("tr", {}, h("th", { scope: "row" }, swatch, name), cells.map((cell) => h("td", {}, cell)));
}

/** Return the separate collisions' numbers, where there are any. */
function textbook({ separate }) {
  return separate && !separate.error ? known(separate) : null;
}

/** Return an outcome without the numbers that nobody knows: those after an impact that was not followed to its end. */
function known(outcome) {
  if (ENDED.includes(outcome.status)) return outcome;
  return { ...outcome, rebound_speeds: [], rebound_ratios: [], rebound_heights: [], energy_retained: null };
}

/** The table of the balls, the highest first, as they lie. */
function ballTable(result, until, prediction) {
  const { drop } = result;
  const separate = prediction?.values ? null : textbook(result); // there is no room for both
  const own = until === null ? impactColumns(result, known(result), prediction) : wholeColumns(result, result.frames.position);
  const theirs = separate && (until === null ? impactColumns(result, separate, null, false).slice(1) : wholeColumns(result, separate.position));
  const all = [...own, ...(theirs ?? [])];
  const when = until === null ? t("After the impact") : t("Within {time} s", { time: format(until) });
  const groups = [h("td"), h("th", { scope: "colgroup", colspan: own.length, text: when })];
  if (theirs) groups.push(h("th", { scope: "colgroup", colspan: theirs.length, text: t("Textbook") }));
  const rows = drop.balls.map((_, ball) => row(ballName(drop, ball), ball, ...all.map(({ cell }) => cell(ball))));
  return h(
    "table",
    { class: until === null ? "numbers-table" : "numbers-table whole" },
    h("caption", { class: "quiet", text: t("Speeds and heights of the balls, the highest ball first") }),
    h("thead", {}, h("tr", { class: "groups" }, groups), h("tr", {}, [t("Ball"), ...all.map(({ name }) => name)].map((name) => h("th", { scope: "col" }, name)))),
    h("tbody", {}, rows.reverse()),
  );
}

/** The columns of an impact, of the drop itself or of its separate collisions; `fall`: with heights in terms of the fall. */
function impactColumns({ drop }, { rebound_speeds: speeds, rebound_ratios: ratios, rebound_heights: heights }, prediction, fall = true) {
  const predicted = (name, ball) => prediction?.values?.[`${name}.${ball}`];
  const { unit, factor, written } = heightsIn(heights);
  const rise = (ball) => {
    const { value, error } = predicted("rebound_heights", ball) ?? {};
    return withSpread({ value: value * factor, error: error * factor }) ?? written(heights[ball]);
  };
  const multiples = fall && !prediction?.values; // there is no room for both
  const fallen = speedOf(drop) ** 2 / 2 / GRAVITY;
  return [
    { name: "m/s", cell: (ball) => withSpread(predicted("rebound_speeds", ball)) ?? fixed(speeds[ball], 2) },
    { name: "v / v₀", cell: (ball) => withSpread(predicted("rebound_ratios", ball)) ?? fixed(ratios[ball], 3) },
    { name: [t("rises {unit}", { unit }), multiples ? wide(` ${t("(× drop)")}`) : null], cell: (ball) => [rise(ball), multiples ? times(heights[ball], fallen) : null] },
  ];
}

/** The columns of a whole drop: how high each ball comes. */
function wholeColumns({ drop, frames }, positions) {
  const fallen = speedOf(drop) ** 2 / 2 / (drop.gravity || GRAVITY);
  const tops = positions.map((path) => highest(frames.time, path));
  const { unit, written } = heightsIn(tops);
  return [{ name: [t("highest so far {unit}", { unit }), wide(` ${t("(× drop)")}`)], cell: (ball) => [written(tops[ball]), times(tops[ball], fallen)] }];
}

/** Return the one unit of a column of heights in m, and what writes them in it; a ball that goes down has none. */
function heightsIn(heights) {
  const most = Math.max(0, ...heights.filter(Number.isFinite));
  const [unit, factor, decimals] = most < 0.1 ? ["mm", 1e3, 1] : ["m", 1, most < 1 ? 3 : 2];
  const written = (value) => (Number.isFinite(value) ? fixed(Math.max(value, 0) * factor, decimals) : "–");
  return { unit, factor, written };
}

/** Return how many times the height of the drop a ball comes up, to stand behind the height. */
function times(reached, fallen) {
  return reached > 0.1 * fallen ? wide(` (${format(reached / fallen, 3)}×)`) : null;
}

/** Return a text that is hidden on a phone. */
function wide(text) {
  return h("span", { class: "wide-only", text });
}

/** Energy, collisions and how the run ended. */
function facts(result, until, prediction) {
  const { drop } = result;
  const separate = textbook(result);
  const pair = (name, own, other, attributes = {}) => {
    const beside = other === undefined ? null : h("small", { text: ` ${t("textbook {value}", { value: other })}` });
    return h("div", attributes, h("dt", { text: name }), h("dd", {}, own, beside));
  };
  const list = [pair(t("Impact speed"), `${format(result.reference_speed, 3)} m/s`)];
  if (until === null) {
    const theirs = separate ? percent(separate.energy_retained) : undefined;
    const { value, error } = prediction?.values?.energy_retained ?? {};
    const own = withSpread({ value: 100 * value, error: 100 * error });
    list.push(pair(t("Kinetic energy retained"), own ? `${own} %` : percent(known(result).energy_retained), theirs));
  }
  const met = drop.contacts
    .map((_, contact) => contact)
    .filter((contact) => drop.contacts[contact]?.law !== "none")
    .map((contact) => `${shortContact(drop, contact)}: ${count(result.collisions[contact])}`);
  const theirs = separate?.collisions.map(count).join(", ");
  list.push(pair(t("Collisions"), met.join(", "), theirs));
  const pushes = impulsesOf(result).map((impulse, contact) => `${shortContact(drop, contact)}: ${format(impulse, 3)}\u00a0N\u00a0s`);
  list.push(pair(t("Impulse"), pushes.filter((_, contact) => drop.contacts[contact].law !== "none").join(", ")));
  list.unshift(pair(t("Set-up"), setUp(drop), undefined, { class: "print-only" }));
  if (result.separate?.error) list.push(pair(t("Textbook"), translated(result.separate.error)));
  const said = errorWords(prediction, drop);
  if (said) list.push(pair(t("Errors"), said));
  return h("dl", { class: "facts" }, list);
}

/** Return the whole impulse of each contact in N s: what the momentum of all balls above it has gained. */
export function impulsesOf({ drop, rebound_speeds: speeds, end_time: end }) {
  const gains = drop.balls.map(({ mass }, ball) => mass * (speeds[ball] - (drop.velocities?.[ball] ?? -speedOf(drop)) + drop.gravity * end));
  return gains.map((_, contact) => gains.slice(contact).reduce((sum, gain) => sum + gain, 0));
}

/** How the errors were found, and what to measure better, in sentences. */
function errorWords(prediction, drop) {
  if (!prediction) return "";
  if (prediction.problem) return capital(translated(prediction.problem));
  const { how, advice, notes } = prediction;
  const words = [how, advice, ...notes, t("bands show one standard deviation")].filter(Boolean);
  return words.map((text) => `${capital(inWords(translated(text), drop))}.`).join(" ");
}

/** Return a text in which paths, such as `rebound_speeds.1` or `contacts.0.stiffness`, are words. */
function inWords(text, drop) {
  const named = (_, name, index, number) => {
    if (name === "gaps") return t("gap below {name}", { name: ballName(drop, Number(index) + 1) });
    const who = name === "balls" || name.startsWith("rebound_") ? ballName : shortContact;
    return t("{number} of {place}", { number: number ?? name, place: who(drop, Number(index)) });
  };
  return text
    .replace(/\b([a-z_]+)\.(\d)(?:\.([a-z_]+))?/g, named)
    .replace(/\bcontact (\d)\b/g, (_, contact) => shortContact(drop, Number(contact)))
    .replaceAll("_", " ");
}

/** Fill the table of the contact intervals. */
function showRows({ caption, rows: body }, { drop, intervals }) {
  const ms = (time) => (time === null ? "–" : fixed(time * 1e3, 3));
  const rows = intervals.slice(0, 200).map((interval) =>
    row(
      contactName(drop, interval.contact),
      interval.contact,
      ms(interval.start),
      ms(interval.end),
      interval.end === null ? "–" : ms(interval.end - interval.start),
      interval.peak_force === null ? "–" : format(interval.peak_force, 4),
      format(interval.peak_compression * 1e3, 4),
      format(interval.impulse, 4),
    ),
  );
  const more = intervals.length > rows.length ? ` ${t("The first {some} of {all}.", { some: rows.length, all: intervals.length })}` : "";
  body.replaceChildren(...rows);
  write(caption, `${t("Each time a contact was closed.")}${more}`);
}
