/** Computes the result of the drop after each change: only the newest drop counts. */

import { FIRST_DROP } from "../state/store.js";
import { t, translated } from "../words/language.js";

const ALL = 1500; // frames of a result
const FEW = 300; // frames while numbers change, where each frame of the screen counts
const REST = 150; // ms without a change

/** Keep `result`, `busy` and `error` of the store in step with `drop` and `until`; `again()` asks anew. */
export function run(store, api) {
  let newest = 0; // question
  let shown = 0; // question whose answer is shown
  let timer = 0;
  let changed = -Infinity; // ms, when the last change was

  /** Have the result of a drop computed; return what changes at once. */
  const begin = ({ drop, until }) => {
    clearTimeout(timer);
    const quick = performance.now() - changed < REST;
    changed = performance.now();
    const result = api.playAtOnce(drop, until, FEW);
    if (quick || result) timer = setTimeout(() => ask(ALL), REST);
    if (!result) {
      ask(quick ? FEW : ALL);
      return { busy: true };
    }
    newest += 1;
    shown = newest;
    return { result, resultOf: { drop, until }, error: null, busy: true };
  };
  const ask = async (frames) => {
    newest += 1;
    const mine = newest;
    const { drop, until } = store.get();
    const patch = await answer(api, drop, until, frames);
    if (!patch || mine < shown) return;
    shown = mine;
    const last = mine === newest;
    if (!last) delete patch.error; // an error of an older state is not reported
    if (patch.error && !patch.error.offline && !store.get().result && drop !== FIRST_DROP) {
      const notice = t("The drop of the link cannot be shown: {reason}. This is another one.", { reason: translated(patch.error.detail) });
      store.set({ drop: FIRST_DROP, until: null, errors: {}, notice });
      return;
    }
    store.set({ ...patch, busy: !last || (frames === FEW && !patch.error) });
  };
  store.derive((state, before) => (state.drop !== before.drop || state.until !== before.until ? begin(state) : null));
  const again = () => store.set(begin(store.get()));
  again();
  return { again };
}

/** Return what a drop's result changes in the state; null where a newer drop took its place. */
async function answer(api, drop, until, frames) {
  try {
    return { result: await api.play(drop, until, frames), resultOf: { drop, until }, error: null };
  } catch (error) {
    if (error.replaced) return null;
    return { error: { detail: error.message, offline: Boolean(error.offline) } };
  }
}
