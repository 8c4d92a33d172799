/** The live table: what the arm does, frame by frame; its objects can be dragged and its hand be shoved. */

import { capital, make } from "./dom.js";
import { distance, followPointer } from "./pen.js";
import { Stage, drawArrow, drawHand, drawLetters, drawObjects, drawPath, drawRing, toPixels } from "./stage.js";
import { objectName, store } from "./store.js";

const GRIP = 0.06; // m, how near to an object or the hand a pointer takes hold of it
const FINGER = 26; // CSS pixels, the same for fingers on small screens
const DRAG_PAUSE = 33; // ms between messages
const STEP = 0.02; // m, of an arrow key
const SHOVE = 4; // m/s for each metre of the flick
const STRONGEST = 1; // m/s
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export class AskTable {
  /** @param {function} framed called with what is told beside each picture */
  constructor(host, live, framed) {
    this.live = live;
    this.framed = framed;
    this.header = null; // what was told last
    this.shown = null; // what was told beside the picture that is seen
    this.handles = [];
    this.waiting = [];
    this.held = null; // {object, to} or {shove, to}
    this.stage = new Stage(host, "The arm at its table, live");
    this.stage.draw((pen) => this.paint(pen));
    followPointer(this.stage.sheet, {
      begin: (at) => this.begin(at),
      move: (at) => this.move(at),
      end: () => this.end(),
      cancel: () => this.cancel(),
    });
  }

  watch(on) {
    if (!on) this.header = this.shown = null;
    this.live.watch(on);
  }

  /** Resolve with the next frame that comes, or the last one that came. */
  seen() {
    return this.header ? Promise.resolve(this.header) : new Promise((done) => this.waiting.push(done));
  }

  frame(header, jpeg) {
    this.header = header;
    for (const done of this.waiting.splice(0)) done(header);
    this.framed(header);
    this.placeHandles(header.objects);
    if (this.decoding) return; // a slow page skips pictures
    this.decoding = true;
    const shown = this.stage.show(new Blob([jpeg], { type: "image/jpeg" }));
    shown.catch(() => {}).finally(() => {
      this.decoding = false;
      this.shown = header;
      this.stage.paint();
    });
  }

  paint(pen) {
    const { shown: header, held } = this;
    if (!header) return;
    if (!this.stage.photographed) drawObjects(pen, header.objects);
    drawLetters(pen, header.objects);
    if (header.focus !== null) {
      const answer = store.session?.answers[header.answer];
      drawRing(pen, header.objects[header.focus], answer?.confidence ?? 1);
    }
    drawPath(pen, header.trail, "hand", "#6b2185");
    if (!this.stage.photographed) drawHand(pen, header.hand, "hand");
    if (held?.shove && held.to) drawArrow(pen, header.hand, held.to);
  }

  begin(at) {
    if (!this.header) return false;
    const grip = Math.max(GRIP, FINGER * this.stage.pixel);
    const [onTable, atHand] = [this.stage.metres(at), this.stage.metres(at, "hand")];
    const gaps = this.header.objects.map((place) => distance(place, onTable));
    const object = gaps.indexOf(Math.min(...gaps));
    const reach = distance(this.header.hand, atHand);
    if (gaps[object] <= grip && gaps[object] <= reach) this.held = { object, sent: 0 };
    else if (reach <= grip) this.held = { shove: true, to: null };
    else return false;
    this.stage.element.classList.add("held");
    return true;
  }

  move(at) {
    const { held } = this;
    held.to = this.stage.metres(at, held.shove ? "hand" : "table");
    if (held.shove) return this.stage.paint();
    if (performance.now() - held.sent < DRAG_PAUSE) return undefined;
    held.sent = performance.now();
    return this.drag(held.object, held.to);
  }

  end() {
    const { held } = this;
    this.cancel();
    if (!held.to) return;
    if (!held.shove) return this.drag(held.object, held.to);
    const flick = held.to.map((to, i) => SHOVE * (to - this.header.hand[i]));
    return this.shove(flick);
  }

  cancel() {
    this.held = null;
    this.stage.element.classList.remove("held");
    this.stage.paint();
  }

  drag(object, to) {
    this.live.send({ type: "drag", object, to: to.map((x) => Math.round(x * 1e4) / 1e4) });
  }

  shove(velocity) {
    const speed = Math.hypot(...velocity);
    if (speed < 0.02) return;
    const most = Math.min(1, STRONGEST / speed);
    this.live.send({ type: "shove", velocity: velocity.map((v) => v * most) });
  }

  shoveAnywhere() {
    const angle = 2 * Math.PI * Math.random();
    this.shove([0.8 * Math.cos(angle), 0.8 * Math.sin(angle)]);
  }

  /** Give every object a handle for the keyboard; it lies over the object. */
  placeHandles(objects) {
    while (this.handles.length > objects.length) this.handles.pop().remove();
    while (this.handles.length < objects.length) this.handles.push(this.makeHandle(this.handles.length));
    objects.forEach((place, i) => {
      const [x, y] = toPixels(place);
      this.handles[i].style.left = `${(100 * x) / 640}%`;
      this.handles[i].style.top = `${(100 * y) / 480}%`;
    });
  }

  makeHandle(object) {
    const label = `${capital(objectName(object))} object: arrow keys move it`;
    const handle = make("button", { type: "button", className: "handle", "aria-label": label, title: label });
    handle.addEventListener("keydown", (event) => {
      const way = ARROWS[event.key];
      if (!way || !this.header) return;
      event.preventDefault();
      this.drag(object, this.header.objects[object].map((x, i) => x + STEP * way[i]));
    });
    this.stage.element.append(handle);
    return handle;
  }
}
