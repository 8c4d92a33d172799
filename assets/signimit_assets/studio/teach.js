/** Teach: two signs and a movement, again and again; the robot says what it makes of them. */

import * as api from "./api.js";
import { select, startBelief } from "./belief.js";
import { announce, attempt, button, byId, clearError, make, showError } from "./dom.js";
import { Draft, HAND, SIGNS } from "./draft.js";
import { SignPad, fitted } from "./pad.js";
import { BUILT_IN, Roles } from "./people.js";
import { counted, examples, missing, sentence, shownTexts } from "./prompts.js";
import { change, demonstration, path, people, refresh, store, subscribe } from "./store.js";
import { TeachTable } from "./teachtable.js";

const MEANT = "With these two signs you asked for something else. Draw the movement that you meant, about the object that you meant.";
const ENOUGH = 12; // demonstrations in made-up signs, after which it is worth while to ask
const SHOW_SPEED = 4; // times as fast as it was drawn

export class Teach {
  /** @param {function} replay called with the number of a demonstration that is to be seen in Look */
  constructor(replay) {
    this.draft = null;
    this.busy = false;
    this.mine = false; // whether something of what is drawn was drawn in this page
    this.wish = null;
    this.showing = 0; // which demonstration is played here, from 1; 0 for none
    this.pads = SIGNS.map((place, i) => new SignPad(i + 1, (byHand) => this.drew(place, this.pads[i].parts, byHand), () => this.isFree()));
    byId("teach-pads").append(...this.pads.map((pad) => pad.element));
    this.table = new TeachTable(byId("teach-stage"), () => this.drew(HAND, this.table.hand ? [this.table.hand] : []), () => this.isFree());
    this.roles = new Roles(byId("teach-roles"), () => this.continue());
    this.makeButtons();
    startBelief({ replay, redraw: (n) => this.redraw(n), remove: (n) => this.remove(n), wish: (wish) => this.follow(wish) });
    subscribe((session, before) => this.changed(session, before));
  }

  makeButtons() {
    this.teachIt = button("Teach this", () => this.submit(), { className: "main", id: "teach-it" });
    this.again = button("Clear all", () => this.begin());
    this.undo = button("Undo", () => this.edit("undo"), { id: "undo" });
    this.redo = button("Redo", () => this.edit("redo"), { id: "redo" });
    this.back = button("Keep it as it was", () => this.begin(), { hidden: true });
    byId("teach-actions").append(this.teachIt, this.again, this.undo, this.redo, this.back);
    onUndoKeys((what) => store.view === "teach" && !this[what].disabled && this.edit(what));
  }

  /** The session is another, or another revision of it. */
  changed(session, before) {
    const other = before?.id !== session.id;
    if (other) {
      this.draft = new Draft(session.id);
      this.roles.allow(session.language !== null);
      this.roles.mine();
      this.wish = null;
    }
    this.undo.disabled = !session.can_undo;
    this.redo.disabled = !session.can_redo;
    const places = this.draft.follow(session);
    if (places === null && !other && !this.busy && this.mine) showError("The table changed, as this session was changed elsewhere. Please draw again.");
    if (places === null) this.restore();
    else this.takeUp(places);
  }

  /** Show what another page drew, unless a person draws there now. */
  takeUp(places) {
    const { drawn } = this.draft;
    if (this.showing) return;
    this.pads.forEach((pad, i) => places.includes(SIGNS[i]) && !pad.drawing && pad.put(drawn[SIGNS[i]] ?? []));
    if (places.includes(HAND) && !this.table.drawing) this.table.put(drawn[HAND]?.[0] ?? null);
    this.tell();
  }

  /** Show the table, and what is drawn on it already. */
  restore() {
    const { number } = this.draft;
    this.showing = 0;
    if (number === null) this.open(store.session.next.scene, path(`scene.jpg?revision=${store.session.revision}`), [[], []], null);
    else attempt(async () => this.openOld(await demonstration(number)));
  }

  /** Show a demonstration that is drawn again: as it was, but for what is drawn anew. */
  openOld({ number, objects, hand, signs }) {
    if (this.draft.number !== number) return;
    const scene = { objects, hand: hand.points[0] };
    this.open(scene, path(`demonstrations/${number}/scene.jpg`), signs.map((sign) => [fitted(sign)]), hand);
  }

  open(scene, picture, signs, hand) {
    const { drawn } = this.draft;
    this.mine = false;
    this.pads.forEach((pad, i) => pad.put(drawn[SIGNS[i]] ?? signs[i]));
    const opened = this.table.open(scene, picture, drawn[HAND] ? (drawn[HAND][0] ?? null) : hand);
    const { demonstrations, next } = store.session;
    const first = !demonstrations.length && next.prompt && !Object.keys(drawn).length;
    if (first) opened.then(() => store.session.next === next && this.showHow(next.prompt));
    this.tell();
    this.continue();
  }

  /** Begin the demonstration again with nothing drawn. */
  begin() {
    this.draft.clear();
    this.restore();
  }

  /** The strokes at a place are others, or gone; a sign by hand may make it the turn of built-in people. */
  drew(place, strokes, byHand = false) {
    if (this.showing) return byHand && this.restore();
    this.mine = true;
    this.draft.keep({ [place]: strokes });
    this.tell();
    return byHand && this.continue();
  }

  /** A person puts the pen down; what is played here makes room first, and its table with it. */
  isFree() {
    if (!this.showing) return true;
    this.restore();
    return false;
  }

  /** Show what is to be done, and what can be done. */
  tell() {
    const { session } = store;
    if (this.showing) {
      this.teachIt.disabled = true;
      byId("teach-missing").textContent = "";
      byId("teach-examples").replaceChildren();
      [byId("teach-count").textContent, byId("teach-prompt").textContent] = shownTexts(session, this.showing - 1);
      return;
    }
    const old = this.draft.number;
    const ready = this.pads.every((pad) => pad.stroke) && this.table.hand !== null;
    this.teachIt.disabled = !ready || this.busy;
    byId("teach-missing").textContent = missing(this.pads.map((pad) => pad.stroke), this.table.hand);
    this.teachIt.textContent = this.busy ? "Learning…" : old === null ? "Teach this" : `Save demonstration ${old + 1}`;
    this.back.hidden = old === null;
    byId("teach-count").textContent = counted(session, old);
    const prompt = old === null ? (this.wish ?? session.next.prompt) : null;
    byId("teach-prompt").textContent = sentence(session, prompt, old);
    byId("teach-examples").replaceChildren(...examples(prompt, this.wish !== null));
    const shown = session.next.prompt ? session.next.left === 0 : session.demonstrations.length >= ENOUGH;
    const all = old === null && !this.wish && shown;
    const choices = this.wish ? [button("Back to the list", () => this.follow(null))] : [];
    if (prompt?.drawing) choices.push(button("Show me", () => this.showHow(prompt), { id: "show-me", disabled: this.table.hand !== null }));
    if (all) choices.push(button("Ask the arm now", () => byId("tab-ask").click(), { id: "go-ask" }));
    byId("teach-choices").replaceChildren(...choices);
  }

  /** Show on the table what counts of a movement, unless something is drawn or played there. */
  showHow({ drawing, focus }) {
    if (this.table.hand || this.table.drawing || this.playing) return undefined;
    return this.table.show(drawing, store.session.next.scene.objects[focus]);
  }

  /** Demonstrate what the robot would like to see. */
  follow(wish) {
    if (this.draft.number !== null) this.begin();
    this.wish = wish;
    if (wish) this.roles.mine();
    this.tell();
    byId("teach-prompt").scrollIntoView({ block: "nearest" });
  }

  /** Demonstrate what two signs were to ask for, when the arm did something else. */
  correct(signs) {
    this.begin();
    this.follow({ text: MEANT });
    const strokes = signs.map(fitted);
    this.pads.forEach((pad, i) => pad.put([strokes[i]]));
    this.mine = true;
    this.draft.keep(Object.fromEntries(SIGNS.map((place, i) => [place, [strokes[i]]])));
    this.tell();
  }

  async submit() {
    const signs = this.pads.map((pad) => pad.stroke);
    const { number, hand } = { number: this.draft.number, hand: this.table.hand };
    if (this.busy || signs.includes(null) || !hand) return;
    this.setBusy(true);
    const body = { signs, hand, prompted: this.wish === null, by: this.roles.by };
    await this.draft.flush(); // or the last stroke would come after the demonstration, and be one of the next
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
    this.draft.reset();
    this.restore();
    const which = number ?? session.demonstrations.length - 1;
    select(which);
    announce(session.belief?.failed ?? byId("chosen-belief")?.textContent ?? "");
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
    if (this.draft.number !== null) this.begin();
    await attempt(() => change((revision) => api.remove(path(`demonstrations/${number}?revision=${revision}`))));
    announce(`Demonstration ${number + 1} is deleted; undo brings it back.`);
  }

  async redraw(number) {
    const shown = await attempt(() => demonstration(number));
    if (!shown) return;
    this.wish = null;
    this.roles.mine();
    this.draft.reset(number);
    this.restore();
    byId("teach-prompt").scrollIntoView({ block: "nearest" });
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
      showError(problem);
    } finally {
      this.playing = false;
    }
  }

  async act(prompt) {
    const { id, revision } = store.session;
    const same = () => store.session.id === id && store.session.revision === revision;
    const over = this.roles.signs === BUILT_IN && this.roles.movement === BUILT_IN && store.session.next.left === 0;
    if (over) return this.roles.mine();
    if (this.roles.signs === BUILT_IN && !this.pads.some((pad) => pad.parts.length)) {
      const { signs } = await people("signs", prompt);
      for (const [i, pad] of this.pads.entries()) if (!same() || !(await pad.play(signs[i]))) return undefined;
    }
    if (this.roles.movement !== BUILT_IN || !this.pads.every((pad) => pad.stroke)) return undefined;
    const { hand } = await people("movement", prompt);
    if (!same() || !(await this.table.play(hand))) return undefined;
    clearError();
    setTimeout(() => this.submit());
    return undefined;
  }

  /** Play a demonstration that was made already, on this table; it stays until a newer one, or a person, takes its place. */
  async perform(number) {
    this.showing = number + 1;
    this.tell(); // at once: what is written never runs ahead of what is to be seen
    const shown = await demonstration(number);
    if (this.showing !== number + 1) return;
    this.pads.forEach((pad) => pad.clear(false));
    this.table.open({ objects: shown.objects, hand: shown.hand.points[0] }, path(`demonstrations/${number}/scene.jpg`), null);
    this.table.hint("");
    for (const [i, pad] of this.pads.entries()) if (!(await pad.play(shown.signs[i], SHOW_SPEED))) return;
    await this.table.play(shown.hand, SHOW_SPEED);
  }

  /** The view is opened. */
  async enter() {
    if (this.showing) this.restore();
    await attempt(() => refresh());
    this.continue();
  }
}

/** Call back with "undo" or "redo" at Ctrl+Z, Ctrl+Shift+Z and Ctrl+Y, unless text is being typed. */
function onUndoKeys(callback) {
  document.addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.target.closest("input, select, textarea")) return;
    const what = { z: event.shiftKey ? "redo" : "undo", y: "redo" }[event.key.toLowerCase()];
    if (what && callback(what)) event.preventDefault();
  });
}
