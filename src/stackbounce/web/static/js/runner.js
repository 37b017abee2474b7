/** Asks for a drop's result whenever the drop has changed: one request at a time, the newest wins. */

const REST = 30; // ms without a change

/** Keep `result`, `busy` and `error` of the store in step with `drop` and `until`. */
export function run(store, api) {
  let timer = 0;
  let busy = false;
  let wanted = false;

  const start = async () => {
    timer = 0;
    if (busy) {
      wanted = true;
      return;
    }
    busy = true;
    wanted = false;
    const { drop, until } = store.get();
    const patch = { busy: false };
    try {
      const result = await api.simulate(drop, until);
      Object.assign(patch, { result, error: null });
      // A link may bring texts with units; from here on they are numbers.
      if (store.get().drop === drop && hasTexts(drop)) patch.drop = result.drop;
    } catch (error) {
      patch.error = { detail: error.message, offline: Boolean(error.offline) };
    }
    busy = false;
    own = patch.drop ?? own;
    if (wanted) {
      delete patch.busy;
      if (patch.error) delete patch.error;
    }
    store.set(patch);
    if (wanted) start();
  };

  let own = null;
  const ask = () => {
    store.set({ busy: true });
    clearTimeout(timer);
    timer = setTimeout(start, busy ? 0 : REST);
  };
  store.subscribe((state, before) => {
    if (state.drop === own && before.until === state.until) return;
    if (state.drop !== before.drop || state.until !== before.until) ask();
  });
  ask();
  return { again: ask };
}

function hasTexts(value, key = "") {
  if (typeof value === "string") return !["name", "law", "reloading"].includes(key);
  if (value === null || typeof value !== "object") return false;
  return Object.entries(value).some(([name, member]) => hasTexts(member, name));
}
