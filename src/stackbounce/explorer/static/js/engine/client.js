/** Questions to a worker: each is answered, or stopped when it takes too long or a newer one takes its place. */

import { t } from "../words/language.js";

const LONGEST = 10_000; // ms of a question
const PATIENCE = 250; // ms of one whose place a newer one takes

const TOO_LONG = t("This takes longer than 10 s to compute, so it was stopped: fewer balls, softer contacts or a shorter time take less.");
const NO_WORKER = t("The browser does not let this page start a worker, which it needs to compute.");

/** A worker, started when it is first asked, and anew after a question had to be stopped. */
export class Client {
  /** @param {() => Worker} start @param {() => Promise<object>} parts what the worker computes with */
  constructor(start, parts) {
    Object.assign(this, { start, parts, worker: null, ready: null, waiting: new Map(), last: 0, turn: 0 });
  }

  /** Return a promise of the answer; `told` hears what comes before it. `newest`: it takes the place of older ones. */
  async ask(name, given, { told, newest = false } = {}) {
    if (newest) return this.askNewest(name, given);
    await this.prepare();
    return this.send(name, given, told);
  }

  /** Ask what takes the place of an older question, which has a moment to be answered. */
  async askNewest(name, given) {
    this.turn += 1;
    const mine = this.turn;
    const older = [...this.waiting.values()].find((question) => question.name === name);
    const isLate = older && !(await answeredSoon(older));
    if (this.turn !== mine) throw replaced();
    if (isLate) this.restart(replaced());
    await this.prepare();
    if (this.turn !== mine) throw replaced();
    return this.send(name, given);
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

/** Return a promise of whether a question is answered, be it with an error, before patience ends. */
function answeredSoon({ done }) {
  const late = new Promise((tell) => setTimeout(() => tell(false), PATIENCE));
  return Promise.race([done.then(() => true, () => true), late]);
}

function replaced() {
  return Object.assign(new Error("A newer question took its place."), { replaced: true });
}
