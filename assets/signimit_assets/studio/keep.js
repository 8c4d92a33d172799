/** Keep: sessions are listed, opened, begun, named, merged, exported and imported. */

import * as api from "./api.js";
import { announce, attempt, button, byId, capital, make, plural } from "./dom.js";
import { change, open, path, store, subscribe } from "./store.js";

const KINDS = {
  "model.npz": "What was learned: model (.npz)",
  "demonstrations.npz": "Demonstration set (.npz)",
  "strokes.npz": "Stroke library (.npz)",
  "strokes.inkml": "InkML",
  "strokes.csv": "CSV",
};

export class Keep {
  /** @param {function} opened called when another session was opened */
  constructor(opened) {
    this.opened = opened;
    this.list = make("ul", { className: "sessions plain-list" });
    byId("keep-sessions").append(make("h3", { textContent: "Sessions" }), this.list);
    this.makeNew();
    this.makeExport();
    this.makeImport();
    subscribe(() => store.view === "keep" && this.enter());
  }

  async enter() {
    const { sessions } = await attempt(() => api.get("sessions")) ?? { sessions: [] };
    this.list.replaceChildren(...sessions.map((one) => this.row(one)));
    this.showExports();
  }

  row(one) {
    const here = one.id === store.session.id;
    const when = new Date(one.created).toLocaleString([], { dateStyle: "medium", timeStyle: "short" });
    const facts = `${plural(one.demonstrations, "demonstration")}, ${plural(one.answers, "answer")} · ${one.language} · ${when}`;
    const actions = here
      ? [make("span", { className: "badge", textContent: "open" })]
      : [
          button("Open", () => this.switchTo(one.id), { "aria-label": `Open ${one.title}` }),
          button("Merge into this one", () => this.merge(one), { "aria-label": `Merge ${one.title} into the open session` }),
          this.deleter(one),
        ];
    const title = here ? this.titleField(one.title) : make("b", { textContent: one.title });
    return make(
      "li",
      { className: here ? "here" : "" },
      make("div", {}, title, make("p", { className: "quiet", textContent: facts })),
      make("div", { className: "row" }, ...actions),
    );
  }

  titleField(title) {
    const field = make("input", { value: title, maxLength: store.studio.limits.title, "aria-label": "Title of the open session" });
    const rename = () =>
      field.value.trim() &&
      field.value !== store.session.title &&
      attempt(() => change((revision) => api.post(path("title"), { revision, title: field.value.trim() })));
    field.addEventListener("change", rename);
    return field;
  }

  async switchTo(id) {
    const session = await attempt(() => open(id));
    if (session) this.opened(session);
  }

  async merge({ id, title }) {
    const merged = await attempt(() => change((revision) => api.post(path("merge"), { revision, other: id })));
    if (merged) announce(`${title} is merged into this session; undo in Teach takes it back.`);
  }

  /** A button that deletes a session for good, once it was pressed twice. */
  deleter({ id, title }) {
    const made = button("Delete", () => this.remove(made, id, title), { "aria-label": `Delete ${title}` });
    made.addEventListener("blur", () => sayDelete(made, "Delete", title));
    return made;
  }

  async remove(pressed, id, title) {
    if (pressed.textContent === "Delete") return sayDelete(pressed, "Delete for good", title);
    const deleted = await attempt(() => api.remove(`sessions/${id}`));
    if (deleted) announce(`${title} is deleted.`);
    return this.enter();
  }

  makeNew() {
    const title = make("input", { maxLength: 80, placeholder: "Title", id: "new-title" });
    const language = make("select", { id: "new-language" });
    const objects = make("input", { type: "number", min: 2, max: 6, value: 3, id: "new-objects", disabled: true });
    language.addEventListener("change", () => (objects.disabled = language.value !== "free"));
    for (const name of store.studio.languages) {
      language.append(make("option", { value: name, textContent: name === "free" ? "make up your own signs" : languageName(name) }));
    }
    const begin = async (event) => {
      event.preventDefault();
      const free = language.value === "free";
      const wanted = { title: title.value.trim(), language: language.value, ...(free ? { objects: Number(objects.value) } : {}) };
      const session = await attempt(async () => open((await api.post("sessions", wanted)).id));
      if (!session) return;
      title.value = "";
      this.opened(session);
    };
    byId("keep-new").append(
      make("h3", { textContent: "New session" }),
      make(
        "form",
        { onsubmit: begin },
        make("label", { className: "field" }, "Title", title),
        make("label", { className: "field" }, "Prompts", language),
        make("label", { className: "field" }, "Objects", objects),
        make("button", { type: "submit", className: "main", id: "new-session", textContent: "Begin" }),
      ),
    );
  }

  makeExport() {
    this.exports = make("ul", { className: "plain-list links" });
    byId("keep-export").append(make("h3", { textContent: "Export this session" }), this.exports);
  }

  showExports() {
    const some = store.session.demonstrations.length > 0;
    const rows = store.studio.exports.map((name) =>
      make("li", {}, make("a", { href: `api/${path(`export/${name}`)}`, download: name, textContent: KINDS[name] ?? name })),
    );
    this.exports.replaceChildren(...(some ? rows : [make("li", { className: "quiet", textContent: "Nothing to export yet." })]));
  }

  makeImport() {
    const kind = make("select", { id: "import-kind" });
    for (const name of store.studio.exports) kind.append(make("option", { value: name, textContent: KINDS[name] ?? name }));
    const file = make("input", { type: "file", accept: ".npz,.inkml,.xml,.csv", id: "import-file" });
    file.addEventListener("change", () => {
      const guess = store.studio.exports.find((name) => file.files[0]?.name.endsWith(name)) ?? bySuffix(file.files[0]?.name ?? "");
      if (guess) kind.value = guess;
    });
    const take = async (event) => {
      event.preventDefault();
      const [chosen] = file.files;
      if (!chosen) return attempt(() => Promise.reject(new Error("Choose a file first.")));
      const title = encodeURIComponent(chosen.name.slice(0, 80));
      const session = await attempt(async () => open((await api.upload(`import?format=${kind.value}&title=${title}`, chosen)).id));
      file.value = "";
      if (session) this.opened(session);
      return undefined;
    };
    byId("keep-import").append(
      make("h3", { textContent: "Import as a new session" }),
      make(
        "form",
        { onsubmit: take },
        make("label", { className: "field" }, "File", file),
        make("label", { className: "field" }, "Kind", kind),
        make("button", { type: "submit", id: "import-it", textContent: "Import" }),
      ),
    );
  }
}

function sayDelete(pressed, text, title) {
  pressed.textContent = text;
  pressed.setAttribute("aria-label", `${text}: ${title}`);
}

const languageName = (name) => (name === "paper" ? "the paper's language" : capital(name));
const bySuffix = (name) => store.studio.exports.find((known) => name.endsWith(known.slice(known.lastIndexOf("."))));
