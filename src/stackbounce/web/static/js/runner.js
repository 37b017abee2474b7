/** Computes the result of the drop after each change: only the newest drop counts. */

/** Keep `result`, `busy` and `error` of the store in step with `drop` and `until`; `again()` asks anew. */
export function run(store, api) {
  let newest = 0;
  let adopted = null; // a drop that came with its result

  const again = async () => {
    newest += 1;
    const mine = newest;
    if (!store.get().busy) store.set({ busy: true });
    const { drop, until } = store.get();
    const patch = await answer(api, drop, until);
    if (!patch) return;
    if (mine !== newest) delete patch.error; // an error of an older state is not reported
    if (patch.result && store.get().drop === drop && hasTexts(drop)) {
      adopted = patch.result.drop;
      patch.drop = adopted;
    }
    store.set({ ...patch, busy: mine !== newest });
  };
  store.subscribe((state, before) => {
    const other = state.drop !== before.drop && state.drop !== adopted;
    if (other || state.until !== before.until) again();
  });
  again();
  return { again };
}

/** Return what a drop's result changes in the state; null where a newer drop took its place. */
async function answer(api, drop, until) {
  try {
    return { result: await api.play(drop, until), error: null };
  } catch (error) {
    if (error.replaced) return null;
    return { error: { detail: error.message, offline: Boolean(error.offline) } };
  }
}

/** Return whether a drop has texts with units, as a link may bring them: the result has them as numbers. */
function hasTexts(value, key = "") {
  if (typeof value === "string") return !["name", "law", "reloading"].includes(key);
  if (value === null || typeof value !== "object") return false;
  return Object.entries(value).some(([name, member]) => hasTexts(member, name));
}
