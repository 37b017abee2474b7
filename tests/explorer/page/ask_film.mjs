// What the page shows of drops: `node ask_film.mjs PAGE DROPS ANSWERS EVENTS`.
//
// DROPS is a list of [drop, until] in JSON; ANSWERS has {error} of each or {status, sentence, film}: the film's length and
// events, and at SAMPLES film times its positions, the textbook's, and the places of the balls in a picture.

import { readFileSync, writeFileSync } from "node:fs";

const [page, drops, answers, events] = process.argv.slice(2);
const made = (name) => readFileSync(`${page}/made/${name}`);
const use = (name) => import(`${page}/js/${name}.js`);
const { openDesk } = await use("answers/desk");
const { filmOf, pieceAt, sameMoment } = await use("stage/film");
const { cameraOf } = await use("stage/camera");
const { storyOf } = await use("words/sentence");
const model = JSON.parse(made("model.json"));
model.limits.events = Number(events);
const desk = await openDesk({ engine: made("engine.wasm"), layout: JSON.parse(made("layout.json")), model });

const SAMPLES = 400;
const PICTURE = { width: 420, height: 500 };

function shown(film, result) {
  const camera = cameraOf(film, result, { ...PICTURE, magnify: null });
  return Array.from({ length: SAMPLES + 1 }, (_, i) => {
    const reel = (film.length * i) / SAMPLES;
    const time = film.toTime(reel);
    const { position, velocity, compression, sideways } = film.at(time);
    const view = camera.at(time, position);
    const centres = position.map((one, ball) => view.lift + view.rest[ball] + view.move * one);
    return {
      time,
      back: film.toFilm(time) - reel,
      phase: pieceAt(film, time).phase,
      position,
      velocity,
      compression,
      sideways,
      ghosts: film.ghosts?.at(time) ?? null,
      top: centres.at(-1) + view.radius.at(-1),
      bottom: centres[0] - view.radius[0] + view.move * Math.max(0, compression[0]),
      scale: view.scale,
    };
  });
}

const found = JSON.parse(readFileSync(drops, "utf8")).map(([drop, until]) => {
  try {
    const result = desk.simulate(drop, until, 600);
    const film = filmOf(result, until);
    const same = sameMoment(film, film.end, film) === film.end && sameMoment(film, film.begin, film) === film.begin;
    const { length, slow, begin, end, last, tops } = film;
    const told = { length, slow, begin, end, last, tops, events: film.events, same, shown: shown(film, result) };
    return { status: result.status, speeds: result.rebound_speeds, sentence: storyOf(result, until), film: told };
  } catch (error) {
    return { error: error.stack };
  }
});
writeFileSync(answers, JSON.stringify(found));
