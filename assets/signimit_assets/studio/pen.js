/** Strokes: followed with a mouse, a pen or a finger, thinned, joined, and played again in time. */

// Of a drawing, all its strokes together; the server takes 5000 and 600, bridges too.
const MOST_POINTS = 4000;
const MOST_SECONDS = 580;
export const TOO_LONG = "A drawing takes at most ten minutes; what was drawn by then is kept.";
const BRIDGE_STEP = 0.02; // s, between the points that join two strokes of one drawing
const BRIDGE_MOST = 0.3; // s

/**
 * Follow one pointer over an element at a time. Other fingers and buttons are ignored until it is lifted.
 * @param {HTMLElement} target
 * @param {{begin: function, move: function, end: function, cancel: function}} hooks `begin` gets the first sample and
 *   may refuse by returning false; a sample is {x, y, time}: pixels from the element's corner, and seconds.
 */
export function followPointer(target, hooks) {
  let held = null;
  const sample = (event) => {
    const box = target.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top, time: event.timeStamp / 1000 };
  };
  const mine = (event) => event.pointerId === held;
  target.addEventListener("pointerdown", (event) => {
    if (held !== null || event.button !== 0) return;
    if (hooks.begin(sample(event)) === false) return;
    held = event.pointerId;
    target.setPointerCapture(held);
    event.preventDefault();
  });
  target.addEventListener("pointermove", (event) => {
    if (!mine(event)) return;
    const passed = event.getCoalescedEvents?.() ?? [];
    for (const one of passed.length ? passed : [event]) hooks.move(sample(one));
  });
  target.addEventListener("pointerup", (event) => {
    if (!mine(event)) return;
    held = null;
    hooks.end();
  });
  for (const name of ["pointercancel", "lostpointercapture"]) {
    target.addEventListener(name, (event) => {
      if (!mine(event)) return;
      held = null;
      hooks.cancel();
    });
  }
}

/** A stroke as the server wants it: {points, times}. */
export class Recording {
  /** @param {number} spent seconds that strokes of the same drawing took already */
  constructor(spent = 0) {
    this.points = [];
    this.times = [];
    this.left = MOST_SECONDS - spent;
    this.late = false; // whether something came too late
  }

  add(point, time) {
    const last = this.times.at(-1) ?? time;
    this.late = time - (this.times[0] ?? time) > this.left;
    if (this.late) return;
    this.points.push(point);
    this.times.push(Math.max(last, time));
    [{ points: this.points, times: this.times }] = fewEnough([this]);
  }

  /** Largest distance from the first point, in the unit of the points. */
  get reach() {
    const [x, y] = this.points[0] ?? [0, 0];
    return Math.max(0, ...this.points.map((p) => Math.hypot(p[0] - x, p[1] - y)));
  }

  /** The stroke, its clock beginning at 0. */
  get stroke() {
    const from = this.times[0];
    return { points: this.points, times: this.times.map((t) => t - from) };
  }
}

/** Leave out every second point but the last of each stroke, until the strokes of a drawing have few enough. */
export function fewEnough(strokes) {
  const count = strokes.reduce((sum, { points }) => sum + points.length, 0);
  return count > MOST_POINTS ? fewEnough(strokes.map(thinned)) : strokes;
}

function thinned({ points, times }) {
  const keep = (_, i) => i % 2 === 0 || i === points.length - 1;
  return { points: points.filter(keep), times: times.filter(keep) };
}

/** Return how many samples of a stroke lie at a time or before, from a number that do; s. */
export function passed(times, now, count = 0) {
  let passing = count;
  while (passing < times.length && times[passing] <= now) passing += 1;
  return passing;
}

/** Join two strokes by a straight bridge, as if the pen had not been lifted. */
export function joined(first, second) {
  const gap = Math.min(BRIDGE_MOST, Math.max(2 * BRIDGE_STEP, distance(first.points.at(-1), second.points[0]) * 0.2));
  const steps = Math.max(1, Math.round(gap / BRIDGE_STEP));
  const [from, to, start] = [first.points.at(-1), second.points[0], first.times.at(-1)];
  const bridge = Array.from({ length: steps - 1 }, (_, i) => between(from, to, (i + 1) / steps));
  return {
    points: [...first.points, ...bridge, ...second.points],
    times: [
      ...first.times,
      ...bridge.map((_, i) => start + (gap * (i + 1)) / steps),
      ...second.times.map((t) => start + gap + t),
    ],
  };
}

export const between = (a, b, share) => [a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share];
export const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);
