/** Look: replay, similarities, and the paper's figures of this session. */

import { blob } from "./api.js";
import { button, byId, make } from "./dom.js";
import { Matrix } from "./matrix.js";
import { Replay } from "./replay.js";
import { path, store, subscribe } from "./store.js";

const FIGURES = {
  4: "The demonstrations, seen from each object",
  5: "Similarities in every pair of frames",
  6: "Best similarities",
  7: "What the arm drew",
};

const DARK = matchMedia("(prefers-color-scheme: dark)");
const EMPTY = "There is nothing to look at yet. Once something was demonstrated, it can be replayed here, compared, and seen as in the paper's figures.";
const UNASKED = "The arm has drawn nothing yet. Ask it for something first.";
const OLD = "This is from before the last change; it is being drawn again…";

export class Look {
  constructor() {
    this.replay = new Replay();
    this.matrix = new Matrix();
    this.figures = new Map();
    this.compared = "";
    this.enlarged = enlarger();
    byId("look-empty").append(make("p", { textContent: EMPTY }), button("Demonstrate something", () => byId("tab-teach").click(), { id: "go-teach" }));
    DARK.addEventListener("change", () => store.view === "look" && this.enter());
    byId("look-figures").append(make("h3", { textContent: "Figures" }), ...Object.keys(FIGURES).map((n) => this.figure(n)));
    subscribe(() => store.view === "look" && this.enter());
  }

  figure(number) {
    const picture = make("img", { alt: `Figure ${number}: ${FIGURES[number]}` });
    const whole = make("button", { type: "button", className: "enlarge", title: "Enlarge", hidden: true }, picture);
    whole.addEventListener("click", () => this.enlarge(picture));
    const note = make("p", { className: "quiet" });
    const link = (suffix) => make("a", { textContent: suffix.toUpperCase(), download: `figure-${number}.${suffix}` });
    const links = ["png", "svg"].map(link);
    const row = make("p", { className: "links", hidden: true }, "Download ", ...links);
    const box = make("details", { open: number === "4" }, make("summary", { textContent: `${number} · ${FIGURES[number]}` }), note, whole, row);
    box.addEventListener("toggle", () => this.load(number));
    this.figures.set(number, { box, picture, whole, note, row, links, made: "", of: "" });
    return box;
  }

  /** Show a figure as large as it was drawn. */
  enlarge({ src, alt }) {
    Object.assign(this.enlarged.querySelector("img"), { src, alt });
    this.enlarged.setAttribute("aria-label", alt);
    this.enlarged.showModal();
  }

  enter() {
    const { demonstrations, answers } = store.session;
    const [untaught, unasked] = [!demonstrations.length, !answers.length];
    byId("look-empty").hidden = !untaught;
    byId("look-replay").hidden = untaught && unasked;
    byId("look-matrix").hidden = byId("look-figures").hidden = untaught;
    this.replay.enter();
    if (untaught) return;
    const compared = this.state(6);
    if (this.compared !== compared) this.matrix.load();
    this.compared = compared;
    for (const number of this.figures.keys()) this.load(number);
  }

  /** Name what a figure shows: answers are in the last one only. */
  state(number) {
    const { id, revision, events } = store.session;
    return `${id} ${Number(number) === 7 ? events : revision} ${look()}`;
  }

  /** Let a figure be drawn, if it is open and shows something else. */
  async load(number) {
    const figure = this.figures.get(number);
    if (!figure.box.open || !store.session || figure.made === this.state(number)) return;
    const wanted = (figure.made = this.state(number));
    const { id, answers } = store.session;
    if (Number(number) === 7 && !answers.length) {
      figure.note.textContent = UNASKED;
      return this.present(figure, false);
    }
    if (figure.of !== store.session.id) this.present(figure, false); // another session's
    figure.note.textContent = figure.whole.hidden ? "The figure is being drawn…" : OLD;
    try {
      const drawn = await blob(path(`figures/${number}.png?look=${look()}`));
      if (figure.made !== wanted) return;
      URL.revokeObjectURL(figure.picture.src);
      figure.picture.src = URL.createObjectURL(drawn);
      figure.note.textContent = "";
      figure.of = id;
      figure.links.forEach((link, i) => (link.href = `api/${path(`figures/${number}.${["png", "svg"][i]}`)}`));
      this.present(figure, true);
    } catch (problem) {
      if (figure.made !== wanted) return;
      figure.made = ""; // when it is looked at again, it is tried again
      figure.note.textContent = problem.message;
      this.present(figure, false);
    }
    return undefined;
  }

  present({ whole, row }, there) {
    whole.hidden = row.hidden = !there;
  }
}

const look = () => (DARK.matches ? "dark" : "light");

/** A dialog that shows one figure at a time. */
function enlarger() {
  const close = button("Close", () => made.close());
  const made = make("dialog", { className: "enlarged" }, close, make("div", { tabIndex: 0 }, make("img")));
  document.body.append(made);
  return made;
}
