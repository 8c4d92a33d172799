/** The table of Teach: a movement is drawn on it, beginning at the hand. */

import { blob } from "./api.js";
import { byId, make, showError } from "./dom.js";
import { KEYS_HELP, followKeys } from "./keypen.js";
import { playing } from "./pad.js";
import { Recording, TOO_LONG, between, distance, followPointer } from "./pen.js";
import { Stage, drawAim, drawHand, drawLetters, drawObjects, drawPath, toPixels } from "./stage.js";
import { store } from "./store.js";

const NEAR = 0.06; // m, from the hand's place; what begins there begins at the hand
const FINGER = 28; // CSS pixels, the same for fingers on small screens
const LEAST = 0.02; // m; what reaches less far was a tap
const SHOWN_SIZE = 0.08; // m, half of a movement that is shown
const SHOWN_STEPS = 20; // on the way to where it begins
const SHOWN_PACE = 0.03; // s, from point to point
const SHOWN_REST = 2500; // ms, in which what was shown stays
const SHOWN_INK = "#6b2185";
const SHOWN = "So it counts: once about the object, then the hand rests.";
const KEYS = { step: 1 / 64, seconds: 0.06 };
const HINT = "Begin at the hand, the yellow dot; begun elsewhere, it starts there.";

export class TeachTable {
  /**
   * @param {function} changed called when the movement is drawn or gone
   * @param {function} free called when a person puts the pen down; tells whether the table is theirs
   */
  constructor(host, changed, free) {
    this.changed = changed;
    this.free = free;
    this.stage = new Stage(host, "The table with its objects; draw the movement here");
    this.scene = null;
    this.hand = null;
    this.shown = null; // the way of a hand that shows what counts
    this.drawing = null;
    this.aimed = null; // where the keyboard's pen is
    this.played = false; // whether built-in people are drawing
    this.turn = 0;
    const hooks = {
      begin: (at) => this.begin(at),
      move: (at) => this.move(at),
      end: () => this.end(),
      cancel: () => this.cancel(),
    };
    const { sheet } = this.stage;
    sheet.setAttribute("role", "application");
    Object.assign(sheet, { tabIndex: 0, title: KEYS_HELP });
    followPointer(sheet, hooks);
    followKeys(sheet, { ...hooks, home: () => this.home(), aim: (at) => this.aim(at) }, KEYS);
  }

  /** Show a scene, {objects, hand}, its picture, and the movement that is drawn already, or null. */
  async open(scene, picture, hand) {
    this.take();
    this.drawing = null;
    [this.scene, this.hand] = [scene, hand];
    this.hint(HINT);
    this.stage.waiting ||= this.picture !== picture;
    this.stage.draw((pen) => this.paint(pen));
    if (this.picture === picture) return;
    this.picture = picture;
    try {
      const jpeg = store.studio.can_draw ? await blob(picture) : null;
      if (this.picture === picture) await this.stage.show(jpeg);
    } catch (problem) {
      if (this.picture !== picture) return;
      this.picture = null;
      await this.stage.show(null);
      showError(problem);
    }
    this.stage.paint();
  }

  /** Show another movement, or none, on the same table. */
  put(hand) {
    this.take();
    this.hand = hand;
    this.stage.paint();
  }

  /** Stop what is played or shown: the table is needed. */
  take() {
    this.turn += 1;
    this.shown = null;
  }

  /** Show what counts: a hand goes to where a movement, points within -1..1, begins, makes it once about a place, and rests. */
  async show(movement, [x, y]) {
    this.take();
    const { turn } = this;
    const once = movement.map(([u, v]) => [x + SHOWN_SIZE * u, y + SHOWN_SIZE * v]);
    const way = Array.from({ length: SHOWN_STEPS }, (_, i) => between(this.scene.hand, once[0], i / SHOWN_STEPS));
    const points = [...way, ...once];
    this.hint(SHOWN);
    await playing(points.map((_, i) => i * SHOWN_PACE), (count) => {
      if (turn !== this.turn) return false;
      this.shown = points.slice(0, count);
      this.stage.paint();
      return true;
    }, 1);
    await new Promise((done) => setTimeout(done, SHOWN_REST));
    if (turn !== this.turn) return;
    this.shown = null;
    this.hint(HINT);
    this.stage.paint();
  }

  paint(pen) {
    if (!this.scene) return;
    if (!this.stage.photographed) drawObjects(pen, this.scene.objects);
    drawLetters(pen, this.scene.objects);
    if (this.aimed) drawAim(pen, this.aimed);
    const made = this.drawing ?? this.hand;
    if (made) drawPath(pen, made.points);
    if (this.shown) drawPath(pen, this.shown, "table", SHOWN_INK);
    if (this.shown?.length) return drawHand(pen, this.shown.at(-1));
    drawHand(pen, this.drawing || this.played ? made.points.at(-1) : (made?.points[0] ?? this.scene.hand));
    return undefined;
  }

  /** Where the keyboard's pen is at first: at the hand. */
  home() {
    const [x, y] = toPixels(this.scene?.hand ?? [0, 0]);
    return [x / 640, y / 480];
  }

  aim(at) {
    this.aimed = at && this.stage.metres(at);
    this.stage.paint();
  }

  begin(at) {
    if (!this.free() || !this.scene || this.stage.waiting) return false;
    const near = Math.max(NEAR, FINGER * this.stage.pixel);
    this.take();
    this.drawing = new Recording();
    if (distance(this.stage.metres(at), this.scene.hand) <= near) this.drawing.add(this.scene.hand, at.time - 0.01);
    this.move(at);
    return true;
  }

  /** Go on; a pen that leaves the picture draws along its edge, where it is seen. */
  move(at) {
    if (!this.drawing) return; // the table changed under the pen
    this.drawing.add(this.stage.metres(this.stage.within(at)), at.time);
    this.stage.paint();
  }

  end() {
    const made = this.drawing;
    if (!made) return;
    this.drawing = null;
    this.hand = made.reach >= LEAST ? made.stroke : null;
    this.hint(this.hand ? "Draw it again from the yellow dot if you like." : HINT, !this.hand);
    this.stage.paint();
    this.changed();
    if (made.late) showError(TOO_LONG);
  }

  cancel() {
    this.drawing = null;
    this.stage.paint();
  }

  /** Play a movement that was drawn elsewhere, in time; resolves with whether it came to its end. */
  async play(stroke, speed) {
    this.take();
    const { turn } = this;
    await playing(stroke.times, (count) => {
      if (turn !== this.turn) return false;
      this.played = count > 0;
      this.hand = count ? { points: stroke.points.slice(0, count), times: stroke.times.slice(0, count) } : null;
      this.stage.paint();
      return true;
    }, speed);
    this.played = false;
    if (turn !== this.turn) return false;
    this.hand = stroke;
    this.stage.paint();
    this.changed();
    return true;
  }

  hint(text, strong = false) {
    byId("teach-hint").replaceChildren(make(strong ? "strong" : "span", { textContent: text }));
  }
}
