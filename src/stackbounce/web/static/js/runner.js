/** Requests the result of the drop after each change: one request at a time, and only the newest drop counts. */

const REST = 30; // ms without a change

/** Keep `result`, `busy` and `error` of the store in step with `drop` and `until`; `again()` asks anew. */
export function run(store, api) {
  let timer = 0;
  let asking = false;
  let stale = false;
  let adopted = null; // a drop that came with its result

  const start = async () => {
    if (asking) {
      stale = true;
      return;
    }
    asking = true;
    stale = false;
    const { drop, until } = store.get();
    const patch = await answer(api, drop, until);
    asking = false;
    if (patch.result && store.get().drop === drop && hasTexts(drop)) {
      adopted = patch.result.drop;
      patch.drop = adopted;
    }
    if (stale) delete patch.error; // an error of an older state is not reported
    store.set({ ...patch, busy: stale });
    if (stale) start();
  };
  const again = () => {
    store.set({ busy: true });
    clearTimeout(timer);
    timer = setTimeout(start, REST);
  };
  store.subscribe((state, before) => {
    const other = state.drop !== before.drop && state.drop !== adopted;
    if (other || state.until !== before.until) again();
  });
  again();
  return { again };
}

async function answer(api, drop, until) {
  try {
    return { result: await api.simulate(drop, until), error: null };
  } catch (error) {
    return { error: { detail: error.message, offline: Boolean(error.offline) } };
  }
}

/** Return whether a drop has texts with units, as a link may bring them: the result has them as numbers. */
function hasTexts(value, key = "") {
  if (typeof value === "string") return !["name", "law", "reloading"].includes(key);
  if (value === null || typeof value !== "object") return false;
  return Object.entries(value).some(([name, member]) => hasTexts(member, name));
}
