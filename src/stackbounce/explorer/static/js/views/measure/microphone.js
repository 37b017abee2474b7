/** The microphone as a source of a measurement: at most 30 s, which become a WAV file in the page. */

import { partsOf, write } from "../../dom.js";
import { sayProblem } from "../../set_up/fields.js";
import { t } from "../../words/language.js";
import { download } from "../../state/share.js";
import { wavOf } from "./wav.js";

const LONGEST = 30; // s
const CLIPPED = 0.99; // of the largest sample
const PLAIN = { echoCancellation: false, noiseSuppression: false, autoGainControl: false, channelCount: 1 };

/** Let the parts of `root` record; `take` hears each recording, as a file. */
export function microphone(root, take) {
  const { microphone: own, noMicrophone: instead, turn, level, save, said, problem } = partsOf(root);
  own.hidden = !window.isSecureContext || !navigator.mediaDevices?.getUserMedia;
  instead.hidden = !own.hidden;
  turn.addEventListener("click", () => (recording ? stop() : start()));
  save.addEventListener("click", () => download(file, file.name));
  let recording = null;
  let file = null;

  const start = async () => {
    turn.disabled = true;
    sayProblem(problem);
    try {
      recording = await record(heard);
      write(turn, t("Stop"));
      level.hidden = false;
      save.hidden = true;
      write(said, t("Recording, for {seconds} s at most: let the ball bounce near the microphone.", { seconds: LONGEST }));
    } catch (error) {
      sayProblem(problem, whyNot(error), write);
    }
    turn.disabled = false;
  };
  const heard = (peak, seconds) => {
    level.value = peak;
    if (recording && seconds >= LONGEST) stop();
  };
  const stop = () => {
    const { samples, rate, loudest } = recording.end();
    recording = null;
    write(turn, t("Record a bounce"));
    level.hidden = true;
    const clipped = loudest >= CLIPPED;
    write(said, clipped ? t("The recording was too loud, so that its peaks are cut off. Record it again from further away.") : t("The recording stays on this machine."));
    file = new File([wavOf(samples, rate)], "recording.wav", { type: "audio/wav" });
    save.hidden = false;
    take(file);
  };
}

/** Begin to record; `heard` is told the peak of each part, and how many seconds there are. */
async function record(heard) {
  const stream = await navigator.mediaDevices.getUserMedia({ audio: PLAIN });
  const context = new AudioContext();
  const parts = [];
  const rate = context.sampleRate;
  const close = () => {
    for (const track of stream.getTracks()) track.stop();
    context.close();
  };
  let loudest = 0;
  try {
    await context.audioWorklet.addModule("microphone_worklet.js");
    await context.resume();
    const recorder = new AudioWorkletNode(context, "recorder", { numberOfOutputs: 0, channelCount: 1, channelCountMode: "explicit" });
    recorder.port.onmessage = ({ data }) => {
      parts.push(data);
      const peak = data.reduce((most, sample) => Math.max(most, Math.abs(sample)), 0);
      loudest = Math.max(loudest, peak);
      heard(peak, (parts.length * data.length) / rate);
    };
    context.createMediaStreamSource(stream).connect(recorder);
  } catch (error) {
    close();
    throw error;
  }
  const end = () => {
    close();
    const samples = new Float32Array(parts.reduce((sum, part) => sum + part.length, 0));
    parts.forEach((part, i) => samples.set(part, i * part.length));
    return { samples, rate, loudest };
  };
  return { end };
}

function whyNot({ name, message }) {
  if (name === "NotAllowedError") return t("The browser does not let this page use the microphone. Allow it beside the page’s address, then try again.");
  if (name === "NotFoundError") return t("No microphone was found.");
  return message;
}
