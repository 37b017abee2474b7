/** How fast this machine draws: what can wait a little then leaves its time to what cannot. */

const QUICK = 50; // ms from a change to its picture
const SHARE = 5; // on a slow machine, one part in so many of the time is for what can wait

export class Pace {
  begun = -Infinity; // ms, when something was drawn last
  took = 0; // ms, until it was on the screen

  /** Whether the machine is slow, and has just drawn: what can wait is then better left for later. */
  get isBusy() {
    return this.took > QUICK && performance.now() - this.begun < SHARE * this.took;
  }

  /** Measure how long it takes from now until the picture is on the screen. */
  watch() {
    const begun = performance.now();
    this.begun = begun;
    requestAnimationFrame(async () => {
      await messagesRead(); // which are read after the picture
      this.took = performance.now() - begun;
    });
  }
}

/** Return a promise that waits until the messages that have come in are read. */
export function messagesRead() {
  const { port1, port2 } = new MessageChannel();
  return new Promise((done) => {
    port1.onmessage = () => {
      port1.close();
      done();
    };
    port2.postMessage(null);
  });
}
