/** Pad: a square to draw one sign in, of one stroke or of several that are made without a pause. */

import { button, calm, make, showError } from "./dom.js";
import { KEYS_HELP, followKeys } from "./keypen.js";
import { Recording, TOO_LONG, fewEnough, followPointer, joined, passed } from "./pen.js";

const PAUSE = 1500; // ms; after a longer one a new stroke begins the sign again
const LEAST = 0.1; // of half the pad; what reaches less far was a tap
const FILL = 0.8; // of the pad, for strokes that others drew
const KEYS = { step: 1 / 24, seconds: 0.04 };
const PLAYBACK = 2; // times as fast as it was drawn

/** Scale a stroke into the pad: y up, from -1 to 1. */
export function fitted(stroke) {
  const [xs, ys] = [stroke.points.map((p) => p[0]), stroke.points.map((p) => p[1])];
  const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const scale = (2 * FILL) / Math.max(right - left, high - low, 1e-9);
  const place = ([x, y]) => [(x - (left + right) / 2) * scale, (y - (low + high) / 2) * scale];
  return { points: stroke.points.map(place), times: stroke.times };
}

export class SignPad {
  /**
   * @param {number} number of the sign, from 1
   * @param {function} changed called when the sign is drawn or cleared; gets whether a person did it
   * @param {function} started called when a person puts the pen down
   */
  constructor(number, changed, started = () => {}) {
    this.changed = changed;
    this.started = started;
    this.parts = []; // strokes that make up the sign, and where the bridges are
    this.drawing = null;
    this.lifted = -Infinity;
    this.playing = 0;
    const name = number === 1 ? "First sign" : "Second sign";
    this.aimed = null; // where the keyboard's pen is, x and y from -1 to 1
    this.canvas = make("canvas", { className: "pad-canvas", role: "application", tabIndex: 0, title: KEYS_HELP, "aria-label": `${name}: empty` });
    this.clearer = button("Clear", () => this.clear(), { className: "plain", "aria-label": `Clear the ${name.toLowerCase()}` });
    this.name = name;
    this.element = make(
      "figure",
      { className: "pad" },
      make("figcaption", {}, make("b", { textContent: String(number) }), ` ${name} `, this.clearer),
      this.canvas,
    );
    const hooks = {
      begin: (at) => this.begin(at),
      move: (at) => this.move(at),
      end: () => this.end(),
      cancel: () => this.cancel(),
    };
    followPointer(this.canvas, hooks);
    followKeys(this.canvas, { ...hooks, home: () => [0.5, 0.5], aim: (at) => this.aim(at) }, KEYS);
    new ResizeObserver(() => this.paint()).observe(this.canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.paint());
    this.clear(false);
  }

  /** The sign, or null. */
  get stroke() {
    return this.parts.length ? this.parts.reduce(joined) : null;
  }

  /** Show a sign without drawing it, as after a reload. */
  put(parts) {
    this.playing += 1;
    this.parts = parts;
    this.paint();
  }

  clear(byHand = true) {
    this.put([]);
    if (byHand) this.changed(true);
  }

  begin(at) {
    this.playing += 1; // whatever was played stops
    this.started();
    if (performance.now() - this.lifted > PAUSE) this.parts = [];
    this.drawing = new Recording(this.stroke?.times.at(-1));
    this.size = this.canvas.getBoundingClientRect().width;
    this.move(at);
  }

  move(at) {
    this.drawing.add(this.inPad(at, this.size), at.time);
    this.paint();
  }

  /** A pen on its way to another stroke is no pause. */
  aim(at) {
    this.aimed = at && this.inPad(at, this.canvas.getBoundingClientRect().width);
    if (at && this.parts.length && performance.now() - this.lifted <= PAUSE) this.lifted = performance.now();
    this.paint();
  }

  inPad({ x, y }, size) {
    return [(2 * x) / size - 1, 1 - (2 * y) / size];
  }

  end() {
    const made = this.drawing;
    this.drawing = null;
    if (made.reach >= LEAST) this.parts = fewEnough([...this.parts, made.stroke]);
    this.lifted = performance.now();
    this.paint();
    this.changed(true);
    if (made.late) showError(TOO_LONG);
  }

  cancel() {
    this.drawing = null;
    this.paint();
    this.changed(true);
  }

  /** Play a sign that was drawn elsewhere, in time; resolves with whether it came to its end. */
  async play(stroke, speed = PLAYBACK) {
    const whole = fitted(stroke);
    this.put([]);
    const turn = this.playing;
    await playing(whole.times, (count) => {
      if (turn !== this.playing) return false;
      this.parts = count > 1 ? [{ points: whole.points.slice(0, count), times: whole.times.slice(0, count) }] : [];
      this.paint();
      return true;
    }, speed);
    if (turn !== this.playing) return false;
    this.parts = [whole];
    this.lifted = -Infinity;
    this.paint();
    this.changed(false);
    return true;
  }

  paint() {
    const size = Math.round(this.canvas.clientWidth * devicePixelRatio);
    this.clearer.hidden = !this.parts.length;
    this.canvas.setAttribute("aria-label", `${this.name}: ${this.parts.length ? "drawn" : "empty"}`);
    if (!size) return;
    if (this.canvas.width !== size) this.canvas.width = this.canvas.height = size;
    const pen = this.canvas.getContext("2d");
    pen.clearRect(0, 0, size, size);
    pen.lineWidth = Math.max(2.5, size / 55);
    pen.lineCap = pen.lineJoin = "round";
    pen.strokeStyle = getComputedStyle(this.canvas).color;
    for (const part of [...this.parts, ...(this.drawing ? [this.drawing] : [])]) {
      pen.beginPath();
      for (const [x, y] of part.points) pen.lineTo(((x + 1) * size) / 2, ((1 - y) * size) / 2);
      pen.stroke();
    }
    if (!this.aimed) return;
    const [x, y] = this.aimed;
    pen.beginPath();
    pen.arc(((x + 1) * size) / 2, ((1 - y) * size) / 2, size / 30, 0, 2 * Math.PI);
    pen.stroke();
  }
}

/**
 * Call back with how many samples have passed, frame by frame, until all have or the callback returns false.
 * Where no motion is wanted, only the end is shown.
 */
export function playing(times, show, speed = PLAYBACK) {
  if (calm() || times.length < 2) {
    show(times.length);
    return Promise.resolve();
  }
  const begun = performance.now();
  let count = 0;
  return new Promise((done) => {
    const frame = () => {
      const now = times[0] + (speed * (performance.now() - begun)) / 1000;
      count = passed(times, now, count);
      if (show(count) === false || count === times.length) done();
      else requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  });
}
