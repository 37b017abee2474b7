/** What fails while the server is away is tried again by itself, with growing pauses, until it is done. */

const FIRST = 1000; // ms before the second try
const MOST = 30_000; // ms between two tries

/**
 * Try until it is done; `failed` hears each error. Returns what tries at once.
 * @param {() => Promise<void>} attempt @param {(error: Error) => void} failed
 */
export function retry(attempt, failed) {
  let pause = FIRST;
  let timer = 0;
  let busy = false;
  const once = async () => {
    if (busy) return;
    clearTimeout(timer);
    busy = true;
    try {
      await attempt();
    } catch (error) {
      failed(error);
      timer = setTimeout(once, pause);
      pause = Math.min(2 * pause, MOST);
    }
    busy = false;
  };
  once();
  return once;
}
