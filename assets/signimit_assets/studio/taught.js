/** The signs that were taught, for whoever asks: the latest of each meaning. */

import { capital, make } from "./dom.js";
import { objectPatch, signPicture } from "./pictures.js";
import { objectName } from "./store.js";

const MOST = 2; // signs of a meaning; of more there would be no room

/** Show what can be asked for, and with which signs; nothing if nothing was learned. */
export function taughtSigns(belief) {
  if (!belief?.lexicon) return [];
  const objects = belief.lexicon.objects.map(({ object, strokes }) => meaning(capital(objectName(object)), strokes, objectPatch(object)));
  const movements = belief.lexicon.movements.map(({ movement, strokes }) => {
    const name = belief.names[movement] || `movement ${movement + 1}`;
    return meaning(capital(name), strokes, null);
  });
  const { text } = belief.word_order;
  return [
    make("h3", { textContent: "Signs that were taught" }),
    make("p", { className: "quiet", textContent: text }),
    make("ul", { className: "plain-list" }, ...[...objects, ...movements].filter((row) => row)),
  ];
}

function meaning(name, strokes, patch) {
  if (!strokes.length) return null;
  const pictures = strokes.slice(-MOST).map((points) => signPicture(points, `A sign that means ${name}`));
  return make("li", { className: "meaning" }, patch, make("b", { textContent: name }), make("div", { className: "signs" }, ...pictures));
}
