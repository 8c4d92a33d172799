/** What is drawn of a demonstration that is not sent yet; a reload of the page does not lose it. */

const EMPTY = { number: null, parts: [[], []], hand: null };

export class Draft {
  constructor() {
    this.key = null;
    Object.assign(this, structuredClone(EMPTY), { scene: null });
  }

  /** Take up what was drawn for a session in this tab. */
  open(id) {
    this.key = `signimit draft of ${id}`;
    let kept = null;
    try {
      kept = JSON.parse(sessionStorage.getItem(this.key));
    } catch {
      // somebody else's or a broken note is no draft
    }
    Object.assign(this, structuredClone(EMPTY), { scene: null }, kept);
  }

  /** Follow the session to its scene; tells whether the table is another, and the draft gone. */
  place(session) {
    const scene = JSON.stringify(session.next.scene);
    const gone = this.number !== null ? this.number >= session.demonstrations.length : this.scene !== scene;
    const same = this.scene === scene;
    this.scene = scene;
    if (gone) this.reset();
    return gone || (this.number === null && !same);
  }

  keep(parts, hand) {
    Object.assign(this, { parts, hand });
    this.write();
  }

  /** Begin with a demonstration as it was, to draw some of it again. */
  redraw({ number, signs, hand }, fit) {
    Object.assign(this, { number, parts: signs.map((sign) => [fit(sign)]), hand });
    this.write();
  }

  clear() {
    this.reset();
    this.write();
  }

  reset() {
    Object.assign(this, structuredClone(EMPTY));
  }

  write() {
    const { number, parts, hand, scene } = this;
    try {
      sessionStorage.setItem(this.key, JSON.stringify({ number, parts, hand, scene }));
    } catch {
      // a full or forbidden storage only costs the draft at a reload
    }
  }
}
