/** Marks the page while the result that it shows is not that of its numbers. */

const PATIENCE = 400; // ms, in which a result may come without the page being dimmed

/** Keep the class "stale" of an element in step with the store. */
export function markStale(store, element) {
  let timer = 0;
  const mark = (isStale) => {
    clearTimeout(timer);
    timer = 0;
    element.classList.toggle("stale", isStale);
  };
  store.subscribe((state, before) => {
    const { result, resultOf, drop, until, error } = state;
    const belongs = !result || (resultOf.drop === drop && resultOf.until === until);
    if (belongs) mark(false);
    else if (error) mark(true);
    else if (result !== before.result) mark(false); // the results follow the numbers, as fast as they can
    if (!belongs && !error) timer ||= setTimeout(mark, PATIENCE, true);
  });
}
