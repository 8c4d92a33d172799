/** What the robot believes: each demonstration, the movements, the words, their order, its doubts and its wish. */

import * as api from "./api.js";
import { announce, attempt, button, byId, capital, make, percent, plural } from "./dom.js";
import { beliefSentence, movementPicture, objectPatch, scenePicture, signPicture } from "./pictures.js";
import { change, demonstration, objectName, path, store, subscribe } from "./store.js";

const NEIGHBOURHOOD = 0.17; // m about the object that is shown of a movement
const ORDINALS = ["first", "second"];
const kept = new Set(); // suspicions that a person has answered by keeping the demonstration
let selected = null;
let hooks = {};

/** @param {{replay, redraw, remove, wish}} listeners called with the number of a demonstration; `wish` with the wish */
export function startBelief(listeners) {
  hooks = listeners;
  subscribe((session, before) => {
    if (before?.id === session.id && before.revision === session.revision) return; // an answer, or a verdict
    const count = session.demonstrations.length;
    const grown = before?.id !== session.id || before.demonstrations.length !== count;
    if (grown || selected === null || selected >= count) selected = count ? count - 1 : null;
    show();
  });
}

/** Bring a demonstration to the fore. */
export function select(number) {
  selected = number;
  show();
}

function show() {
  const { belief, demonstrations } = store.session;
  const host = byId("belief");
  const parts = [make("h2", { textContent: "What the robot believes" })];
  if (!demonstrations.length) parts.push(make("p", { className: "quiet", textContent: NOTHING }));
  else if (!belief || belief.failed) parts.push(make("p", { className: "lead", textContent: belief?.failed ?? "…" }));
  else parts.push(orderCard(belief), demonstrationCard(belief), movementCard(belief), objectCard(belief), wishCard(belief));
  if (demonstrations.length && belief?.failed) parts.push(demonstrationCard(null));
  const known = demonstrations.length && belief && !belief.failed;
  byId("teach-believed").textContent = known ? `Demonstration ${selected + 1}: ${beliefSentence(belief, selected)}.` : "";
  const label = host.contains(document.activeElement) && document.activeElement.getAttribute("aria-label");
  host.replaceChildren(...parts);
  if (!label) return; // else the keyboard keeps its place
  const same = [...host.querySelectorAll("button")].find((one) => one.getAttribute("aria-label") === label);
  same?.focus({ preventScroll: true });
}

const NOTHING =
  "Nothing yet. It is told neither what a sign means, nor which object you have in mind, nor how many movements there are.";

function card(title, ...children) {
  return make("section", { className: "card" }, make("h3", { textContent: title }), ...children);
}

function orderCard(belief) {
  const orders = belief.word_orders;
  const shares = orders.map(({ loss }) => Math.exp(-loss));
  const all = shares.reduce((sum, share) => sum + share, 0);
  const rows = orders.map(({ focus, movement, loss }, i) =>
    make(
      "li",
      { className: "measure" },
      make("span", { textContent: `${capital(ORDINALS[focus])} sign: object, ${ORDINALS[movement]}: movement` }),
      bar(shares[i] / all),
      make("span", { className: "number", textContent: i ? `${loss.toFixed(1)} nats less` : percent(shares[i] / all) }),
    ),
  );
  const sentence = make("p", { className: "lead", id: "word-order", textContent: belief.word_order.text });
  return card("Word order", sentence, make("ul", { className: "plain-list" }, ...rows));
}

function bar(share) {
  const filled = make("span", { className: "filled" });
  filled.style.width = `${100 * share}%`;
  return make("span", { className: "bar", "aria-hidden": "true" }, filled);
}

function demonstrationCard(belief) {
  const count = store.session.demonstrations.length;
  const sentence = belief ? beliefSentence(belief, selected) : "";
  const body = make("div", { className: "chosen" });
  const strip = make("div", { className: "strip", role: "group", "aria-label": "All demonstrations" });
  for (let number = 0; number < count; number += 1) strip.append(thumb(belief, number));
  fill(body, belief, selected, `Demonstration ${selected + 1}`);
  const actions = make(
    "div",
    { className: "row" },
    button("Replay", () => hooks.replay(selected), { "aria-label": `Replay demonstration ${selected + 1}` }),
    button("Redraw", () => hooks.redraw(selected), { "aria-label": `Redraw demonstration ${selected + 1}` }),
    button("Delete", () => hooks.remove(selected), { "aria-label": `Delete demonstration ${selected + 1}` }),
  );
  return card(
    `Demonstration ${selected + 1}`,
    body,
    make("p", { className: "lead", id: "chosen-belief", textContent: sentence }),
    actions,
    strip,
  );
}

function thumb(belief, number) {
  const { sure } = store.session.demonstrations[number];
  const about = belief ? beliefSentence(belief, number) : "";
  const made = make("button", {
    type: "button",
    className: "thumb",
    title: about,
    "aria-pressed": String(number === selected),
    "aria-label": `Demonstration ${number + 1}. ${about}${sure ? "" : ". Unsure"}`,
    onclick: () => select(number),
  });
  const picture = make("span", { className: "picture-box" });
  made.append(picture, make("span", { className: "number", textContent: sure ? String(number + 1) : `${number + 1} ?` }));
  whenSeen(made, () => fill(picture, belief, number, ""));
  return made;
}

/** Draw a demonstration into a box, once its strokes are here. */
function fill(box, belief, number, label) {
  attempt(async () => {
    const shown = await demonstration(number);
    const probability = belief && belief.focus[number] >= 0 ? belief.focus_probability[number] : null;
    box.replaceChildren(scenePicture(shown, probability, label));
  });
}

const observer = new IntersectionObserver((entries) => {
  for (const { isIntersecting, target } of entries) {
    if (!isIntersecting) continue;
    observer.unobserve(target);
    target.whenSeen();
  }
});

function whenSeen(element, work) {
  element.whenSeen = work;
  observer.observe(element);
}

function movementCard(belief) {
  const rows = belief.movements.map(({ number, members }) => {
    const word = belief.lexicon.movements.find(({ movement }) => movement === number);
    return make(
      "li",
      { className: "meaning" },
      movementPicture(word.drawings, `Movement ${number + 1}, as it was drawn about the object`, NEIGHBOURHOOD),
      make("div", {}, make("b", { textContent: `Movement ${number + 1}` }), nameField(belief, number), chips(belief, members)),
      signs(word.strokes, `means movement ${number + 1}`),
    );
  });
  return card(`${plural(belief.movements.length, "movement")}, and the signs for them`, make("ul", { className: "plain-list" }, ...rows));
}

/** A field for what a person calls a movement; the robot is not told. */
function nameField(belief, number) {
  const label = `Name of movement ${number + 1}`;
  const [value, maxLength] = [belief.names[number], store.studio.limits.title];
  const field = make("input", { value, maxLength, placeholder: "name it", "aria-label": label });
  const rename = () => change((revision) => api.post(path(`movements/${number}/name`), { revision, title: field.value.trim() }));
  field.addEventListener("change", () => attempt(rename));
  return field;
}

function objectCard(belief) {
  const rows = belief.lexicon.objects.map(({ object, strokes }) =>
    make(
      "li",
      { className: "meaning" },
      objectPatch(object),
      make("b", { textContent: capital(objectName(object)) }),
      strokes.length ? signs(strokes, `means ${objectName(object)}`) : make("span", { className: "quiet", textContent: "no sign seen" }),
    ),
  );
  return card("Signs for the objects", make("ul", { className: "plain-list" }, ...rows));
}

function signs(strokes, meaning) {
  return make("div", { className: "signs" }, ...strokes.slice(-4).map((points) => signPicture(points, `A sign that ${meaning}`)));
}

function chips(belief, members) {
  const made = members.map((number) => {
    const focus = belief.focus[number];
    const unsure = !store.session.demonstrations[number].sure;
    const label = `Demonstration ${number + 1}, about ${objectName(focus)}${unsure ? ", unsure" : ""}`;
    return make(
      "button",
      { type: "button", className: "chip", "aria-label": label, title: label, onclick: () => select(number) },
      objectPatch(focus),
      `${number + 1}${unsure ? " ?" : ""}`,
    );
  });
  return make("div", { className: "chips" }, ...made);
}

/** What is doubted, and why; what is suspected can be drawn again here, or be kept as it is. */
export function doubtItem(doubt) {
  const { number, text, suspected } = doubt;
  const key = `${store.session?.id} ${text}`;
  if (!suspected) return make("li", { textContent: text });
  if (kept.has(key)) return make("li", { className: "quiet", textContent: `${text} It is kept as it is.` });
  const which = `suspected demonstration ${number + 1}`;
  const keep = () => {
    kept.add(key);
    item.replaceWith(doubtItem(doubt));
    announce(`Demonstration ${number + 1} is kept as it is.`);
  };
  const item = make(
    "li",
    {},
    make("span", { textContent: `${text} ` }),
    make(
      "span",
      { className: "row" },
      button("Redraw it", () => hooks.redraw(number), { "aria-label": `Redraw ${which}` }),
      button("Keep it", keep, { "aria-label": `Keep ${which}` }),
    ),
  );
  return item;
}

function wishCard(belief) {
  const doubts = belief.doubtful.length
    ? make("ul", {}, ...belief.doubtful.map(doubtItem))
    : make("p", { textContent: "It doubts none of the demonstrations." });
  const { wish } = belief;
  const wished = wish?.text
    ? [
        make("h3", { textContent: "Would like to see next" }),
        make("p", { textContent: wish.text }),
        make(
          "div",
          { className: "row" },
          ...(wish.signs ?? []).map((points, i) => signPicture(points, `The ${ORDINALS[i]} sign it wishes for`)),
          button("Show it that", () => hooks.wish(wish)),
        ),
      ]
    : [];
  return card("Doubts", doubts, ...wished);
}
