/** Replay of a demonstration or an answer, and its film. */

import { blob, get } from "./api.js";
import { attempt, button, byId, calm, capital, make } from "./dom.js";
import { fitted } from "./pad.js";
import { passed } from "./pen.js";
import { beliefSentence, signPicture } from "./pictures.js";
import { Stage, drawHand, drawLetters, drawObjects, drawPath, drawRing } from "./stage.js";
import { demonstration, path, store, subscribe } from "./store.js";

const SPEED = 1.5; // times as fast as it was

export class Replay {
  constructor() {
    this.choice = make("select", { id: "replay-choice", onchange: () => this.open() });
    this.play = button("Play", () => this.toggle(), { className: "main", id: "replay-play" });
    this.slider = make("input", { type: "range", min: 0, max: 1000, value: 1000, "aria-label": "Time", oninput: () => this.seek() });
    this.film = button("Download the film (mp4)", () => this.download(), { id: "film" });
    this.signs = make("div", { className: "signs" });
    this.sentence = make("p", { className: "lead", id: "replay-sentence" });
    const host = make("div", {});
    byId("look-replay").append(
      make("h3", { textContent: "Replay" }),
      make("div", { className: "row" }, make("label", { className: "field" }, "What", this.choice), this.signs),
      this.sentence,
      host,
      make("div", { className: "row" }, this.play, this.slider),
      make("div", { className: "row" }, this.film),
    );
    this.stage = new Stage(host, "What was drawn, or what the arm did");
    this.stage.draw((pen) => this.paint(pen));
    subscribe((session, before) => this.changed(session, before));
  }

  changed(session, before) {
    const kept = before?.id === session.id ? this.choice.value : "";
    const options = [
      ...session.demonstrations.map(({ number }) => [`demonstrations/${number}`, `Demonstration ${number + 1}`]),
      ...session.answers.map(({ number, text }) => [`answers/${number}`, `Answer ${number + 1}: ${text}`]),
    ];
    this.choice.replaceChildren(...options.map(([value, textContent]) => make("option", { value, textContent })));
    if (options.some(([value]) => value === kept)) this.choice.value = kept;
    for (const control of [this.choice, this.play, this.film, this.slider]) control.disabled = !options.length;
    this.stale = true;
    if (store.view === "look" && !this.moving) this.enter();
  }

  enter() {
    if (this.stale) return this.open();
    return undefined;
  }

  /** Choose what to replay, from outside, and play it. */
  async show(what) {
    this.choice.value = what;
    await this.open();
    if (this.what && !this.moving) this.toggle();
  }

  async open() {
    this.stale = false;
    this.moving = false;
    this.what = null;
    const chosen = this.choice.value;
    this.play.textContent = "Play";
    if (!chosen) return this.nothing();
    await attempt(async () => {
      const what = chosen.startsWith("d") ? await shownDemonstration(chosen) : await shownAnswer(chosen);
      if (chosen !== this.choice.value) return;
      await this.stage.show(what.picture);
      if (chosen !== this.choice.value) return;
      this.what = what;
      this.sentence.textContent = what.sentence;
      this.signs.replaceChildren(...what.signs.map((sign, i) => signPicture(fitted(sign).points, `Sign ${i + 1}`)));
      this.put(what.times.length);
    });
    return undefined;
  }

  nothing() {
    this.sentence.textContent = "Nothing to replay yet.";
    this.signs.replaceChildren();
  }

  put(count) {
    this.count = count;
    this.slider.value = String(Math.round((1000 * count) / this.what.times.length));
    this.stage.paint();
  }

  seek() {
    this.moving = false;
    this.play.textContent = "Play";
    if (this.what) this.put(Math.max(1, Math.round((this.slider.value / 1000) * this.what.times.length)));
  }

  toggle() {
    if (!this.what) return;
    this.moving = !this.moving;
    this.play.textContent = this.moving ? "Pause" : "Play";
    if (!this.moving) return;
    if (this.count >= this.what.times.length || calm()) this.put(1);
    this.begun = performance.now() - (1000 * this.what.times[this.count - 1]) / SPEED;
    this.step(this.what);
  }

  step(what) {
    if (!this.moving || what !== this.what || store.view !== "look") return;
    const { times } = what;
    const now = (SPEED * (performance.now() - this.begun)) / 1000;
    this.put(passed(times, now, this.count));
    if (this.count < times.length) requestAnimationFrame(() => this.step(what));
    else this.toggle();
  }

  paint(pen) {
    if (!this.what || !this.count) return;
    const { what, count } = this;
    const objects = what.objectsAt(what.times[count - 1]);
    if (!this.stage.photographed) drawObjects(pen, objects);
    drawLetters(pen, objects);
    if (what.focus !== null) drawRing(pen, objects[what.focus], what.sure);
    const passed = what.path.slice(0, count);
    drawPath(pen, passed, what.plane);
    drawHand(pen, passed.at(-1), what.plane);
  }

  async download() {
    const what = this.choice.value;
    this.film.disabled = true;
    this.film.textContent = "The film is being made…";
    await attempt(async () => save(await blob(path(`${what}/film.mp4`)), `${what.replace("s/", "-")}.mp4`));
    this.film.textContent = "Download the film (mp4)";
    this.film.disabled = false;
  }
}

async function shownDemonstration(chosen) {
  const number = Number(chosen.split("/")[1]);
  const shown = await demonstration(number);
  const { belief } = store.session;
  const known = belief && !belief.failed;
  const focus = known && belief.focus[number] >= 0 ? belief.focus[number] : null;
  return {
    signs: shown.signs,
    path: shown.hand.points,
    times: shown.hand.times,
    plane: "table",
    objectsAt: () => shown.objects,
    focus,
    sure: focus === null ? 0 : belief.focus_probability[number][focus],
    sentence: known ? `Understood: ${beliefSentence(belief, number).toLowerCase()}` : "",
    picture: store.studio.can_draw ? await blob(path(`${chosen}/scene.jpg`)) : null,
  };
}

async function shownAnswer(chosen) {
  const answer = await get(path(chosen));
  if (answer.path.length < 2) throw new Error("The arm has not moved in this answer yet.");
  return {
    signs: answer.signs,
    path: answer.path,
    times: answer.times,
    plane: "hand",
    objectsAt: (time) => objectsAt(answer.objects, time),
    focus: answer.focus,
    sure: answer.confidence,
    sentence: capital(answer.text),
    picture: null,
  };
}

/** Return where the objects are at a time, from [since, places] in order; before the first they are there already. */
export function objectsAt(moves, time) {
  return (moves.findLast(([since]) => since <= time) ?? moves[0])[1];
}

/** Hand a file to the person at the page. */
function save(content, name) {
  const address = URL.createObjectURL(content);
  make("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
}
