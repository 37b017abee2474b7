/** Errors of the drop's numbers, and what follows of them: asked for after each result, apart from it. */

import { valueAt } from "../set_up/drops.js";

/** Return errors with that of a number: null for none, undefined to leave it as it is. */
export function withError(errors, path, error) {
  if (error === undefined || (error === null && errors[path] === undefined) || errors[path] === error) return errors;
  const { [path]: _old, ...rest } = errors;
  return error === null ? rest : { ...rest, [path]: error };
}

/** Return the errors of numbers that a changed drop still has. */
function keptErrors(errors, drop, before) {
  const same = ([path]) => {
    const [part, index] = path.split(".");
    if (valueAt(drop, path) === undefined || drop.balls.length !== before.balls.length) return false;
    const kind = { balls: "name", contacts: "law" }[part];
    return !kind || drop[part][index][kind] === before[part][index]?.[kind];
  };
  const kept = Object.entries(errors).filter(same);
  return kept.length === Object.keys(errors).length ? errors : Object.fromEntries(kept);
}

/** Keep `prediction` of the store in step with the result and the errors: one request at a time, the newest counts. */
export function carryErrors(store, api) {
  let asking = false;
  const isEmpty = () => Object.keys(store.get().errors).length === 0;

  const ask = async () => {
    if (asking || isEmpty()) return;
    asking = true;
    const asked = store.get();
    const { drop, errors, until } = asked;
    let prediction;
    try {
      prediction = await api.predict(drop, errors, until);
    } catch (error) {
      prediction = { problem: error.message };
    }
    asking = false;
    const now = store.get();
    if (now.result === asked.result && now.errors === errors && now.drop === drop) store.set({ prediction });
    else ask();
  };
  store.subscribe((state, before) => {
    const shape = state.drop !== before.drop && state.errors === before.errors;
    const errors = shape ? keptErrors(state.errors, state.drop, before.drop) : state.errors;
    if (errors !== state.errors) {
      store.set({ errors });
      return;
    }
    const changed = state.drop !== before.drop || state.errors !== before.errors || state.until !== before.until;
    if (changed && state.prediction) store.set({ prediction: null });
    if (state.result && (state.result !== before.result || state.errors !== before.errors)) ask();
  });
}
