/** Choice of who makes the signs and who the movement: the person at the page, or built-in people. */

import { make } from "./dom.js";

const ME = "me";
export const BUILT_IN = "built-in";

/** Two selects, for interactant and demonstrator; `chosen` is called when one changes. */
export class Roles {
  constructor(host, chosen) {
    this.interactant = choice("Interactant (makes the signs)", chosen);
    this.demonstrator = choice("Demonstrator (makes the movement)", chosen);
    this.note = make("p", { className: "quiet" });
    host.append(
      make("div", { className: "row" }, this.interactant.element, this.demonstrator.element),
      this.note,
    );
  }

  get signs() {
    return this.interactant.select.value;
  }

  get movement() {
    return this.demonstrator.select.value;
  }

  /** Whose a demonstration is, for the record. */
  get by() {
    const built = [this.signs, this.movement].filter((who) => who === BUILT_IN).length;
    return ["person", "person and built-in people", "built-in people"][built];
  }

  /** Offer built-in people only where they know the language. */
  allow(known) {
    for (const { select } of [this.interactant, this.demonstrator]) {
      select.disabled = !known;
      if (!known) select.value = ME;
    }
    this.note.textContent = known
      ? "Built-in people are synthetic; with both of them at work the rest of the session plays by itself."
      : "Built-in people do not know signs that you made up.";
  }

  /** Take both parts back. */
  mine() {
    this.interactant.select.value = this.demonstrator.select.value = ME;
  }
}

function choice(label, chosen) {
  const select = make(
    "select",
    { onchange: chosen },
    make("option", { value: ME, textContent: "me" }),
    make("option", { value: BUILT_IN, textContent: "a built-in person" }),
  );
  return { select, element: make("label", { className: "field" }, label, select) };
}
