/** The studio's page: four views of one session. */

import { get, post } from "./api.js";
import { Ask } from "./ask.js";
import { select } from "./belief.js";
import { byId, plural, showError } from "./dom.js";
import { QUESTION } from "./draft.js";
import { Keep } from "./keep.js";
import { Look } from "./look.js";
import { LiveTable } from "./socket.js";
import { inBackground, open, refresh, store, subscribe } from "./store.js";
import { Teach } from "./teach.js";

const VIEWS = ["teach", "ask", "look", "keep"];
const CONNECTION = {
  open: "",
  again: "",
  closed: "No connection to the studio; trying again…",
  full: "Too many pages watch the arm; trying again…",
};
const views = {};

async function begin() {
  store.studio = await get("studio");
  const [view, id] = addressed();
  const live = new LiveTable({
    frame: (header, jpeg) => store.view === "ask" && views.ask.table.frame(header, jpeg),
    changed: ({ session, events }) => session === store.session?.id && inBackground(() => refresh(events)),
    deleted: ({ session }) => inBackground(() => deleted(session)),
    demo: (scene) => inBackground(() => follow(scene)),
    state: connection,
  });
  views.teach = new Teach((number) => replay(`demonstrations/${number}`));
  views.look = new Look();
  const keep = (strokes) => views.teach.draft.keep({ [QUESTION]: strokes });
  views.ask = new Ask(live, (number) => replay(`answers/${number}`), correct, keep);
  views.keep = new Keep(() => show("teach"));
  subscribe(header);
  startTabs();
  await openSomething(id);
  show(VIEWS.includes(view) ? view : "teach");
  document.addEventListener("visibilitychange", () => store.view === "ask" && live.watch(!document.hidden));
  document.body.dataset.ready = "yes";
}

/** Open the session of the address, else the one that plays itself, else the newest, else a new one. */
async function openSomething(id) {
  const { sessions } = await get("sessions");
  const wanted = [id, store.studio.demo].find((one) => sessions.some((known) => known.id === one)) ?? sessions[0]?.id;
  await open(wanted ?? (await post("sessions", { language: "paper" })).id);
}

/** Somebody deleted a session: if it is the open one, another one is opened. */
async function deleted(id) {
  if (store.session?.id === id) {
    await openSomething(null);
    showError("The session that was open here was deleted in another page.");
  } else if (store.view === "keep") await views.keep.enter();
}

function header(session) {
  byId("session-title").textContent = session.title;
  byId("session-facts").textContent = plural(session.demonstrations.length, "demonstration");
  address();
}

/** The view and the session of the address. */
const addressed = () => location.hash.slice(1).split("/");

function address() {
  history.replaceState(null, "", `#${store.view}/${store.session.id}`);
}

function connection(state) {
  byId("connection").textContent = CONNECTION[state];
  if (state === "again") inBackground(() => refresh());
}

/** Bring a view to the fore. */
function show(view) {
  if (store.view === "ask" && view !== "ask") views.ask.leave();
  store.view = view;
  for (const name of VIEWS) {
    const chosen = name === view;
    byId(name).hidden = !chosen;
    const tab = byId(`tab-${name}`);
    tab.setAttribute("aria-selected", String(chosen));
    tab.tabIndex = chosen ? 0 : -1;
  }
  address();
  views[view].enter();
}

/** A person goes to a view, and back with the browser's button; a caption of what plays by itself was for another. */
function choose(view) {
  byId("caption").hidden = true;
  if (view !== store.view) history.pushState(null, "", location.hash); // what `show` writes over
  show(view);
}

function startTabs() {
  for (const [i, name] of VIEWS.entries()) {
    const tab = byId(`tab-${name}`);
    tab.addEventListener("click", () => choose(name));
    tab.addEventListener("keydown", (event) => {
      const to = { ArrowRight: i + 1, ArrowLeft: i - 1, Home: 0, End: -1 }[event.key];
      if (to === undefined) return;
      event.preventDefault();
      const next = VIEWS.at(to % VIEWS.length);
      choose(next);
      byId(`tab-${next}`).focus();
    });
  }
}

function correct(signs) {
  choose("teach");
  views.teach.correct(signs);
}

function replay(what) {
  show("look");
  inBackground(() => views.look.replay.show(what));
}

/** Show a scene of a session that plays itself. */
async function follow({ session, view, caption, demonstration }) {
  if (store.session.id !== session) await open(session);
  else await refresh();
  const told = byId("caption");
  told.hidden = !caption;
  told.textContent = caption;
  if (store.view !== view) show(view);
  if (view === "teach" && demonstration !== null) {
    select(demonstration);
    await views.teach.perform(demonstration);
  }
}

begin().catch((problem) => {
  showError(problem);
  document.body.dataset.ready = "no";
});
window.addEventListener("hashchange", () => { // by the back button, or typed
  const [view, id] = addressed();
  if (id === store.session?.id && VIEWS.includes(view)) show(view);
  else location.reload();
});
window.addEventListener("unhandledrejection", (event) => showError(event.reason));
window.addEventListener("error", (event) => showError(event.error ?? event.message));
