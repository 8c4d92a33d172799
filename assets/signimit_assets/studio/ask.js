/** Ask: two signs, and the arm answers on the physics, while it is watched, dragged about and shoved. */

import * as api from "./api.js";
import { answersList } from "./answers.js";
import { AskTable } from "./asktable.js";
import { attempt, button, byId, capital, make } from "./dom.js";
import { SignPad, fitted } from "./pad.js";
import { thumbPicture } from "./pictures.js";
import { QUESTION } from "./draft.js";
import { accept, inBackground, objectName, path, people, refresh, store, subscribe } from "./store.js";
import { taughtSigns } from "./taught.js";

const LIFT = 700; // ms after which a lifted pen has ended the second sign
const INVITATION = "Draw two signs; the arm answers as the second one is done.";
const UNTAUGHT = "The robot has not been taught anything yet. Demonstrate something first, in Teach.";

/** Say how an answer was understood, and what the arm makes of it. */
function understood({ text, held }, done) {
  if (held) return `Not sure, so the arm waits. Did you mean ${text}? If not, draw the two signs again.`;
  return `${capital(text)}${done ? ". Done." : ""}`;
}

export class Ask {
  /**
   * @param {LiveTable} live
   * @param {function} replay called with the number of an answer
   * @param {function} correct called with the signs of an answer that was wrong
   * @param {function} keep called with the strokes of a first sign, so that they are not lost
   */
  constructor(live, replay, correct, keep) {
    this.replay = replay;
    this.correct = correct;
    this.keep = keep;
    this.request = null;
    this.asked = null;
    this.asking = false;
    this.done = null; // number of the answer whose movement came to its end
    this.table = new AskTable(byId("ask-stage"), live, (header) => this.framed(header));
    this.pads = [1, 2].map((number) => new SignPad(number, (byHand) => this.signed(number, byHand), () => this.started(number)));
    byId("ask-pads").append(...this.pads.map((pad) => pad.element));
    this.pads[1].canvas.addEventListener("keydown", () => this.lifted && this.await());
    byId("ask-actions").append(
      button("New scene", () => this.newScene(), { id: "new-scene" }),
      button("Shove the hand", () => this.table.shoveAnywhere(), { id: "shove" }),
      button("Stop", () => attempt(() => api.post(path("stop"))), { id: "stop" }),
    );
    this.makeThumbs();
    subscribe((session, before) => this.changed(session, before));
  }

  changed(session, before) {
    const other = before?.id !== session.id;
    if (other) {
      this.asked = null;
      this.stopWaiting();
      this.pads.forEach((pad) => pad.clear(false));
      if (before && store.view === "ask") attempt(() => this.takeTable());
    }
    this.takeUp(session.draft.drawn[QUESTION] ?? [], other ? [] : (before.draft.drawn[QUESTION] ?? []));
    this.tell();
    this.showTaught(before);
    this.showPeople(before);
    this.showAnswers();
  }

  /** Show the first sign of a question that was begun here earlier or elsewhere. */
  takeUp(question, known) {
    const [first] = this.pads;
    const news = question.length && JSON.stringify(question) !== JSON.stringify(known);
    if (news && !first.drawing) first.put(question);
  }

  /** The view is opened: the live table becomes this session's, unless it is already. */
  async enter() {
    this.table.watch(true);
    await attempt(async () => {
      const header = await this.table.seen();
      if (header.session !== store.session.id) await this.takeTable();
    });
  }

  leave() {
    this.table.watch(false);
  }

  takeTable() {
    return api.post(path("table"));
  }

  newScene() {
    this.asked = null;
    return attempt(async () => {
      await this.takeTable();
      this.tell();
    });
  }

  /** A person puts the pen down: a first sign after an answer begins another utterance. */
  started(number) {
    this.stopWaiting();
    this.request = null;
    if (number === 1 && this.pads[1].stroke) this.pads[1].clear(false);
  }

  /** A sign is drawn or cleared; the second one may have another stroke, so it is awaited before the arm is asked. */
  signed(number, byHand) {
    if (byHand) this.stopWaiting();
    if (byHand && number === 1) this.keep(this.pads[0].parts);
    if (!byHand || number !== 2 || !this.pads.every((pad) => pad.stroke)) return;
    this.await();
  }

  /** Ask when nothing more has come for a while: another stroke, or a key that moves the pen to one. */
  await() {
    this.stopWaiting();
    this.lifted = setTimeout(() => {
      this.lifted = null;
      this.ask();
    }, LIFT);
  }

  stopWaiting() {
    clearTimeout(this.lifted);
    this.lifted = null;
  }

  async ask() {
    this.asking = true;
    await attempt(async () => {
      const signs = this.pads.map((pad) => pad.stroke);
      if (this.table.header && this.table.header.session !== store.session.id) await this.takeTable();
      const body = this.request ? { signs, request: this.request } : { signs };
      this.asked = await api.post(path("ask"), body);
      this.tell();
      await refresh();
    });
    this.asking = false;
  }

  /** Let the built-in interactant ask for something. */
  askFor(request) {
    return attempt(async () => {
      const { signs } = await people("signs", request);
      for (const [i, pad] of this.pads.entries()) if (!(await pad.play(signs[i]))) return;
      this.request = request;
      await this.ask();
    });
  }

  /** Let the arm do what it has asked back about. */
  insist() {
    return attempt(async () => {
      this.asked = await api.post(path(`answers/${this.asked.number}/insist`));
      await refresh();
      this.tell();
    });
  }

  /** Ask for the same once more, with the same signs. */
  repeat() {
    const { number, request } = this.asked;
    return attempt(async () => {
      const { signs } = await api.get(path(`answers/${number}`));
      this.pads.forEach((pad, i) => pad.put([fitted(signs[i])]));
      this.request = request;
      await this.ask();
    });
  }

  /** Lead on from a wrong answer: its signs become a demonstration of what was meant. */
  meant(number) {
    return attempt(async () => this.correct((await api.get(path(`answers/${number}`))).signs));
  }

  framed(header) {
    const strange = header.session !== null && header.session !== store.session?.id;
    const done = strange ? null : header.done;
    if (done !== this.done) {
      this.done = done;
      this.tell();
    }
    byId("ask-hint").textContent = strange
      ? "Another session has the table; it comes here when you ask, or with New scene."
      : "Drag the objects; flick the hand to shove it.";
    if (!strange && header.text && !this.asking && header.answer !== this.asked?.number) this.adopt(store.session.answers[header.answer]);
  }

  /** Show an answer that was asked for elsewhere, and its signs, unless a person has begun to draw others. */
  adopt(answer) {
    if (!answer) return; // the session with it is on its way
    this.asked = answer;
    this.tell();
    inBackground(async () => {
      const { signs } = await api.get(path(`answers/${answer.number}`));
      const free = !store.session.draft.drawn[QUESTION]?.length && !this.pads.some((pad) => pad.drawing);
      if (free && this.asked === answer) this.pads.forEach((pad, i) => pad.put([fitted(signs[i])]));
    });
  }

  tell() {
    const taught = store.session.demonstrations.length > 0;
    const answer = this.asked && (store.session.answers[this.asked.number] ?? this.asked);
    const done = answer && this.done === answer.number;
    const sentence = answer ? understood(answer, done) : taught ? INVITATION : UNTAUGHT;
    byId("ask-insist").hidden = !answer?.held;
    byId("ask-again").hidden = !done;
    byId("ask-meant").hidden = answer?.verdict !== false;
    const host = byId("ask-sentence");
    if (host.textContent !== sentence) host.textContent = sentence;
    this.showVerdict(answer);
  }

  /** Show the thumbs of an answer; they stay the same elements, so that the keyboard keeps its place. */
  showVerdict(answer) {
    byId("ask-verdict").hidden = !answer;
    for (const [good, thumb] of this.thumbs) thumb.setAttribute("aria-pressed", String(answer?.verdict === good));
  }

  makeThumbs() {
    const thumb = (good, word, title) => {
      const made = button("", () => this.judge(good), { className: "verdict", title });
      made.append(thumbPicture(good), word);
      return [good, made];
    };
    this.thumbs = [thumb(true, "Right", "That is what I asked for"), thumb(false, "Wrong", "That is not what I asked for")];
    byId("ask-choices").append(
      button("Move anyway", () => this.insist(), { className: "main", id: "ask-insist", hidden: true }),
      button("Do it again", () => this.repeat(), { id: "ask-again", hidden: true }),
      button("Show what I meant", () => this.meant(this.asked.number), { id: "ask-meant", hidden: true }),
    );
    byId("ask-verdict").append(...this.thumbs.map(([, made]) => made));
  }

  /** Keep a verdict; the same once more takes it back. */
  judge(good, { number, verdict } = store.session.answers[this.asked.number] ?? this.asked) {
    const wanted = { good: verdict === good ? null : good };
    return attempt(async () => accept(await api.post(path(`answers/${number}/verdict`), wanted)));
  }

  showTaught(before) {
    if (before?.id === store.session.id && before.revision === store.session.revision) return;
    const shown = taughtSigns(store.session.belief);
    byId("ask-taught").hidden = !shown.length;
    byId("ask-taught").replaceChildren(...shown);
  }

  showPeople(before) {
    const { language } = store.session;
    if (before?.id === store.session.id) return;
    const host = byId("ask-people");
    const title = make("h3", { textContent: "Let a built-in person ask" });
    if (!language) {
      host.replaceChildren(title, make("p", { className: "quiet", textContent: "Built-in people do not know signs that you made up." }));
      return;
    }
    const held = new Set(language.unseen.map(({ movement, focus }) => `${movement} ${focus}`));
    const select = make("select", { id: "ask-request" });
    language.movements.forEach((name, movement) =>
      language.objects.forEach((object, focus) => {
        const never = held.has(`${movement} ${focus}`) ? " (never prompted for)" : "";
        select.append(make("option", { value: `${movement} ${focus}`, textContent: `${name} about ${object}${never}` }));
      }),
    );
    select.value = [...held][0] ?? select.value;
    const go = () => {
      const [movement, focus] = select.value.split(" ").map(Number);
      return this.askFor({ movement, focus });
    };
    host.replaceChildren(title, make("label", { className: "field" }, "Request", select), button("Ask for it", go, { id: "ask-for-it" }));
  }

  showAnswers() {
    const listeners = { judge: (answer) => this.judge(false, answer), correct: (n) => this.meant(n), replay: (n) => this.replay(n) };
    byId("ask-answers").replaceChildren(...answersList(store.session, listeners));
  }
}
