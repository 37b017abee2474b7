/** English sentences that the package or its engine composes, as the page meets them; the first one that fits counts. What stands for {number}
 * must be known, as any sentence may have an "of". */
export const PATTERNS = [
  "must be {right}, got {value}",
  "a positive number of seconds, at most {most}",
  "a positive number of {unit}",
  "a finite number of {unit}",
  "a number of {unit}, 0 or above",
  "a number from {low} to {high}",
  "a number, {low} or above",
  "rebound speed of {ball} over v₀",
  "rebound height of {ball}",
  "collisions of {contact}",
  "gap above {ball}", "height of flight {place}",
  "{number} of {place}",
  "ball {place}",
  "{lower} and {upper} in series",
];

/** What stands at a place of these, such as the balls of a contact; a sentence of its own can look the same by chance. */
export const PARTS = ["bounce {place}", "flight {place}", "floor and {ball}", "{lower} and {upper}", "ball", "lower ball", "upper ball"];
