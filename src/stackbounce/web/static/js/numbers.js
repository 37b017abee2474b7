/** What came out: speeds, ratios, heights, collisions and energy, beside the separate collisions. */

import { h, write } from "./dom.js";
import { fixed, format } from "./units.js";
import { ballName, capital, contactName, count, height, percent, shortContact, told } from "./words.js";

const SETTLED = 700; // ms without a new result before it is said

/** Write the numbers into `root`, the contact intervals into `table`, and say results in `live`. */
export function mountNumbers({ root, table, live }, store) {
  let timer = 0;
  const show = () => {
    const { result, until } = store.get();
    if (!result) return;
    root.replaceChildren(ballTable(result, until), facts(result, until));
    table.replaceChildren(intervalTable(result));
    clearTimeout(timer);
    timer = setTimeout(() => write(live, told(result, until)), SETTLED);
  };
  store.subscribe((state, before) => {
    if (state.result !== before.result) show();
  });
}

function columns(...names) {
  return h("tr", {}, names.map((name) => h("th", { scope: "col" }, name)));
}

function row(name, index, ...cells) {
  const swatch = h("span", { class: "swatch", "aria-hidden": "true" });
  swatch.style.setProperty("--ball", `var(--ball-${index % 6})`);
  return h("tr", {}, h("th", { scope: "row" }, swatch, name), cells.map((text) => h("td", { text })));
}

/** Return the separate collisions' numbers, where there are any. */
function textbook({ separate }) {
  return separate && !separate.error ? separate : null;
}

/** The table of the balls, the highest first, as they lie. */
function ballTable(result, until) {
  const { drop } = result;
  const separate = textbook(result);
  const whole = until !== null;
  const [rises, theirs] = whole ? [tops(result.frames.position), tops(separate?.position)] : [result.rebound_heights, separate?.rebound_heights];
  const up = whole ? "highest" : "rises";
  const names = ["Ball", "m/s", "v / v₀", up];
  const when = whole ? `After ${format(until)} s` : "After the impact";
  const groups = [h("td"), h("th", { scope: "colgroup", colspan: 3, text: when })];
  if (separate) {
    names.push("v / v₀", up);
    groups.push(h("th", { scope: "colgroup", colspan: 2, text: "Textbook" }));
  }
  const rows = drop.balls.map((_, ball) => {
    const cells = [
      fixed(result.rebound_speeds[ball], 2),
      fixed(result.rebound_ratios[ball], 3),
      height(rises[ball]),
    ];
    if (separate) cells.push(fixed(separate.rebound_ratios[ball], 3), height(theirs[ball]));
    return row(ballName(drop, ball), ball, ...cells);
  });
  return h(
    "table",
    { class: "numbers-table" },
    h("caption", { class: "quiet", text: "Speeds and heights after the impact, the highest ball first" }),
    h("thead", {}, h("tr", { class: "groups" }, groups), columns(...names)),
    h("tbody", {}, rows.reverse()),
  );
}

/** Return how high each ball comes in what is shown. */
function tops(positions) {
  return positions?.map((values) => values.reduce((most, value) => Math.max(most, value), 0));
}

/** Energy, collisions and how the run ended. */
function facts(result, until) {
  const { drop } = result;
  const separate = textbook(result);
  const pair = (name, own, other) => {
    const beside = other === undefined ? null : h("small", { text: ` textbook ${other}` });
    return h("div", {}, h("dt", { text: name }), h("dd", {}, own, beside));
  };
  const list = h("dl", { class: "facts" }, pair("Impact speed", `${format(result.reference_speed, 3)} m/s`));
  list.append(pair("Energy kept", percent(result.energy_retained), separate ? percent(separate.energy_retained) : undefined));
  const met = drop.contacts
    .map((_, contact) => contact)
    .filter((contact) => drop.contacts[contact]?.law !== "none")
    .map((contact) => `${shortContact(drop, contact)}: ${count(result.collisions[contact])}`);
  const theirs = separate?.collisions.map(count).join(", ");
  list.append(pair("Collisions", met.join(", "), theirs));
  if (result.separate?.error) list.append(pair("Textbook", result.separate.error));
  const asked = until !== null && result.status === "TIME_REACHED";
  if (result.status !== "FINISHED" && !asked) list.append(pair("Note", capital(result.advice)));
  return list;
}

/** The table of the contact intervals. */
function intervalTable({ drop, intervals }) {
  const ms = (time) => (time === null ? "–" : fixed(time * 1e3, 3));
  const rows = intervals.slice(0, 200).map((one) =>
    row(
      contactName(drop, one.contact),
      one.contact,
      ms(one.start),
      ms(one.end),
      one.end === null ? "–" : ms(one.end - one.start),
      one.peak_force === null ? "–" : format(one.peak_force, 4),
      format(one.peak_compression * 1e3, 4),
      format(one.impulse, 4),
    ),
  );
  const more = intervals.length > rows.length ? ` The first ${rows.length} of ${intervals.length}.` : "";
  return h(
    "table",
    {},
    h("caption", { text: `Each time a contact was closed.${more}` }),
    h("thead", {}, columns("Contact", "from ms", "to ms", "for ms", "peak force N", "compression mm", "impulse N s")),
    h("tbody", {}, rows),
  );
}
