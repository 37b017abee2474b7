/** The three panels of curves of a result, in convenient units. */

import { extentOf } from "../extent.js";
import { t } from "../words/language.js";
import { format, shortBall, shortContact } from "../words/words.js";

/** Dashes of the lines of balls and of the contacts below them, so that nobody needs their colours. */
const DASHES = [undefined, [9, 4], [2, 3], [14, 4, 2, 4, 2, 4], [4, 4], [1, 6]];

/**
 * Return the panels of a result: `{what, title, unit, times, lines, stems, factor}`; a line is
 * `{label, index, values, dash}` and has the colour of ball or contact `index`, or of text; a band is `{index, time, low, high}`.
 */
export function panels(result, whole, overlays = [], prediction = null) {
  const scale = whole ? 1 : 1e3;
  const times = result.frames.time.map((time) => time * scale);
  const common = { times, scale, timeUnit: whole ? "s" : "ms" };
  const own = (what, factor) =>
    overlays
      .filter((overlay) => overlay.what === what)
      .map((overlay) => ({
        ...overlay,
        time: overlay.time.map((time) => time * scale),
        values: overlay.values.map((value) => (value === null ? null : value * factor)),
      }));
  return [positions(result, whole), result.separate ? forces(result) : impulses(result, scale), energies(result)].map(
    (panel) => ({
      ...common,
      ...panel,
      overlays: own(panel.what, panel.factor ?? 1),
      bands: bands(prediction?.band, panel, scale),
    }),
  );
}

/** Return one standard deviation around each line of a panel that has an error. */
function bands(band, { what, lines, factor }, scale) {
  const [low, high] = band?.[what] ?? [];
  if (!low) return [];
  const time = band.time.map((time) => time * scale);
  return lines.map(({ index }) => ({ index, time, low: scaled(low[index], factor), high: scaled(high[index], factor) }));
}

function scaled(values, factor) {
  return factor === 1 ? values : values.map((value) => value * factor);
}

function positions({ drop, frames }, whole) {
  const factor = whole ? 1 : 1e3;
  const lines = frames.position.map((values, index) => ({
    label: shortBall(drop, index),
    index,
    dash: DASHES[index],
    values: scaled(values, factor),
  }));
  return { what: "position", title: t("Position"), unit: whole ? t("m from the touch") : t("mm from the touch"), factor, lines };
}

function forces({ drop, frames }) {
  const lines = frames.force
    .map((values, index) => ({ label: shortContact(drop, index), index, dash: DASHES[index], values }))
    .filter((_, index) => drop.contacts[index]?.law !== "none");
  return { what: "force", title: t("Force"), unit: "N", factor: 1, floor: 0, lines };
}

/** A rigid collision has an impulse and no finite force. */
function impulses({ drop, intervals }, scale) {
  const stems = intervals.map(({ contact, start, impulse }) => ({ index: contact, time: start * scale, impulse }));
  const met = [...new Set(stems.map(({ index }) => index))].sort();
  const lines = met.map((index) => ({ label: shortContact(drop, index), index, values: null }));
  const most = stems.reduce((most, { impulse }) => Math.max(most, impulse), 0);
  return { what: "impulse", title: t("Impulse"), unit: "N s", floor: 0, ceiling: most || 1, lines, stems };
}

function energies({ drop, frames }) {
  const { kinetic, stored, potential, total } = frames.energy;
  const most = Math.max(...total.filter(Number.isFinite), 0);
  const factor = most < 1 ? 1e3 : 1;
  const lines = [
    { label: t("total"), index: null, values: scaled(total, factor) },
    ...kinetic.map((values, index) => ({ label: shortBall(drop, index), index, dash: DASHES[index], values: scaled(values, factor) })),
  ];
  if (stored.some((value) => value > 1e-9 * most)) {
    lines.push({ label: t("in contacts"), index: null, dash: [5, 4], values: scaled(stored, factor) });
  }
  if (drop.gravity > 0) {
    lines.push({ label: t("potential"), index: null, dash: [1, 3], values: scaled(potential, factor) });
  }
  return { what: "energy", title: t("Energy"), unit: factor === 1 ? "J" : "mJ", factor, lines };
}

const NOTHING = 1e-9; // in the units of a panel: what rounding leaves of zero

/** Describe a panel in words, for screen readers. */
export function describePanel(panel) {
  const { title, unit, lines, stems } = panel;
  const ranges = lines.map(({ label, index, values }) => {
    if (!values) {
      const own = stems.filter((stem) => stem.index === index).map((stem) => stem.impulse);
      return t("{name} {count} times, up to {most} {unit}", { name: label, count: own.length, most: format(Math.max(...own), 3), unit });
    }
    const [low, high] = extentOf(values).map((end) => (Math.abs(end) < NOTHING ? 0 : end));
    return t("{name} from {low} to {high} {unit}", { name: label, low: format(low, 3), high: format(high, 3), unit });
  });
  return t("{what} against time: {ranges}.", { what: title, ranges: ranges.join("; ") });
}
