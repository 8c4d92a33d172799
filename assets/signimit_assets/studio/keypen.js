/** A pen for the keyboard: Enter puts it down and lifts it, arrow keys move it, Escape gives a stroke up. */

export const KEYS_HELP = "With the keyboard: Enter puts the pen down and lifts it, arrow keys move it; two at once go across.";
const WAYS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/**
 * Follow the arrow keys over an element that has the focus. The pen has a clock of its own, as keys come irregularly:
 * every step takes as long as every other.
 * @param {HTMLElement} target
 * @param {{begin, move, end, cancel, home, aim}} hooks the first four as of `followPointer`; `home` tells where the pen
 *   is at first, in shares of width and height; `aim` is called with where it is now, or null when it is put away
 * @param {{step: number, seconds: number}} pace of the width that a step is, and how long it takes
 */
export function followKeys(target, hooks, { step, seconds }) {
  const held = new Set();
  let [x, y, time, down] = [0, 0, 0, false];
  const at = () => {
    const { width, height } = target.getBoundingClientRect();
    return { x: x * width, y: y * height, time };
  };
  const move = () => {
    const { width, height } = target.getBoundingClientRect();
    for (const [right, below] of [...held].map((key) => WAYS[key])) {
      x = within(x + step * right);
      y = within(y + (step * below * width) / height);
    }
    time += seconds;
    if (down) hooks.move(at());
    hooks.aim(at());
  };
  const press = () => {
    time += seconds;
    if (down) hooks.end();
    down = !down && hooks.begin(at()) !== false;
  };
  const putAway = () => {
    held.clear();
    if (down) hooks.end();
    down = false;
    hooks.aim(null);
  };
  target.addEventListener("focus", () => {
    [x, y] = hooks.home();
    if (target.matches(":focus-visible")) hooks.aim(at());
  });
  target.addEventListener("blur", putAway);
  target.addEventListener("keyup", ({ key }) => held.delete(key));
  target.addEventListener("keydown", (event) => {
    const { key, repeat } = event;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (key in WAYS) {
      held.add(key);
      move();
    } else if (key === "Enter" || key === " ") {
      if (!repeat) press();
    } else if (key === "Escape" && down) {
      down = false;
      hooks.cancel();
    } else return;
    event.preventDefault();
  });
}

const within = (share) => Math.min(1, Math.max(0, share));
