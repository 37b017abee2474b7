/** A knock at the beginning of each contact: as loud as its peak force, and as high as its contact time is short, two octaves up. */

import { clamp } from "./shape.js";

const LOUDEST = 0.6; // of what the machine can play, for the strongest contact of the drop
const QUIETEST = 0.05;
const HIGHER = 4; // times as high as one over the contact time: a basketball's 100 Hz are too low for a laptop
const PITCHES = [330, 6000]; // Hz, what small loudspeakers play
const RINGS = 0.09; // s, until a knock has died away
const AT_ONCE = 6; // knocks of one frame of the film

/** Return the knocks of a result by time: `{time, loudness, pitch}`, loudness up to 1, pitch in Hz. */
export function knocksOf({ intervals }) {
  const strength = ({ peak_force: force, impulse }) => (Number.isFinite(force) ? force : impulse); // a rigid collision has no force
  const [strongest, hardest] = [intervals.filter(({ peak_force: force }) => Number.isFinite(force)), intervals].map((some) =>
    Math.max(...some.map(strength)),
  );
  return intervals
    .map((interval) => {
      const most = Number.isFinite(interval.peak_force) ? strongest : hardest;
      const lasts = interval.end === null ? Infinity : interval.end - interval.start;
      return {
        time: interval.start,
        loudness: clamp(Math.sqrt(strength(interval) / most) || 0, QUIETEST, 1), // the ear hears a quarter as half
        pitch: clamp(HIGHER / lasts, ...PITCHES),
      };
    })
    .sort((a, b) => a.time - b.time);
}

/** Play the knocks while the film plays, once the user has switched that on. */
export function mountSound(store, clock) {
  let context = null; // browsers let a page make sound only after it was used
  let film = null;
  let knocks = [];
  let heard = null; // s of the drop, up to which knocks were played; null while the film stands
  clock.subscribe(() => {
    const wasUsed = navigator.userActivation?.hasBeenActive ?? true;
    if (!store.get().sound || store.get().view !== "play" || !wasUsed) {
      heard = null;
      return;
    }
    if (clock.film !== film) {
      film = clock.film;
      knocks = film ? knocksOf(film.result) : [];
      heard = null;
    }
    const { time } = clock;
    if (heard !== null && time > heard && (clock.playing || time >= clock.end)) {
      context ??= new AudioContext();
      const met = knocks.filter((one) => one.time > heard && one.time <= time);
      for (const one of met.sort((a, b) => b.loudness - a.loudness).slice(0, AT_ONCE)) knock(context, one);
    }
    heard = !clock.playing ? null : time > clock.begin ? time : -Infinity;
  });
}

/** Play one knock now. */
function knock(context, { loudness, pitch }) {
  context.resume();
  const now = context.currentTime;
  const tone = new OscillatorNode(context, { type: "triangle", frequency: pitch });
  const volume = new GainNode(context, { gain: LOUDEST * loudness });
  volume.gain.setValueAtTime(LOUDEST * loudness, now);
  volume.gain.exponentialRampToValueAtTime(1e-4, now + RINGS);
  tone.connect(volume).connect(context.destination);
  tone.start(now);
  tone.stop(now + RINGS);
}
