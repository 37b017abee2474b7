/** What hears the microphone, in the browser's thread for sound: it passes the samples on. */

const PART = 4096; // samples that are passed on at once

class Recorder extends AudioWorkletProcessor {
  constructor() {
    super();
    this.part = new Float32Array(PART);
    this.filled = 0;
  }

  process([[samples]]) {
    for (const sample of samples ?? []) {
      this.part[this.filled] = sample;
      this.filled += 1;
      if (this.filled < PART) continue;
      this.port.postMessage(this.part);
      this.filled = 0;
    }
    return true;
  }
}

registerProcessor("recorder", Recorder);
