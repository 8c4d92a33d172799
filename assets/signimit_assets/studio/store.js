/** The session that is open, its listeners, and its demonstrations once they are fetched. */

import { Refusal, get, post } from "./api.js";
import { showError } from "./dom.js";

const CHANGED = "Somebody changed this session meanwhile. Here it is as it is now; please do that again.";
const listeners = new Set();

export const store = { studio: null, session: null, view: "teach" };

/** Call back with (session, before) now and whenever the session changes. */
export function subscribe(listener) {
  listeners.add(listener);
}

/** Take a session as the server tells it; one that is no newer than what is known is dropped. */
export function accept(session) {
  const before = store.session;
  if (before && before.id === session.id && session.events <= before.events) return before;
  store.session = session;
  for (const listener of listeners) listener(session, before);
  return session;
}

/** Ask for the session again, if there is news; `events` counts everything that happened in it. */
export async function refresh(events = Infinity) {
  const session = store.session;
  if (!session || events <= session.events) return session;
  const fresh = await get(path(""));
  return store.session?.id === fresh.id ? accept(fresh) : store.session;
}

/** Open another session. */
export async function open(id) {
  return accept(await get(`sessions/${id}`));
}

export const path = (rest) => `sessions/${store.session.id}${rest && `/${rest}`}`;

/** Change the session; if another page did before, show its change and say so. */
export async function change(work) {
  try {
    return accept(await work(store.session.revision));
  } catch (problem) {
    if (!(problem instanceof Refusal) || problem.status !== 409) throw problem;
    await refresh();
    throw new Refusal(409, CHANGED);
  }
}

const fetched = new Map();
subscribe((session, before) => {
  if (before?.id !== session.id || before.revision !== session.revision) fetched.clear();
});

/** Fetch a demonstration, strokes and all, once. */
export function demonstration(number) {
  if (!fetched.has(number)) {
    const wanted = get(path(`demonstrations/${number}`));
    wanted.catch(() => fetched.delete(number));
    fetched.set(number, wanted);
  }
  return fetched.get(number);
}

/** Let built-in people draw; nothing is stored. */
export function people(part, request) {
  const { movement, focus } = request;
  return post(path("people"), { part, movement, focus, attempt: Math.floor(Math.random() * 2 ** 32) });
}

export const objectName = (index) => store.studio.objects[index];
export const colour = (index) => store.studio.colours[index];

/** Run something in the background; a failure is shown. */
export function inBackground(work) {
  work().catch(showError);
}
