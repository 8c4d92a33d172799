/** Similarities of the demonstrations as a matrix whose cells are read with the pointer or the keyboard. */

import { get } from "./api.js";
import { byId, make } from "./dom.js";
import { objectName, path, store } from "./store.js";

const STOPS = [[0, 32, 77], [49, 68, 107], [102, 105, 112], [149, 143, 120], [203, 186, 105], [255, 234, 70]]; // cividis
const WAYS = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] };

export class Matrix {
  constructor() {
    this.frames = make("select", { id: "matrix-frames", onchange: () => this.paint() });
    this.canvas = make("canvas", { className: "matrix", tabIndex: 0, role: "img", "aria-label": "Similarities of the demonstrations", "aria-describedby": "matrix-told" });
    this.told = make("p", { id: "matrix-told", className: "told", "aria-live": "polite" });
    this.problem = make("p", { className: "quiet" });
    this.cell = null;
    this.body = make(
      "div",
      {},
      make("label", { className: "field" }, "Seen from", this.frames),
      make("div", { className: "matrix-box" }, this.canvas, scale()),
      this.told,
    );
    byId("look-matrix").append(make("h3", { textContent: "How similar are the demonstrations?" }), this.problem, this.body);
    this.canvas.addEventListener("pointermove", (event) => this.point(event));
    this.canvas.addEventListener("pointerdown", (event) => this.point(event));
    this.canvas.addEventListener("pointerleave", () => this.choose(null));
    this.canvas.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.paint()).observe(this.canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.paint());
  }

  /** Fetch the matrices of the session; there are none of fewer than two demonstrations. */
  async load() {
    const few = store.session.demonstrations.length < 2;
    this.body.hidden = few;
    this.problem.textContent = few ? "Two demonstrations or more can be compared." : "";
    if (few) return;
    try {
      this.data = await get(path("similarities"));
    } catch (problem) {
      this.body.hidden = true;
      this.problem.textContent = problem.message;
      return;
    }
    this.offerFrames();
    this.choose(null);
  }

  offerFrames() {
    const before = this.frames.value;
    const views = this.data.frames.flatMap((row, i) => row.map((_, j) => [`${i} ${j}`, frameName(i, j)]));
    const options = [["maximum", "the best pair of objects (γ, figure 6)"], ...views];
    this.frames.replaceChildren(...options.map(([value, textContent]) => make("option", { value, textContent })));
    if (options.some(([value]) => value === before)) this.frames.value = before;
  }

  get values() {
    if (this.frames.value === "maximum") return this.data.maximum;
    const [i, j] = this.frames.value.split(" ").map(Number);
    return this.data.frames[i][j];
  }

  /** Brightest value and darkest, of the logarithm, off the diagonal. */
  get range() {
    const logs = this.values.flatMap((row, t) => row.filter((x, k) => k !== t && x > 0).map(Math.log));
    const low = Math.min(...logs);
    return [low, Math.max(low + 1e-6, ...logs)];
  }

  paint() {
    const size = Math.round(this.canvas.clientWidth * devicePixelRatio);
    if (!size || !this.data) return;
    this.canvas.width = this.canvas.height = size;
    const pen = this.canvas.getContext("2d");
    const { order, labels } = this.data;
    const [values, [low, high], step] = [this.values, this.range, size / order.length];
    order.forEach((t, row) =>
      order.forEach((k, column) => {
        pen.fillStyle = t === k ? "#8883" : shade((Math.log(values[t][k]) - low) / (high - low));
        pen.fillRect(column * step, row * step, Math.ceil(step), Math.ceil(step));
      }),
    );
    nameRows(pen, order, step, getComputedStyle(this.canvas).color);
    pen.fillStyle = "#fff";
    for (let i = 1; i < order.length; i += 1) {
      if (labels[order[i]] === labels[order[i - 1]]) continue;
      pen.fillRect(i * step - 1, 0, 2, size);
      pen.fillRect(0, i * step - 1, size, 2);
    }
    this.canvas.setAttribute("aria-label", `Similarities of ${order.length} demonstrations, sorted by movement; arrow keys go from cell to cell`);
    if (this.cell) outline(pen, this.cell, step);
  }

  point(event) {
    const count = this.data.order.length;
    const at = (x, size) => Math.min(count - 1, Math.max(0, Math.floor((x / size) * count)));
    this.choose([at(event.offsetY, this.canvas.clientHeight), at(event.offsetX, this.canvas.clientWidth)]);
  }

  key(event) {
    const way = WAYS[event.key];
    if (!way) return;
    event.preventDefault();
    const last = this.data.order.length - 1;
    const from = this.cell ?? [0, -1];
    this.choose(from.map((x, i) => Math.min(last, Math.max(0, x + way[i]))));
  }

  choose(cell) {
    this.cell = cell;
    this.paint();
    this.told.textContent = cell ? this.describe(cell) : "The diagonal has the demonstrations' numbers. Point at a cell, or go there with the arrow keys.";
  }

  describe([row, column]) {
    const { order, labels } = this.data;
    const [t, k] = [order[row], order[column]];
    if (t === k) return `Demonstration ${t + 1} with itself.`;
    const [first, second] = [t, k].map((n) => (labels[n] < 0 ? "none" : labels[n] + 1));
    const kin = labels[t] !== labels[k] ? `movements ${first} and ${second}` : labels[t] < 0 ? "no movement" : `both movement ${first}`;
    return `Demonstrations ${t + 1} and ${k + 1}, ${kin}: ${this.values[t][k].toFixed(2)} / rad²`;
  }
}

const frameName = (i, j) => `${objectName(i)} in the row's, ${objectName(j)} in the column's`;

/** Write each demonstration's number, from 1, where its row meets its column. */
function nameRows(pen, order, step, ink) {
  pen.fillStyle = ink;
  pen.font = `600 ${Math.min(0.5 * step, 16 * devicePixelRatio)}px system-ui, sans-serif`;
  [pen.textAlign, pen.textBaseline] = ["center", "middle"];
  order.forEach((t, i) => pen.fillText(String(t + 1), (i + 0.5) * step, (i + 0.5) * step));
}

function outline(pen, [row, column], step) {
  pen.lineWidth = 3;
  pen.strokeStyle = "#fff";
  pen.strokeRect(column * step, row * step, step, step);
  pen.lineWidth = 1;
  pen.strokeStyle = "#000";
  pen.strokeRect(column * step - 1, row * step - 1, step + 2, step + 2);
}

/** Return the colour of a share from 0 to 1, as CSS. */
export function shade(share) {
  const at = Math.min(0.9999, Math.max(0, share)) * (STOPS.length - 1);
  const [from, to, part] = [STOPS[Math.floor(at)], STOPS[Math.floor(at) + 1], at % 1];
  return `rgb(${from.map((x, i) => Math.round(x + (to[i] - x) * part)).join(" ")})`;
}

function scale() {
  const strip = make("canvas", { className: "scale", width: 120, height: 1, "aria-hidden": "true" });
  const pen = strip.getContext("2d");
  for (let x = 0; x < 120; x += 1) {
    pen.fillStyle = shade(x / 119);
    pen.fillRect(x, 0, 1, 1);
  }
  return make("p", { className: "scale-row quiet" }, "unlike ", strip, " alike");
}
