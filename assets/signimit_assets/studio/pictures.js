/** Small pictures of strokes and scenes, as SVG. */

import { capital, makeSvg, percent } from "./dom.js";
import { colour, objectName } from "./store.js";

const OUTSIDE = 1.25; // room about a sign in its box
const line = (points) => points.map(([x, y]) => `${x.toFixed(3)},${(-y).toFixed(3)}`).join(" ");

/** Show a sign within -1..1, y up. */
export function signPicture(points, label) {
  return makeSvg(
    "svg",
    { viewBox: `${-OUTSIDE} ${-OUTSIDE} ${2 * OUTSIDE} ${2 * OUTSIDE}`, class: "sign", role: "img", "aria-label": label },
    makeSvg("polyline", { points: line(points), class: "stroke" }),
  );
}

/** Show drawings of a movement about an object, the middle of the picture; in metres, or -1..1. */
export function movementPicture(drawings, label, half) {
  const reach = half ?? 1.1 * Math.max(0.05, ...drawings.flat(2).map(Math.abs));
  const cross = reach * 0.06;
  return makeSvg(
    "svg",
    { viewBox: `${-reach} ${-reach} ${2 * reach} ${2 * reach}`, class: "movement", role: "img", "aria-label": label },
    makeSvg("path", { d: `M${-cross} 0H${cross}M0 ${-cross}V${cross}`, class: "cross" }),
    ...drawings.map((points) => makeSvg("polyline", { points: line(points), class: "stroke" })),
  );
}

const SHAPES = [
  (x, y, r) => makeSvg("circle", { cx: x, cy: y, r }),
  (x, y, r) => makeSvg("rect", { x: x - 0.88 * r, y: y - 0.88 * r, width: 1.76 * r, height: 1.76 * r }),
  (x, y, r) => makeSvg("path", { d: `M${x} ${y - 1.2 * r}l${1.1 * r} ${1.9 * r}h${-2.2 * r}z` }),
];

/** A patch of an object's colour and shape, with its letter. */
export function objectPatch(index) {
  const box = { viewBox: "-1.3 -1.3 2.6 2.6", class: "patch", "aria-hidden": "true" };
  return makeSvg("svg", box, shape(index, 0, 0, 1), letter(index, 0, 0.36, 1));
}

function letter(index, x, y, size) {
  const made = makeSvg("text", { x, y, "font-size": size, class: "letter" });
  made.textContent = objectName(index).charAt(0).toUpperCase();
  return made;
}

function shape(index, x, y, r) {
  const made = (SHAPES[index] ?? SHAPES[0])(x, y, r);
  made.setAttribute("fill", colour(index));
  return made;
}

/**
 * Show a whole demonstration: objects, the hand's path, and a ring about each object that it may be about; the part
 * of the ring that is drawn is the probability.
 */
export function scenePicture(shown, probability, label) {
  const places = shown.objects.map(centimetres);
  const path = line(shown.hand.points.map(centimetres));
  const [x, y] = centimetres(shown.hand.points[0]);
  const rings = (probability ?? []).map((share, i) => (share >= LEAST_SHARE ? ring(places[i], share) : ""));
  return makeSvg(
    "svg",
    { viewBox: "-52 -47 104 94", class: "scene", ...(label ? { role: "img", "aria-label": label } : { "aria-hidden": "true" }) },
    makeSvg("rect", { x: -56, y: -50, width: 112, height: 100, class: "wood" }),
    ...places.flatMap(([u, v], i) => [shape(i, u, -v, 4.5), letter(i, u, -v + 1.8, 5)]),
    makeSvg("polyline", { points: path, class: "halo" }),
    makeSvg("polyline", { points: path, class: "path" }),
    ...rings,
    makeSvg("circle", { cx: x, cy: -y, r: 2.2, class: "hand" }),
  );
}

const LEAST_SHARE = 0.02; // of a probability that is drawn
const centimetres = ([x, y]) => [100 * x, 100 * y]; // lengths of arcs below 1 are not drawn exactly

function ring([x, y], share) {
  const around = { cx: x, cy: -y, r: 7.5, pathLength: 100, transform: `rotate(-90 ${x} ${-y})` };
  const dash = share < 0.995 ? { "stroke-dasharray": `${(100 * share).toFixed(1)} 100` } : {};
  const [rim, inner] = ["ring-rim", "ring"].map((name) => makeSvg("circle", { ...around, ...dash, class: name }));
  return makeSvg("g", {}, rim, inner);
}

/** Say where the robot thinks a demonstration belongs, e.g. "Movement 2 about the red object, 97 %". */
export function beliefSentence(belief, number) {
  const focus = belief.focus[number];
  if (focus < 0) return "None of the movements that the others show";
  const sure = percent(belief.focus_probability[number][focus]);
  const movement = belief.labels[number];
  const called = belief.names[movement] ? ` (${belief.names[movement]})` : "";
  return capital(`movement ${movement + 1}${called} about the ${objectName(focus)} object, ${sure}`);
}

/** A thumb, up or down. */
export function thumbPicture(up) {
  const hand = "M2 11h4v9H2zM8 20V11l4-8c1.7 0 2.6 1.3 2.2 2.9L13.4 9H19c1.5 0 2.4 1.3 2 2.7l-1.8 6.6A2.3 2.3 0 0 1 17 20z";
  const turned = up ? {} : { transform: "rotate(180 12 12)" };
  return makeSvg("svg", { viewBox: "0 0 24 24", class: "icon", "aria-hidden": "true" }, makeSvg("path", { d: hand, ...turned }));
}
