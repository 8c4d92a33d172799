/** Prompts: what to draw next, in words and pictures. */

import { make } from "./dom.js";
import { movementPicture, signPicture } from "./pictures.js";
import { objectName } from "./store.js";

/** Say what to draw; `old` is the number of a demonstration that is drawn again, or null. */
export function sentence(session, prompt, old) {
  if (old === null) {
    return prompt?.text ?? "Make up two signs, one for an object and one for a movement. Then move about that object; once is enough.";
  }
  const asked = session.demonstrations[old].prompt;
  const again = "Draw again whatever went wrong.";
  return asked && session.language ? `${promptText(session.language, asked)} ${again}` : again;
}

/** Say which demonstration comes, and how many are to follow. */
export function counted(session, old) {
  if (old !== null) return `Redraw demonstration ${old + 1}`;
  const next = session.demonstrations.length + 1;
  const { left, prompt } = session.next;
  if (prompt && left) return `Demonstration ${next} · ${left} to go`;
  return prompt && next > 1 ? `Demonstration ${next} · all were shown, more are welcome` : `Demonstration ${next}`;
}

/** Say what is still to be drawn before it can be taught; nothing if nothing is. */
export function missing(signs, hand) {
  const names = ["the first sign", "the second sign", "the movement"];
  const left = names.filter((_, i) => !(i < 2 ? signs[i] : hand));
  const last = left.pop();
  return last ? `Still to draw: ${left.length ? `${left.join(", ")} and ` : ""}${last}.` : "";
}

/** Say which demonstration is played, and what it was to be. */
export function shownTexts({ demonstrations, language }, number) {
  const { prompt, by } = demonstrations[number];
  return [`Demonstration ${number + 1}${by ? `, by ${by}` : ""}`, prompt && language ? promptText(language, prompt) : ""];
}

/** Say what a request of a language asks to draw. */
export function promptText(language, { movement, focus }) {
  const signs = [];
  signs[language.focus_word] = language.focus_signs[focus];
  signs[language.movement_word] = language.movement_signs[movement];
  return `Sign ${signs[0]}, then ${signs[1]}. Then draw a ${language.movements[movement]} about the ${objectName(focus)} object; once is enough.`;
}

/** Show how signs and movement look. */
export function examples(prompt, wished) {
  if (!prompt) return [];
  const [signs, names] = wished ? [prompt.signs ?? [], ["first sign", "second sign"]] : [prompt.examples, prompt.signs];
  const drawings = prompt.drawing ? [movementPicture([prompt.drawing], `What a ${prompt.movement_name} looks like`)] : [];
  const shown = [...signs.map((points, i) => signPicture(points, `What ${names[i]} looks like`)), ...drawings];
  const captions = [...names, prompt.movement_name];
  return shown.map((picture, i) => make("figure", {}, picture, make("figcaption", { textContent: captions[i] })));
}
