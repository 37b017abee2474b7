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
  "gap above {ball}", "height of flight {place}", "time of flight {place}", "flight after bounce {place}", "height after bounce {place}",
  "apex height after bounce {place}", "largest acceleration in bounce {place}",
  "{place} (agrees)", "{place} (doubtful)", "{place} (refuted)",
  "from {number}", "{number} of {place}",
  "ball {place}",
  "{lower} and {upper} in series",
  "{place}: {number}",
];

/** What stands at a place of these, such as the balls of a contact; a sentence of its own can look the same by chance. */
export const PARTS = ["bounce {place}", "flight {place}", "knock {place}", "contact {place}", "floor and {ball}", "{lower} and {upper}", "ball", "lower ball", "upper ball"];

/** What measurements find: the names of the rows of their tables. */
export const FOUND = [
  "contacts", "touch", "release", "peaks", "peak force", "impulse", "rise", "fall", "further contacts, not listed", "dynamic stiffness",
  "noise", "baseline", "amplitude of the subtracted hum", "gap between the balls", "delay of their touch", "force",
  "stiffness ratio, floor over balls", "stiffness at the floor", "stiffness between the balls", "compression of the lower ball's bottom",
  "compression of the lower ball's top", "compression of the upper ball", "compression between the centres",
  "compression beyond the sum of each alone", "static stiffness, straight line", "stiffness of the power law", "energy lost",
  "unloading exponent, from the energy", "unloading exponent, from the curve", "peak compression", "stiffness at the peak, tangent",
  "stiffness at the peak, secant", "work in loading", "work in unloading", "compression at contact, as recorded",
  "force with nothing pressed, as recorded", "drop of the force at the turn", "cycle", "rebound ratio", "drop height",
  "drop height, given", "drop height, inferred from the mean energy retained", "apex height", "time", "time of fall",
  "gravity of the flights", "restitution, mean", "restitution at 0 (linear)", "its fall per m/s (linear)",
  "restitution at 1 m/s (power law)", "exponent of its fall (power law)", "scatter of restitution from bounce to bounce",
  "law", "sounds left out", "loudness", "drag coefficient", "density of the air",
];
