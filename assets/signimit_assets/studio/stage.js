/** Stage: the camera's picture of the table, with a transparent sheet above to draw on. */

import { make } from "./dom.js";
import { store } from "./store.js";

const INK = "#20132e"; // on wood, in both themes
const HALO = "rgb(255 255 255 / 85%)";
const HAND = "#ffc233";
const RING = 40; // pixels of the picture, radius of the ring about an object

export class Stage {
  /** @param {HTMLElement} host @param {string} label what the picture shows */
  constructor(host, label) {
    this.picture = make("canvas", { className: "picture", width: 640, height: 480 });
    this.sheet = make("canvas", { className: "sheet", role: "img", "aria-label": label });
    this.element = make("div", { className: "stage" }, this.picture, this.sheet);
    host.append(this.element);
    this.scene = () => {};
    this.photographed = false; // or only a plan
    new ResizeObserver(() => this.paint()).observe(this.sheet);
  }

  /** Show a JPEG; the newest wins. Without one the table is drawn as a plan. */
  async show(jpeg) {
    this.newest = jpeg;
    const image = jpeg?.size ? await createImageBitmap(jpeg) : null;
    if (this.newest !== jpeg) return image?.close();
    this.photographed = image !== null;
    const pen = this.picture.getContext("2d");
    if (image) pen.drawImage(image, 0, 0, 640, 480);
    else this.plan(pen);
    image?.close();
    this.waiting = false;
    return undefined;
  }

  /** Whether the picture is still to come; nothing is shown until then. */
  get waiting() {
    return this.element.classList.contains("waiting");
  }

  set waiting(still) {
    this.element.classList.toggle("waiting", still);
    this.paint();
  }

  /** Draw the bare table. */
  plan(pen) {
    const [width, depth] = store.studio.table;
    const [left, top] = toPixels([-width, depth]);
    const [right, bottom] = toPixels([width, -depth]);
    pen.fillStyle = "#d9dde2";
    pen.fillRect(0, 0, 640, 480);
    pen.fillStyle = "#dcb98a";
    pen.fillRect(left, top, right - left, bottom - top);
  }

  /** Remember what to draw above the picture, and draw it. */
  draw(scene = this.scene) {
    this.scene = scene;
    this.paint();
  }

  paint() {
    const width = Math.round(this.sheet.clientWidth * devicePixelRatio);
    if (!width || !store.studio) return;
    const height = Math.round((width * 3) / 4);
    if (this.sheet.width !== width) [this.sheet.width, this.sheet.height] = [width, height];
    const pen = this.sheet.getContext("2d");
    pen.setTransform(width / 640, 0, 0, width / 640, 0, 0);
    pen.clearRect(0, 0, 640, 480);
    pen.lineCap = pen.lineJoin = "round";
    if (!this.waiting) this.scene(pen); // nothing of a new scene is seen above the picture of the last one
  }

  /** Metres under a pixel of the sheet, {x, y} from its corner. */
  metres({ x, y }, plane = "table") {
    const box = this.sheet.getBoundingClientRect();
    return toMetres([(x * 640) / box.width, (y * 480) / box.height], plane);
  }

  /** The nearest pixel that is on the sheet. */
  within({ x, y }) {
    const { width, height } = this.sheet.getBoundingClientRect();
    return { x: Math.min(Math.max(x, 0), width), y: Math.min(Math.max(y, 0), height) };
  }

  /** Length of a CSS pixel on the table, m. */
  get pixel() {
    return (640 / this.sheet.getBoundingClientRect().width) * store.studio.picture.metres_per_pixel.table;
  }
}

export function toMetres([px, py], plane = "table") {
  const { centre, width, height, metres_per_pixel: scale } = store.studio.picture;
  return [centre[0] + (px - width / 2) * scale[plane], centre[1] - (py - height / 2) * scale[plane]];
}

export function toPixels([x, y], plane = "table") {
  const { centre, width, height, metres_per_pixel: scale } = store.studio.picture;
  return [width / 2 + (x - centre[0]) / scale[plane], height / 2 - (y - centre[1]) / scale[plane]];
}

/** Draw a path over the table, dark with a light rim, that is seen on everything. */
export function drawPath(pen, points, plane = "table", colour = INK) {
  if (points.length < 2) return;
  pen.beginPath();
  for (const point of points) pen.lineTo(...toPixels(point, plane));
  for (const [width, style] of [[6.5, HALO], [3.5, colour]]) {
    pen.lineWidth = width;
    pen.strokeStyle = style;
    pen.stroke();
  }
}

/** Draw a dot where the hand is. */
export function drawHand(pen, place, plane = "table") {
  const [x, y] = toPixels(place, plane);
  disc(pen, x, y, 11, HALO);
  disc(pen, x, y, 9, INK);
  disc(pen, x, y, 6, HAND);
}

/** Draw the initials of the objects, for the colour-blind. */
export function drawLetters(pen, objects) {
  pen.font = "700 17px system-ui, sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  objects.forEach((place, i) => {
    const [x, y] = toPixels(place);
    pen.lineWidth = 4;
    pen.strokeStyle = "rgb(0 0 0 / 55%)";
    const letter = store.studio.objects[i].charAt(0).toUpperCase();
    pen.strokeText(letter, x, y + 1);
    pen.fillStyle = "#fff";
    pen.fillText(letter, x, y + 1);
  });
}

/** Draw objects where the camera shows none. */
export function drawObjects(pen, objects) {
  objects.forEach((place, i) => {
    const [x, y] = toPixels(place);
    disc(pen, x, y, 18, store.studio.colours[i]);
  });
}

/** Draw a ring about an object, as much of it as the robot is sure. */
export function drawRing(pen, place, share) {
  const [x, y] = toPixels(place);
  const from = -Math.PI / 2;
  for (const [width, style, part] of [[11, HALO, 1], [2, "rgb(32 19 46 / 45%)", 1], [7, INK, share], [3, HAND, share]]) {
    pen.beginPath();
    pen.arc(x, y, RING, from, from + 2 * Math.PI * part);
    pen.lineWidth = width;
    pen.strokeStyle = style;
    pen.stroke();
  }
}

/** Draw where the keyboard's pen is. */
export function drawAim(pen, place) {
  const [x, y] = toPixels(place);
  for (const [width, style] of [[5, HALO], [2.5, INK]]) {
    pen.beginPath();
    pen.arc(x, y, 14, 0, 2 * Math.PI);
    pen.lineWidth = width;
    pen.strokeStyle = style;
    pen.stroke();
  }
}

/** Draw an arrow between two places, as strong as it is long. */
export function drawArrow(pen, from, to) {
  const [[x, y], [u, v]] = [toPixels(from, "hand"), toPixels(to, "hand")];
  const angle = Math.atan2(v - y, u - x);
  const barb = (turn) => [u - 14 * Math.cos(angle + turn), v - 14 * Math.sin(angle + turn)];
  pen.beginPath();
  pen.moveTo(x, y);
  pen.lineTo(u, v);
  pen.moveTo(...barb(0.5));
  pen.lineTo(u, v);
  pen.lineTo(...barb(-0.5));
  for (const [width, style] of [[8, HALO], [4, "#6b2185"]]) {
    pen.lineWidth = width;
    pen.strokeStyle = style;
    pen.stroke();
  }
}

function disc(pen, x, y, radius, style) {
  pen.beginPath();
  pen.arc(x, y, radius, 0, 2 * Math.PI);
  pen.fillStyle = style;
  pen.fill();
}
