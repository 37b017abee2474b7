/** Which numbers of the drop a fit varies: those that are usually unknown are chosen. */

import { h } from "../../dom.js";
import { check } from "../../set_up/fields.js";
import { t, translated } from "../../words/language.js";
import { lossOf } from "../../set_up/laws.js";
import { capital } from "../../words/words.js";

/** Return `{offer(laws, drop, paths, haveClocks), chosen(), labels()}` of a fieldset; `labels` are the words of all numbers by path. */
export function variedNumbers(element) {
  let labels = {};
  const offer = (laws, drop, paths, haveClocks) => {
    const own = paths.filter(({ path }) => !path.endsWith("_ratio"));
    labels = { touch: t("First touch on the record’s clock") };
    for (const { path, label } of own) labels[path] = capital(translated(label));
    const box = ({ path }) => check(labels[path], isLikely(laws, path, drop, haveClocks), () => null, { name: "vary", value: path });
    element.replaceChildren(h("legend", { text: t("Parameters to vary") }), ...own.map(box));
  };
  const chosen = () => {
    const paths = [...element.querySelectorAll("input:checked")].map(({ value }) => value);
    if (paths.length === 0) throw new Error(t("Choose at least one parameter to vary."));
    return paths;
  };
  return { offer, chosen, labels: () => labels };
}

/** Return whether a number is usually unknown: losses are; stiffnesses are where times were measured, else only their ratio matters. */
function isLikely(laws, path, drop, haveClocks) {
  const [part, index, field] = path.split(".");
  if (part !== "contacts") return false;
  if (field === lossOf(laws, drop.contacts[index])) return true;
  const isLossless = !drop.contacts.some((contact) => lossOf(laws, contact));
  return field === "stiffness" && (haveClocks || (isLossless && Number(index) === drop.contacts.length - 1));
}
