/** Look: replay, similarities, and the paper's figures of this session. */

import { blob } from "./api.js";
import { byId, make } from "./dom.js";
import { Matrix } from "./matrix.js";
import { Replay } from "./replay.js";
import { path, store, subscribe } from "./store.js";

const FIGURES = {
  4: "The demonstrations, seen from each object",
  5: "Similarities in every pair of frames",
  6: "Best similarities",
  7: "What the arm drew",
};

const OLD = "This is from before the last change; it is being drawn again…";

export class Look {
  constructor() {
    this.replay = new Replay();
    this.matrix = new Matrix();
    this.figures = new Map();
    this.compared = "";
    byId("look-figures").append(make("h3", { textContent: "Figures" }), ...Object.keys(FIGURES).map((n) => this.figure(n)));
    subscribe(() => store.view === "look" && this.enter());
  }

  figure(number) {
    const picture = make("img", { alt: `Figure ${number}: ${FIGURES[number]}` });
    const whole = make("a", { target: "_blank", title: "Open at full size", hidden: true }, picture);
    const note = make("p", { className: "quiet" });
    const link = (suffix) => make("a", { textContent: suffix.toUpperCase(), download: `figure-${number}.${suffix}` });
    const links = ["png", "svg"].map(link);
    const row = make("p", { className: "links", hidden: true }, "Download ", ...links);
    const box = make("details", { open: number === "4" }, make("summary", { textContent: `${number} · ${FIGURES[number]}` }), note, whole, row);
    box.addEventListener("toggle", () => this.load(number));
    this.figures.set(number, { box, picture, whole, note, row, links, made: "", of: "" });
    return box;
  }

  enter() {
    this.replay.enter();
    const compared = this.state(6);
    if (this.compared !== compared) this.matrix.load();
    this.compared = compared;
    for (const number of this.figures.keys()) this.load(number);
  }

  /** Name what a figure shows: answers are in the last one only. */
  state(number) {
    const { id, revision, events } = store.session;
    return `${id} ${Number(number) === 7 ? events : revision}`;
  }

  /** Let a figure be drawn, if it is open and shows something else. */
  async load(number) {
    const figure = this.figures.get(number);
    if (!figure.box.open || !store.session || figure.made === this.state(number)) return;
    const wanted = (figure.made = this.state(number));
    const { id } = store.session;
    if (figure.of !== store.session.id) this.present(figure, false); // another session's
    figure.note.textContent = figure.whole.hidden ? "The figure is being drawn…" : OLD;
    try {
      const drawn = await blob(path(`figures/${number}.png`));
      if (figure.made !== wanted) return;
      URL.revokeObjectURL(figure.picture.src);
      figure.picture.src = URL.createObjectURL(drawn);
      figure.note.textContent = "";
      figure.of = id;
      figure.links.forEach((link, i) => (link.href = `api/${path(`figures/${number}.${["png", "svg"][i]}`)}`));
      figure.whole.href = figure.links[0].href;
      this.present(figure, true);
    } catch (problem) {
      if (figure.made !== wanted) return;
      figure.made = ""; // when it is looked at again, it is tried again
      figure.note.textContent = problem.message;
      this.present(figure, false);
    }
  }

  present({ whole, row }, there) {
    whole.hidden = row.hidden = !there;
  }
}
