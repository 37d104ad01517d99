// The WebSocket to the program (studio-protocol.md section 1): commands with promises, newest frames, messages by type.

const HEAD = 10;          // numbers before the poses
const RETRY_MS = 1500;    // after the connection was lost

/** Reads a frame; null if its layout is not known. */
export function readFrame(buffer) {
  const head = new Float64Array(buffer, 0, HEAD);
  if (head[0] !== 1 || buffer.byteLength !== 8 * (HEAD + 7 * head[9])) return null;
  const [, number, revision, theta, seconds, processed, force, energy, mode, bodies] = head;
  return {number, revision, theta, seconds, processed, force, energy, mode: ["exact", "equilibrium", "bullet"][mode], bodies,
    poses: new Float64Array(buffer, 8 * HEAD)};
}

export class Connection {
  constructor(token) {
    Object.assign(this, {token, next: 1, waiting: new Map(), handlers: new Map(), newest: new Map()});
  }

  on(type, handler) {
    this.handlers.set(type, [...(this.handlers.get(type) ?? []), handler]);
  }

  emit(type, message) {
    for (const handler of this.handlers.get(type) ?? []) handler(message);
  }

  open() {
    this.socket = new WebSocket(`ws://${location.host}/session`, this.token ? [this.token] : []);
    this.socket.binaryType = "arraybuffer";
    this.socket.addEventListener("open", () => this.emit("open", {}));
    this.socket.addEventListener("message", ({data}) => (typeof data === "string" ? this.text(data) : this.frame(data)));
    this.socket.addEventListener("close", () => this.closed());
  }

  closed() {
    for (const {reject} of this.waiting.values()) reject(new Error("The program has stopped."));
    this.waiting.clear();
    this.newest.clear();
    this.emit("closed", {});
    setTimeout(() => this.open(), RETRY_MS);
  }

  text(data) {
    const message = JSON.parse(data);
    if (message.type === "error" && message.id) this.refused(message);
    this.emit(message.type, message);
  }

  refused({id, message}) {
    this.waiting.get(id)?.reject(new Error(message));
    this.waiting.delete(id);
  }

  frame(data) {
    const frame = readFrame(data);
    if (!frame) return;
    this.emit("frame", frame);
    this.socket.send(JSON.stringify({type: "ack", frame: frame.number}));
    for (const [id, {type, resolve}] of this.waiting)
      if (id <= frame.processed) this.waiting.delete(id) && this.emit("done", {type}), resolve(frame);
  }

  /** Sends a command. The promise resolves with the first frame that shows its effect, and rejects if the command is
   *  refused. */
  send(type, keys = {}) {
    if (this.socket?.readyState !== WebSocket.OPEN) return Promise.reject(new Error("The program is not running."));
    const id = this.next++;
    const answer = new Promise((resolve, reject) => this.waiting.set(id, {type, resolve, reject}));
    this.socket.send(JSON.stringify({type, id, ...keys}));
    answer.catch(() => {});  // every refusal is shown by the handler of "error"
    return answer;
  }

  /** Sends a command, for sliders and pointers. While one is unanswered, only the newest of the later ones is kept. */
  latest(type, keys) {
    const line = this.newest.get(type);
    if (line) return void (line.next = keys);
    const mine = {next: null};
    this.newest.set(type, mine);
    this.send(type, keys).catch(() => {}).then(() => {
      if (this.newest.get(type) !== mine) return;
      this.newest.delete(type);
      if (mine.next) this.latest(type, mine.next);
    });
  }

  /** Drops a kept command of this type that was not sent. */
  forget(type) {
    this.newest.delete(type);
  }
}
