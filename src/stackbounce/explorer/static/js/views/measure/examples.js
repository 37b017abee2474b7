/** The drops of the records for a try, made by stackbounce itself: each as somebody would know it beforehand. */

import { PAPER_DROP } from "../../state/store.js";

const TWO_BALLS = {
  balls: [
    { mass: 0.101, diameter: 0.058, name: "B1" },
    { mass: 0.0248, diameter: 0.038, name: "B2" },
  ],
  contacts: [
    { law: "Dashpot", stiffness: 54000, damping: 4 },
    { law: "Dashpot", stiffness: 24000, damping: 4 },
  ],
  gaps: [0],
  height: 1,
  gravity: 9.80665,
};

export const EXAMPLES = { "floor-force.csv": PAPER_DROP, "two-tracks.csv": TWO_BALLS };
