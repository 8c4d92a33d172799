/** Teach: two signs and a movement, again and again; the robot says what it makes of them. */

import * as api from "./api.js";
import { select, startBelief } from "./belief.js";
import { attempt, button, byId, complain, make, settle, whisper } from "./dom.js";
import { Draft } from "./draft.js";
import { SignPad, fitted } from "./pad.js";
import { BUILT_IN, Roles } from "./people.js";
import { counted, examples, promptText, sentence } from "./prompts.js";
import { onUndoKeys } from "./shortcuts.js";
import { change, demonstration, path, people, refresh, store, subscribe } from "./store.js";
import { TeachTable } from "./teachtable.js";

const SHOW_SPEED = 4; // times as fast as it was drawn

export class Teach {
  /** @param {function} replay called with the number of a demonstration that is to be seen in Look */
  constructor(replay) {
    this.draft = new Draft();
    this.busy = false;
    this.wish = null;
    this.showing = 0; // which demonstration is played here, from 1; 0 for none
    this.pads = [1, 2].map((number) => new SignPad(number, (byHand) => this.signed(byHand)));
    byId("teach-pads").append(...this.pads.map((pad) => pad.element));
    this.table = new TeachTable(byId("teach-stage"), (byHand) => this.moved(byHand));
    this.roles = new Roles(byId("teach-roles"), () => this.continue());
    this.makeButtons();
    startBelief({
      replay,
      redraw: (n) => this.redraw(n),
      remove: (n) => this.remove(n),
      wish: (wish) => this.follow(wish),
    });
    subscribe((session, before) => this.changed(session, before));
  }

  makeButtons() {
    this.teachIt = button("Teach this", () => this.submit(), { className: "main", id: "teach-it" });
    this.again = button("Clear all", () => this.begin());
    this.undo = button("Undo", () => this.edit("undo"), { id: "undo" });
    this.redo = button("Redo", () => this.edit("redo"), { id: "redo" });
    this.back = button("Keep it as it was", () => this.leaveRedraw(), { hidden: true });
    byId("teach-actions").append(this.teachIt, this.again, this.undo, this.redo, this.back);
    onUndoKeys((what) => store.view === "teach" && !this[what].disabled && this.edit(what));
  }

  /** The session is another, or another revision of it. */
  changed(session, before) {
    const other = before?.id !== session.id;
    if (other) {
      this.draft.open(session.id);
      this.roles.allow(session.language !== null);
      this.roles.mine();
      this.wish = null;
    }
    this.undo.disabled = !session.can_undo;
    this.redo.disabled = !session.can_redo;
    const moved = this.draft.place(session);
    if (moved && !other && this.drawn) complain("The table changed, as this session was changed elsewhere. Please draw again.");
    if (other || moved) this.restore();
    else this.tell();
  }

  get drawn() {
    return this.pads.some((pad) => pad.parts.length) || this.table.hand !== null;
  }

  /** Show the table, and what was drawn on it before a reload. */
  restore() {
    const { number, parts, hand } = this.draft;
    this.pads.forEach((pad, i) => pad.put(parts[i]));
    if (number === null) this.table.open(store.session.next.scene, path(`scene.jpg?revision=${store.session.revision}`), hand);
    else attempt(async () => this.openOld(await demonstration(number)));
    this.tell();
    this.continue();
  }

  openOld(shown) {
    const scene = { objects: shown.objects, hand: shown.hand.points[0] };
    this.table.open(scene, path(`demonstrations/${shown.number}/scene.jpg`), this.draft.hand);
  }

  /** Begin the demonstration again with nothing drawn. */
  begin() {
    this.draft.clear();
    this.restore();
  }

  signed(byHand) {
    if (this.showing) return;
    this.draft.keep(this.pads.map((pad) => pad.parts), this.table.hand);
    this.tell();
    if (byHand) this.continue();
  }

  moved() {
    if (this.showing) return;
    this.draft.keep(this.pads.map((pad) => pad.parts), this.table.hand);
    this.tell();
  }

  /** Show what is to be done, and what can be done. */
  tell() {
    const { session } = store;
    if (this.showing && this.showing <= session.demonstrations.length) return this.tellShown(this.showing - 1);
    const old = this.draft.number;
    const ready = this.pads.every((pad) => pad.stroke) && this.table.hand !== null;
    this.teachIt.disabled = !ready || this.busy;
    this.teachIt.textContent = this.busy ? "Learning…" : old === null ? "Teach this" : `Save demonstration ${old}`;
    this.back.hidden = old === null;
    byId("teach-count").textContent = counted(session, old);
    const prompt = old === null ? (this.wish ?? session.next.prompt) : null;
    byId("teach-prompt").textContent = sentence(session, prompt, old);
    byId("teach-examples").replaceChildren(...examples(prompt, this.wish !== null));
    return this.choices();
  }

  /** Show what is being played. */
  tellShown(number) {
    const { prompt, by } = store.session.demonstrations[number];
    const { language } = store.session;
    this.teachIt.disabled = true;
    byId("teach-count").textContent = `Demonstration ${number}${by ? `, by ${by}` : ""}`;
    byId("teach-prompt").textContent = prompt && language ? promptText(language, prompt) : "";
    byId("teach-examples").replaceChildren();
  }

  choices() {
    const host = byId("teach-choices");
    const back = () => button("Back to the list", () => this.follow(null));
    host.replaceChildren(...(this.wish ? [back()] : []));
  }

  /** Demonstrate what the robot would like to see. */
  follow(wish) {
    if (this.draft.number !== null) this.leaveRedraw();
    this.wish = wish;
    if (wish) this.roles.mine();
    this.tell();
    byId("teach-prompt").scrollIntoView({ block: "nearest" });
  }

  async submit() {
    const signs = this.pads.map((pad) => pad.stroke);
    const { number, hand } = { number: this.draft.number, hand: this.table.hand };
    if (this.busy || signs.includes(null) || !hand) return;
    this.setBusy(true);
    const body = { signs, hand, prompted: this.wish === null, by: this.roles.by };
    const done = await attempt(() =>
      change((revision) => {
        const whole = { revision, ...body };
        return number === null ? api.post(path("demonstrations"), whole) : api.put(path(`demonstrations/${number}`), whole);
      }).then((session) => this.taught(session, number)),
    );
    this.setBusy(false);
    if (done) this.continue();
  }

  taught(session, number) {
    this.wish = null;
    this.draft.clear();
    this.draft.place(session);
    this.restore();
    const which = number ?? session.demonstrations.length - 1;
    select(which);
    whisper(session.belief?.failed ?? byId("chosen-belief")?.textContent ?? "");
    return true;
  }

  setBusy(busy) {
    this.busy = busy;
    byId("teach").setAttribute("aria-busy", String(busy));
    this.tell();
  }

  edit(what) {
    return attempt(() => change((revision) => api.post(path(what), { revision })));
  }

  async remove(number) {
    if (this.draft.number !== null) this.leaveRedraw();
    await attempt(() => change((revision) => api.remove(path(`demonstrations/${number}?revision=${revision}`))));
    whisper(`Demonstration ${number} is deleted; undo brings it back.`);
  }

  async redraw(number) {
    const shown = await attempt(() => demonstration(number));
    if (!shown) return;
    this.wish = null;
    this.roles.mine();
    this.draft.redraw(shown, fitted);
    this.restore();
    byId("teach-prompt").scrollIntoView({ block: "nearest" });
  }

  leaveRedraw() {
    this.draft.clear();
    this.restore();
  }

  /** Let built-in people do their part, if it is their turn. */
  async continue() {
    const prompt = store.session?.next.prompt;
    if (this.playing || this.busy || !prompt || this.draft.number !== null || store.view !== "teach") return;
    this.playing = true;
    try {
      await this.act(prompt);
    } catch (problem) {
      this.roles.mine();
      complain(problem);
    } finally {
      this.playing = false;
    }
  }

  async act(prompt) {
    const same = () => store.session.next.prompt === prompt;
    const over = this.roles.signs === BUILT_IN && this.roles.movement === BUILT_IN && store.session.next.left === 0;
    if (over) return this.roles.mine();
    if (this.roles.signs === BUILT_IN && !this.pads.some((pad) => pad.parts.length)) {
      const { signs } = await people("signs", prompt);
      for (const [i, pad] of this.pads.entries()) if (!same() || !(await pad.play(signs[i]))) return undefined;
    }
    if (this.roles.movement !== BUILT_IN || !this.pads.every((pad) => pad.stroke)) return undefined;
    const { hand } = await people("movement", prompt);
    if (!same() || !(await this.table.play(hand))) return undefined;
    settle();
    setTimeout(() => this.submit());
    return undefined;
  }

  /** Play a demonstration that was made already, on this table; a newer one cuts it short. */
  async perform(number) {
    const shown = await demonstration(number);
    this.showing = number + 1;
    this.tell();
    this.pads.forEach((pad) => pad.clear(false));
    this.table.open({ objects: shown.objects, hand: shown.hand.points[0] }, path(`demonstrations/${number}/scene.jpg`), null);
    for (const [i, pad] of this.pads.entries()) if (!(await pad.play(shown.signs[i], SHOW_SPEED))) return;
    await this.table.play(shown.hand, SHOW_SPEED);
    if (this.showing !== number + 1) return;
    this.showing = 0;
    this.restore();
  }

  /** The view is opened. */
  async enter() {
    await attempt(() => refresh());
    this.continue();
  }
}
