/** What the package tells the page: balls, laws, cases, units, limits. Filled once, from model.json. */

export const known = {};

export function learn(data) {
  Object.assign(known, data, { models: Object.fromEntries(data.laws.map((kind) => [kind.law, kind])) });
}
