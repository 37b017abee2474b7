/** Position, force and energy against time, under one cursor that is the clock's. */

import uPlot from "../../vendor/uplot/uPlot.esm.js";
import { between, locate } from "../stage/clock.js";
import { chartOptions, clipped, drawDots, legendItem } from "./chart.js";
import { describePanel, panels } from "./curves.js";
import { h, letDrag, write } from "../dom.js";
import { extentOf } from "../extent.js";
import { Pace } from "../pace.js";
import { colorOf, onRepaint, palette } from "./palette.js";
import { format } from "../words/words.js";

/** Draw the plots into `root` and keep their cursor at the clock's time. */
export function mountPlots(root, store, clock) {
  const pace = new Pace();
  let shown = [];
  let due = false; // what is shown has changed
  const build = () => {
    const { result, until, overlays, prediction, view } = store.get();
    if (!result || view !== "play") return;
    const wanted = panels(result, until !== null, overlays, prediction);
    const same = shown.length > 0 && wanted.every((panel, i) => shown[i].key === keyOf(panel));
    if (same) {
      wanted.forEach((panel, i) => shown[i].update(panel));
    } else {
      for (const panel of shown) panel.remove();
      const colors = palette();
      root.replaceChildren();
      shown = wanted.map((panel) => new Panel(root, panel, colors, clock));
    }
    due = false;
    pace.watch();
    clock.touch();
  };
  const repaint = () => {
    for (const panel of shown) panel.remove();
    shown = [];
    build();
  };
  store.subscribe((state, before) => {
    due ||= ["result", "overlays", "prediction", "view"].some((name) => state[name] !== before[name]);
    if (due && !(state.busy && pace.isBusy)) build();
  });
  clock.subscribe(() => {
    for (const panel of shown) if (clock.legible) panel.tell(clock.time);
    for (const panel of shown) panel.follow(clock.time);
  });
  onRepaint(repaint);
  build();
}

/** Return a key that changes when a panel has to be rebuilt. */
function keyOf({ what, unit, timeUnit, lines, overlays }) {
  const named = [...lines, ...overlays].map(({ label, index, dash }) => [label, index, dash]);
  return JSON.stringify([what, unit, timeUnit, named]);
}

/** One plot with its heading and legend. */
class Panel {
  constructor(root, panel, colors, clock) {
    this.key = keyOf(panel);
    this.colors = colors;
    this.values = panel.lines.map(() => h("span", { class: "legend-value" }));
    const items = panel.lines.map((line, i) => this.legendItem(line, this.values[i]));
    this.host = h("div", { class: "plot-canvas", role: "img" });
    items.push(...panel.overlays.map((overlay) => this.legendItem({ ...overlay, index: overlay.index ?? null, dash: [1, 2] }, null)));
    const title = h("h3", {}, panel.title, h("span", { class: "unit", text: ` ${panel.unit}` }));
    root.append(
      h("figure", { class: "plot" }, h("figcaption", {}, title, h("ul", { class: "legend" }, items)), this.host),
    );
    this.line = h("div", { class: "cursor-line" });
    this.dots = panel.lines.map((line) => h("div", { class: "cursor-dot", hidden: !line.values, "--ball": this.color(line) }));
    this.panel = panel;
    this.plot = new uPlot(this.options(), this.data(), this.host);
    this.plot.over.append(this.line, ...this.dots);
    grab(this.plot, clock, () => this.panel.scale);
    this.watch = new ResizeObserver(() => this.resize(clock));
    this.watch.observe(this.host);
    this.describe();
  }

  remove() {
    this.watch.disconnect();
    this.plot.destroy();
  }

  /** Draw other data of the same kind. */
  update(panel) {
    this.panel = panel;
    this.plot.setData(this.data());
    this.describe();
  }

  describe() {
    this.host.setAttribute("aria-label", describePanel(this.panel));
  }

  resize(clock) {
    const { width, height } = this.host.getBoundingClientRect();
    if (width < 20 || height < 20) return;
    this.plot.setSize({ width, height });
    clock.touch();
  }

  /** Write the legend's values at a time in s. */
  tell(time) {
    const place = locate(this.panel.times, time * this.panel.scale);
    this.panel.lines.forEach(({ values }, i) => {
      if (!values) return;
      const value = between(values, place);
      write(this.values[i], format(Math.abs(value) < 1e-9 ? 0 : value, 3));
    });
  }

  /** Move the cursor and its dots to a time in s. */
  follow(time) {
    const at = time * this.panel.scale;
    const place = locate(this.panel.times, at);
    const left = this.plot.valToPos(at, "x");
    this.line.style.transform = `translateX(${left.toFixed(1)}px)`;
    this.panel.lines.forEach(({ values }, i) => {
      if (!values) return;
      const top = this.plot.valToPos(between(values, place), "y");
      this.dots[i].style.transform = `translate(${left.toFixed(1)}px, ${top.toFixed(1)}px)`;
    });
  }

  data() {
    const { times, lines } = this.panel;
    return [times, ...lines.map(({ values }) => values ?? times.map(() => null))];
  }

  color({ index }) {
    return index === null ? this.colors.text : colorOf(this.colors, index);
  }

  legendItem(line, value) {
    const look = line.dash ? (line.dash[0] > line.dash[1] ? "dashed" : "dotted") : "";
    return legendItem(this.color(line), look, h("span", { class: "legend-label", text: line.label }), value);
  }

  options() {
    const { width, height } = this.host.getBoundingClientRect();
    const { panel, colors } = this;
    const values = (_, ticks) => ticks.map((tick) => format(tick, 4));
    const times = (_, ticks) => ticks.map((tick) => `${format(tick, 4)}${tick === 0 ? ` ${this.panel.timeUnit}` : ""}`);
    return chartOptions(colors, {
      width: Math.max(width, 40),
      height: Math.max(height, 40),
      padding: [6, 8, 0, 0],
      x: () => [this.panel.times[0], this.panel.times.at(-1)],
      y: (_, low, high) => this.range(low, high),
      axes: [{ size: 22, gap: 3, values: times }, { size: 46, gap: 4, space: 26, values }],
      series: panel.lines.map((line) => ({
        stroke: this.color(line),
        width: line.index === null ? 1.2 : 2,
        dash: line.dash,
        fill: panel.what === "force" ? `${this.color(line)}22` : undefined,
        points: { show: false },
        pxAlign: 0,
      })),
      hooks: { drawAxes: [(plot) => this.drawBands(plot), (plot) => this.drawMeasured(plot)], draw: [(plot) => this.drawStems(plot)] },
    });
  }

  /** Return the range of the values, of what is laid over them, with a little air. */
  range(low, high) {
    const { floor, ceiling, overlays, bands, times } = this.panel;
    const seen = (time) => time >= times[0] && time <= times.at(-1);
    const laid = [...overlays, ...bands.flatMap(({ time, low, high }) => [{ time, values: low }, { time, values: high }])];
    const more = laid.flatMap(({ time, values }) => values.filter((value, i) => value !== null && seen(time[i])));
    const [bottom, top] = extentOf([...more, floor, ceiling, low, high]);
    if (bottom > top) return [0, 1];
    const air = 0.06 * (top - bottom) || 1;
    return [bottom === floor ? floor : bottom - air, top + air];
  }

  /** Draw impulses as stems: a rigid collision has no line. */
  drawStems(plot) {
    clipped(plot, (ctx) => {
      for (const { index, time, impulse } of this.panel.stems ?? []) {
        ctx.strokeStyle = colorOf(this.colors, index);
        ctx.lineWidth = 3 * devicePixelRatio;
        ctx.stroke(new Path2D(`M${plot.valToPos(time, "x", true)} ${plot.valToPos(0, "y", true)}V${plot.valToPos(impulse, "y", true)}`));
      }
    });
  }

  /** Draw one standard deviation around each line, below the lines. */
  drawBands(plot) {
    clipped(plot, (ctx) => {
      for (const { index, time, low, high } of this.panel.bands) {
        const known = [...time.keys()].filter((i) => low[i] !== null && high[i] !== null);
        const place = (i, values) => [plot.valToPos(time[i], "x", true), plot.valToPos(values[i], "y", true)];
        ctx.fillStyle = `${colorOf(this.colors, index)}44`;
        ctx.beginPath();
        for (const i of known) ctx.lineTo(...place(i, low));
        for (const i of known.reverse()) ctx.lineTo(...place(i, high));
        ctx.fill();
      }
    });
  }

  /** Draw measurements as dots, below the simulated lines. */
  drawMeasured(plot) {
    clipped(plot, (ctx) => {
      for (const { index, time, values } of this.panel.overlays) {
        ctx.fillStyle = this.color({ index: index ?? null });
        drawDots(plot, time, values, 2);
      }
    });
  }
}

/** Let the cursor be dragged on a plot. */
function grab(plot, clock, scale) {
  const { over } = plot;
  letDrag(over, () => true, (event) => {
    clock.pause();
    clock.seek(plot.posToVal(event.clientX - over.getBoundingClientRect().left, "x") / scale());
  });
}
