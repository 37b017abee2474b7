/** The director: makes a film of each result, and keeps the clock at the moment that is to be seen. */

import { filmOf, sameMoment } from "./film.js";

const REST = 600; // ms without a new number, after which a film that had ended is played again

/** Show films of the store's results on the clock; `calm` tells whether motion is reduced. */
export function direct(store, clock, calm) {
  let wanted = store.get().t; // the time given by a link, until its result arrives
  let replay = store.get().replay;
  let whole = null; // whether a whole drop is shown
  let waits = 0; // for the numbers to rest
  store.subscribe((state, before) => {
    Object.assign(clock, { speed: state.speed, loop: state.loop });
    const other = state.drop !== before.drop || state.until !== before.until;
    if (state.t !== before.t && state.t !== null) {
      if (other) wanted = state.t;
      else if (!clock.playing) clock.seek(state.t);
    }
    const asks = (one) => one.predict && one.guess === null;
    if (asks(state) && !asks(before) && clock.film) clock.rewind();
    if (state.result === before.result) return;
    const film = filmOf(state.result, state.until);
    const again = clock.film === null || film.whole !== whole || state.replay !== replay;
    const refined = !again && ["drop", "until"].every((name) => state.resultOf[name] === before.resultOf?.[name]); // more frames of the same
    const moment = again ? film.begin : sameMoment(clock.film, clock.time, film);
    const ended = !again && !clock.playing && clock.time >= clock.end && state.result.drop !== before.result.drop;
    clock.show(film, [...new Set(film.events.map(({ time }) => time))], wanted ?? moment);
    if (wanted !== null) clock.pause();
    else if (asks(state) && state.until === null && !refined) clock.rewind();
    else if (again && !calm() && state.view === "play") clock.play();
    clearTimeout(waits);
    if (ended && !calm() && state.view === "play" && !asks(state)) waits = setTimeout(() => clock.time >= clock.end && clock.replay(), REST);
    wanted = null;
    whole = film.whole;
    replay = state.replay;
  });
  Object.assign(clock, { speed: store.get().speed, loop: store.get().loop });
}
