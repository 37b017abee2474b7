/** The line: the rebound over one number of the drop, with the present drop as a point on it. */

import { brief, haveSameDrawing } from "../drawing/sides.js";
import { drawer } from "../drawing/request.js";
import { DrawingView } from "../drawing/view.js";
import { complete } from "../../set_up/drops.js";
import { t, translated } from "../../words/language.js";
import { drawLine, drawLineMarks } from "./draw.js";
import { lineForm } from "./form.js";
import { settle } from "./request.js";
import { SHOWS, summary, told, valueAt } from "./in_words.js";
import { palette } from "../../plots/palette.js";
import { withExample } from "../../state/store.js";

/** Build the view into `root`. */
export async function mount(root, store, api, clock) {
  const { lines: figures } = await api.catalogue();
  let drawn = null; // the present drawing
  const figureIn = (answer) => figureOf(figures, answer);
  const measured = (answer) => figureIn(answer)?.measured ?? [];
  const use = (figure) => {
    if (!figure) return;
    const line = { x: figure.x, show: "rebound_ratio" };
    store.set({ ...withExample(store.get(), complete(figure.drop)), line });
  };
  new DrawingView(root, store, clock, {
    name: "line",
    role: t("line"),
    here: t("The dots are the present drop."),
    outside: t("The present drop lies outside of this line."),
    sides: 1,
    margin: 4,
    step: 1 / 100,
    form: (element) => lineForm(element, figures, figureIn, { set: (line) => store.set({ line }), use }),
    requests: (tell) => drawer(api, tell, settle, (drop, settings, told) => api.line({ drop, ...settings }, told)),
    sidesOf: ({ answer }) => [answer.x],
    draw(size, { answer }, { drawing }) {
      drawn = drawLine(answer, size, palette(), measured(answer));
      drawing.replaceChildren(drawn.svg);
      const [what, number] = [SHOWS.get(answer.show), translated(answer.x.label)];
      return {
        frame: drawn.frame,
        title: t("{what} against {number}", { what, number: brief(number) }),
        label: t("Line: {what}; across, {number}", { what, number }),
        summary: summary(answer),
      };
    },
    mark({ answer }, present, pointed, { marks }) {
      const values = (part) => answer.curves.map((curve) => ({ index: curve.index, value: valueAt(answer, curve, part) }));
      const spot = (place, isPresent) => (place ? [{ part: place[0], values: values(place[0]), present: isPresent }] : []);
      drawLineMarks(marks, drawn, [...spot(present, true), ...spot(pointed, false)], palette());
    },
    told: ({ answer }, [part]) => told(answer, part),
  });
}

/** Return the paper's line that an answer is, at whatever value of the number that varies. */
function figureOf(figures, { drop, x }) {
  const isSame = (figure) => ["path", "low", "high", "log"].every((name) => figure.x[name] === x[name]);
  return figures.find((figure) => isSame(figure) && haveSameDrawing(drop, complete(figure.drop), [x.path]));
}
