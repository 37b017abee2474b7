/** How fast this machine draws: what can wait a little then leaves its time to what cannot. */

const SLOW = 50; // ms from a change to its picture

export class Pace {
  isSlow = false;
  begun = -Infinity; // ms, when something was drawn last

  /** Return the ms since something was drawn. */
  get since() {
    return performance.now() - this.begun;
  }

  /** Measure how long it takes from now until the picture is on the screen. */
  watch() {
    const begun = performance.now();
    this.begun = begun;
    requestAnimationFrame(() => {
      const { port1, port2 } = new MessageChannel(); // its message comes after the picture
      port1.onmessage = () => {
        port1.close();
        this.isSlow = performance.now() - begun > SLOW;
      };
      port2.postMessage(null);
    });
  }
}
