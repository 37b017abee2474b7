/** Questions to a worker: each is answered, or stopped when it takes too long or a newer one takes its place. */

const LONGEST = 10_000; // ms of a question
const PATIENCE = 250; // ms of one whose place a newer one takes

const TOO_LONG =
  "This takes longer than 10 s to compute, so it was stopped: fewer balls, softer contacts or a shorter time take less.";
const NO_WORKER = "The browser does not let this page start a worker, which it needs to compute.";

/** A worker, started when it is first asked, and anew after a question had to be stopped. */
export class Client {
  /** @param {() => Worker} start @param {() => Promise<object>} parts what the worker computes with */
  constructor(start, parts) {
    Object.assign(this, { start, parts, worker: null, ready: null, waiting: new Map(), last: 0, turn: 0 });
  }

  /** Return a promise of the answer; `told` hears what comes before it. `newest`: it takes the place of older ones. */
  async ask(name, given, { told, newest = false } = {}) {
    if (newest) await this.makeRoom(name);
    await this.prepare();
    return this.send(name, given, told);
  }

  /** Start the worker, if there is none. */
  prepare() {
    this.ready ??= this.opened();
    return this.ready;
  }

  opened() {
    try {
      this.worker = this.start();
    } catch {
      return this.failed(Promise.reject(new Error(NO_WORKER)));
    }
    this.worker.onmessage = ({ data }) => this.heard(data);
    this.worker.onerror = (event) => {
      event.preventDefault();
      this.restart(new Error(NO_WORKER));
    };
    return this.failed(this.parts().then((parts) => this.send("open", [parts])));
  }

  /** Return a promise; if it fails, the next question tries again. */
  failed(ready) {
    ready.catch(() => (this.ready = null));
    return ready;
  }

  send(name, given, told) {
    if (!this.worker) return Promise.reject(replaced());
    this.last += 1;
    const id = this.last;
    const question = { name, told };
    question.done = new Promise((resolve, reject) => Object.assign(question, { resolve, reject }));
    question.timer = setTimeout(() => this.restart(new Error(TOO_LONG)), LONGEST);
    this.waiting.set(id, question);
    this.worker.postMessage({ id, name, given });
    return question.done;
  }

  heard({ id, part, answer, error }) {
    const question = this.waiting.get(id);
    if (!question) return;
    if (part !== undefined) {
      question.told?.(part);
      return;
    }
    clearTimeout(question.timer);
    this.waiting.delete(id);
    if (error === undefined) question.resolve(answer);
    else question.reject(new Error(error));
  }

  /** Wait for an older question of this name, but not for long, and not if a newer one comes. */
  async makeRoom(name) {
    this.turn += 1;
    const mine = this.turn;
    const older = [...this.waiting.values()].find((one) => one.name === name);
    if (!older) return;
    await Promise.race([older.done.catch(() => null), new Promise((done) => setTimeout(done, PATIENCE))]);
    if (this.turn !== mine) throw replaced();
    if ([...this.waiting.values()].includes(older)) this.restart(replaced());
  }

  /** End the worker; all that it was asked fails with an error. */
  restart(error) {
    this.worker?.terminate();
    this.worker = null;
    this.ready = null;
    const left = [...this.waiting.values()];
    this.waiting.clear();
    for (const { reject, timer } of left) {
      clearTimeout(timer);
      reject(error);
    }
  }
}

function replaced() {
  return Object.assign(new Error("A newer question took its place."), { replaced: true });
}
