/** Keys that everybody knows. */

/** Call back with "undo" or "redo" at Ctrl+Z, Ctrl+Shift+Z and Ctrl+Y, unless somebody is typing. */
export function onUndoKeys(callback) {
  document.addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.target.closest("input, select, textarea")) return;
    const what = { z: event.shiftKey ? "redo" : "undo", y: "redo" }[event.key.toLowerCase()];
    if (what && callback(what)) event.preventDefault();
  });
}
