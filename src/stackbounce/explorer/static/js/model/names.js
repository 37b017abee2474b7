/** What a ball is called in English, which the words of the page translate. */

/** Return a ball's name, or its place: the lowest is ball 1, and two are the lower and the upper one. */
export function nameBall({ balls }, ball) {
  if (balls[ball]?.name) return balls[ball].name;
  if (balls.length === 1) return "ball";
  if (balls.length === 2) return ball === 1 ? "upper ball" : "lower ball";
  return `ball ${ball + 1}`;
}
