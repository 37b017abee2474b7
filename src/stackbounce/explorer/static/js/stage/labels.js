/** Where words stand on the stage, so that none lies on another. */

/** Return places in px for words wanted at some: in the same order from above, `apart` from one another, not below `low`. */
export function spread(wanted, apart, low) {
  const order = wanted.map((_, i) => i).sort((a, b) => wanted[a] - wanted[b]);
  const places = [];
  let last = -Infinity;
  for (const i of order) {
    last = Math.max(wanted[i], last + apart);
    places[i] = last;
  }
  last = low + apart;
  for (const i of order.reverse()) {
    last = Math.min(places[i], last - apart);
    places[i] = last;
  }
  return places;
}
