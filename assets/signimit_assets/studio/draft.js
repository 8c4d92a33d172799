/**
 * What is drawn of a demonstration that is not taught yet, and the first sign in Ask. The server keeps each stroke as
 * it is finished, so that any page that opens the session has it; of two pages the last stroke at a place counts.
 */

import { put } from "./api.js";
import { showError } from "./dom.js";
import { accept, refresh, store } from "./store.js";

export const SIGNS = ["sign 1", "sign 2"];
export const HAND = "hand";
export const QUESTION = "question";
const PLACES = [...SIGNS, HAND];
const STALE = 409;
const UNUSABLE = 422;

export class Draft {
  constructor(id) {
    this.id = id;
    this.table = null; // what tells one table from the next
    this.told = { number: null, drawn: {} }; // the draft that the server told last
    this.sent = Promise.resolve();
    this.reset();
  }

  /** Begin with nothing drawn, or with a demonstration that is drawn again. */
  reset(number = null) {
    this.number = number;
    this.drawn = {}; // strokes by their places
    this.unsent = {};
  }

  /** Follow the session; tells the places where something else is drawn now, or null if all of it is another. */
  follow({ revision, next, demonstrations, draft }) {
    const table = JSON.stringify([next.scene, demonstrations.length]);
    const { told } = this;
    const moved = table !== this.table;
    const turned = draft.number !== told.number && draft.number !== this.number;
    Object.assign(this, { revision, table, told: draft });
    if (moved || turned) {
      this.reset(draft.number);
      Object.assign(this.drawn, draft.drawn);
      return null;
    }
    const known = draft.number === told.number ? told : this;
    const same = (place) => JSON.stringify(draft.drawn[place]) === JSON.stringify(known.drawn[place]);
    const others = [...PLACES, QUESTION].filter((place) => !(place in this.unsent) && !same(place));
    for (const place of others) this.drawn[place] = draft.drawn[place];
    return others;
  }

  /** Take what is drawn now at some places, [strokes] by place, and send it. */
  keep(drawn) {
    Object.assign(this.drawn, drawn);
    Object.assign(this.unsent, drawn);
    return this.flush();
  }

  /** Nothing is drawn any more, and no demonstration drawn again. */
  clear() {
    const kept = { ...this.told.drawn, ...this.drawn };
    const empty = this.told.number === null && !PLACES.some((place) => kept[place]?.length);
    this.reset();
    if (!empty) this.keep(Object.fromEntries(PLACES.map((place) => [place, []])));
  }

  /** Send what was not sent yet; resolves when the server has it. */
  flush() {
    this.sent = this.sent.then(() => this.send());
    return this.sent;
  }

  async send() {
    const { number, revision, table, unsent } = this;
    if (!Object.keys(unsent).length) return;
    this.unsent = {};
    try {
      const session = await put(`sessions/${this.id}/draft`, { revision, number, drawn: unsent });
      if (store.session.id === this.id) accept(session);
    } catch (problem) {
      if (problem.status === STALE && store.session.id === this.id) await refresh().catch(showError);
      const same = table === this.table && number === this.number;
      if (same && problem.status !== UNUSABLE) this.unsent = { ...unsent, ...this.unsent };
      if (revision === this.revision) showError(problem);
      else await this.send();
    }
  }
}
