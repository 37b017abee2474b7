/** A line in words: what it shows, its values at a place, and as a whole. */

import { t, translated } from "../../words/language.js";
import { between, locate } from "../../stage/clock.js";
import { brief, extremes, quantity, sideOf } from "../drawing/sides.js";
import { FIRST_ORDER, ROUGH } from "../../words/sentence.js";
import { ballName, capital, contactName, count, format, height, percent } from "../../words/words.js";

const FEW = 3; // curves whose textbook is told, too

/** What a line can show, and what its axis is called. */
export const SHOWS = new Map([
  ["rebound_ratio", t("Rebound speeds over v₀")],
  ["rebound_height", t("Rebound heights")],
  ["energy_retained", t("Kinetic energy retained")],
  ["collisions", t("Collisions of each contact")],
  ["angle", t("Angle from straight up")],
]);

/** Return what a curve is of: a ball, a contact, or all. */
export function nameOf({ drop, show }, { index }) {
  if (index === null) return t("energy");
  return show === "collisions" ? contactName(drop, index) : ballName(drop, index);
}

/** Return the value of a curve at a part of the side: between two points on their chord, at a jump that of the nearer one. */
export function valueAt({ x, show }, { values, jumps }, part) {
  const side = sideOf(x);
  const parts = x.values.map((value) => side.part(value));
  const place = locate(parts, part);
  const [left, right] = [values[place.index], values[place.index + 1]];
  if (left === null || right === null || jumps.includes(place.index) || show === "collisions") return place.fraction < 0.5 ? left : right;
  return between(values, place);
}

/** Return what happens at a part of the side, in words: "Gap above basketball 1.2 mm: tennis 1.6 times …". */
export function told(answer, part) {
  const { x, show, curves } = answer;
  const each = [...curves].reverse().map((curve) => outcome(answer, curve, part));
  const values = { number: capital(brief(translated(x.label))), value: quantity(sideOf(x).value(part), x.unit), each: each.join(", ") };
  return show === "rebound_ratio" ? t("{number} {value}: {each} the impact speed.", values) : t("{number} {value}: {each}.", values);
}

function outcome(answer, curve, part) {
  const own = valueAt(answer, curve, part);
  const name = nameOf(answer, curve);
  const theirs = answer.curves.length <= FEW && curve.textbook && valueAt(answer, curve.textbook, part);
  const beside = typeof theirs === "number" ? ` (${t("textbook {value}", { value: written(answer.show, theirs, false) })})` : "";
  const said = own === null ? t("not finished") : written(answer.show, own) + beside;
  if (answer.show === "energy_retained") return t("{share} of the kinetic energy retained", { share: said });
  if (answer.show === "rebound_height") return t("{ball} rises {height}", { ball: name, height: said });
  return `${name} ${said}`;
}

/** Return a value as it is read. */
function written(show, value, times = true) {
  const ratio = format(Math.abs(value) < 5e-4 ? 0 : value, 3);
  if (show === "rebound_ratio") return times ? t("{times} times", { times: ratio }) : ratio;
  if (show === "rebound_height") return height(value);
  if (show === "angle") return `${format(value, 3)}°`;
  return show === "collisions" ? count(value) : percent(value);
}

/** Return a line as a whole in words: the smallest and the largest value of each curve, and where they are. */
export function summary(answer) {
  const { x, show, curves, unfinished } = answer;
  if (!curves.length) return t("This drop has no contact.");
  const sentences = [...curves].reverse().map((curve) => {
    const [low, high] = extremes(curve.values, show === "collisions");
    const name = capital(nameOf(answer, curve));
    if (low === null) return t("{name}: no point could be finished.", { name });
    const said = (i) => written(show, curve.values[i]);
    if (said(low) === said(high)) return t("{name}: {value} everywhere.", { name, value: said(low) });
    const at = (i) => quantity(x.values[i], x.unit) || "0";
    return t("{name}: smallest {low} at {where}, largest {high} at {there}.", { name, low: said(low), where: at(low), high: said(high), there: at(high) });
  });
  const open = unfinished ? ` ${t("{some} of {all} points could not be finished: there the curves have gaps.", { some: unfinished, all: x.values.length })}` : "";
  const steep = show === "angle" && curves.some(({ values }) => values.some((angle) => Math.abs(angle) > FIRST_ORDER));
  return `${sentences.join(" ")}${open}${steep ? ` ${ROUGH}` : ""}`;
}
