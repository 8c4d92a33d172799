/** Elements, messages and phrases of the page. Text always goes in as text, never as markup. */

const SVG = "http://www.w3.org/2000/svg";

/** Make an element: properties by name, `on...` as listeners, `aria-...` and `data-...` as attributes. */
export function make(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (name.includes("-") || name === "role" || name === "for") made.setAttribute(name, value);
    else made[name] = value;
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

/** Make an SVG element from attributes. */
export function makeSvg(tag, attributes = {}, ...children) {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  made.append(...children);
  return made;
}

/** Make a button. */
export function button(text, onclick, properties = {}) {
  return make("button", { type: "button", textContent: text, onclick, ...properties });
}

export const byId = (id) => document.getElementById(id);

/** Show a sentence about what went wrong, until it is closed or something goes right. */
export function showError(problem) {
  const box = byId("alert");
  box.firstElementChild.textContent = problem instanceof Error ? problem.message : String(problem);
  box.hidden = false;
}

/** Hide the sentence about what went wrong. */
export function clearError() {
  byId("alert").hidden = true;
}

/** Tell screen readers. */
export function announce(text) {
  byId("announcement").textContent = text;
}

/** Run something that may fail; what went wrong is shown in the page. */
export async function attempt(work) {
  try {
    const result = await work();
    clearError();
    return result;
  } catch (problem) {
    showError(problem);
    return undefined;
  }
}

export const percent = (share) => `${Math.round(100 * share)} %`;
export const plural = (count, noun) => `${count} ${noun}${count === 1 ? "" : "s"}`;
export const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);
/** Whether the person wants no motion. */
export const calm = () => matchMedia("(prefers-reduced-motion: reduce)").matches;
