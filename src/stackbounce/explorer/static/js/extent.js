/** The least and the largest of numbers. */

/** Return `[low, high]` of the numbers in a list, which may have gaps; `[Infinity, -Infinity]` where there are none. */
export function extentOf(values) {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return [low, high];
}
