/** The live table: frames come in, drags and shoves go out; a dropped connection comes back by itself. */

const RETRY = [500, 1000, 2000, 4000]; // ms
const FULL = 4503;

export class LiveTable {
  /** @param {{frame, changed, deleted, demo, state}} listeners called with what comes in */
  constructor(listeners) {
    this.listeners = listeners;
    this.watching = false;
    this.failures = 0;
    this.connect();
  }

  connect() {
    this.socket = new WebSocket(new URL("ws", location.href.split("#")[0].replace(/^http/, "ws")));
    this.socket.binaryType = "arraybuffer";
    this.socket.addEventListener("open", () => this.opened());
    this.socket.addEventListener("message", (event) => this.heard(event.data));
    this.socket.addEventListener("close", (event) => this.closed(event));
  }

  opened() {
    const again = this.failures > 0;
    this.failures = 0;
    this.listeners.state(again ? "again" : "open");
    if (this.watching) this.send({ type: "watch", on: true });
  }

  closed(event) {
    this.listeners.state(event.code === FULL ? "full" : "closed");
    const wait = RETRY[Math.min(this.failures, RETRY.length - 1)];
    this.failures += 1;
    setTimeout(() => this.connect(), wait);
  }

  heard(data) {
    if (typeof data !== "string") {
      const length = new DataView(data).getUint32(0);
      const header = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length)));
      this.listeners.frame(header, new Uint8Array(data, 4 + length));
      return;
    }
    const message = JSON.parse(data);
    this.listeners[message.type]?.(message);
  }

  send(message) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  watch(on) {
    if (on === this.watching) return;
    this.watching = on;
    this.send({ type: "watch", on });
  }
}
