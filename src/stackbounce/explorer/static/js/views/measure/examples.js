/** Records for a try, made by stackbounce itself, each with the drop as somebody would know it beforehand. */

import { t } from "../../words/language.js";
import { FIRST_DROP } from "../../state/store.js";

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

export const EXAMPLES = [
  {
    file: "floor-force.csv",
    title: t("Force on the floor"),
    says: t("A tennis ball on a basketball. Made with springs of 2.70 and 1.35 kN/m: 20 000 samples a second, 0.5 N of noise."),
    drop: FIRST_DROP,
  },
  {
    file: "two-tracks.csv",
    title: t("Video of two balls"),
    says: t(
      "The paper’s ball B2 on B1 from 1 m, as Tracker exports it. Made with dampings of 8 and 2 N s/m: 120 frames a second, points unsure by 4 mm.",
    ),
    drop: TWO_BALLS,
  },
];
