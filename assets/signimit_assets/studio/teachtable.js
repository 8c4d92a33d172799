/** The table of Teach: a movement is drawn on it, beginning at the hand. */

import { blob } from "./api.js";
import { byId, make, showError } from "./dom.js";
import { playing } from "./pad.js";
import { Recording, TOO_LONG, distance, followPointer } from "./pen.js";
import { Stage, drawHand, drawLetters, drawObjects, drawPath } from "./stage.js";
import { store } from "./store.js";

const NEAR = 0.06; // m, from the hand's place; what begins there begins at the hand
const FINGER = 28; // CSS pixels, the same for fingers on small screens
const LEAST = 0.02; // m; what reaches less far was a tap
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
    this.drawing = null;
    this.played = false; // whether built-in people are drawing
    this.turn = 0;
    followPointer(this.stage.sheet, {
      begin: (at) => this.begin(at),
      move: (at) => this.move(at),
      end: () => this.end(),
      cancel: () => this.cancel(),
    });
  }

  /** Show a scene, {objects, hand}, its picture, and the movement that is drawn already, or null. */
  async open(scene, picture, hand) {
    this.turn += 1;
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
    this.turn += 1;
    this.hand = hand;
    this.stage.paint();
  }

  paint(pen) {
    if (!this.scene) return;
    if (!this.stage.photographed) drawObjects(pen, this.scene.objects);
    drawLetters(pen, this.scene.objects);
    const made = this.drawing ?? this.hand;
    if (made) drawPath(pen, made.points);
    drawHand(pen, this.drawing || this.played ? made.points.at(-1) : (made?.points[0] ?? this.scene.hand));
  }

  begin(at) {
    if (!this.free() || !this.scene || this.stage.waiting) return false;
    const near = Math.max(NEAR, FINGER * this.stage.pixel);
    this.turn += 1;
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
    this.turn += 1;
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
