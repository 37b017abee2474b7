/** Runs a drop, and says what came out, as stackbounce/run has it: `simulate` returns a Result. */

import { theEngine } from "../model/one_ball.js";

/** Return the numbers of a drop as the engine takes them. */
export function numbersOf(drop) {
  const laws = drop.contacts.map((law) => (law === null ? [theEngine().forms.ABSENT, 1, 1, 0, 0] : law.engineNumbers()));
  const column = (place) => laws.map((one) => one[place]);
  return {
    mass: drop.balls.map(({ mass }) => mass),
    form: column(0),
    first: column(1),
    second: column(2),
    third: column(3),
    fourth: column(4),
    gap: [0, ...drop.gaps],
    velocity: drop.start,
    gravity: drop.gravity,
    rigid: drop.rigid,
  };
}

/** Run a drop: until a time in s or to its end, with a tolerance for nonlinear contacts and a limit of events. */
export function simulate(drop, { until = Infinity, rtol, eventLimit }) {
  const numbers = numbersOf(drop);
  const again = (times) => theEngine().simulate(numbers, { until, rtol, eventLimit, times });
  return new Result(drop, again([]), again);
}

const SAMPLED = ["position", "velocity", "compression", "force", "stored"];
const STOPPED = ["TIME_REACHED", "EVENT_LIMIT", "INVALID"];

export class Result {
  constructor(drop, run, again) {
    Object.assign(this, { drop, run, again });
    const { statuses } = theEngine();
    this.status = Object.keys(statuses).find((name) => statuses[name] === run.status);
    this.end = run.time;
    this.speeds = [...run.velocity];
    this.rows = rowsOf(run.log);
    this.intervals = this.findIntervals();
  }

  /** Whether the run ended before the drop did. */
  get stopped() {
    return STOPPED.includes(this.status);
  }

  findIntervals() {
    const { log, events } = theEngine();
    const ends = [events.RELEASE, events.COLLISION];
    const found = this.rows
      .filter((row) => ends.includes(row[log.KIND]))
      .map((row) => ({
        contact: row[log.CONTACT],
        start: row[log.START],
        end: row[log.TIME],
        peak_force: row[log.PEAK_FORCE],
        peak_compression: row[log.PEAK_COMPRESSION],
        impulse: row[log.IMPULSE],
        peak_time: row[log.PEAK_TIME],
      }));
    return found.sort((a, b) => a.start - b.start || a.contact - b.contact);
  }

  /** How often each contact met; -1 for infinitely many times. */
  get collisions() {
    const count = (contact) => this.intervals.filter((one) => one.contact === contact).length;
    return this.drop.balls.map((_, i) => (this.run.infinite[i] ? -1 : count(i)));
  }

  /** Return the first or the last of the contacts' times, null where a contact never met. */
  perContact(field, choose) {
    return this.drop.balls.map((_, i) => {
      const own = this.intervals.filter(({ contact }) => contact === i).map((one) => one[field]);
      return own.length ? own.reduce((one, other) => choose(one, other)) : NaN;
    });
  }

  /** The kinetic energy at the end over that at the start. */
  get energyRetained() {
    const { balls, start } = this.drop;
    const heaviest = Math.max(...balls.map(({ mass }) => mass));
    const speed = Math.max(...start.map(Math.abs));
    const energy = (velocities) =>
      balls.reduce((sum, { mass }, i) => sum + (mass / heaviest) * ((velocities[i] / speed) * (velocities[i] / speed)), 0);
    const came = energy(start);
    return came > 0 ? energy(this.speeds) / came : NaN;
  }

  /** Return lists by ball or contact over ascending times in s: position, velocity, compression, force; stored energy. */
  sample(times) {
    const { samples } = this.again(times);
    return Object.fromEntries(SAMPLED.map((name) => [name, columnsOf(samples[name], this.drop.balls.length)]));
  }
}

/** Return the columns of a table that lies in rows, as lists. */
function columnsOf(values, count) {
  const columns = Array.from({ length: count }, () => new Array(values.length / count));
  for (let k = 0; k < values.length; k += 1) columns[k % count][Math.floor(k / count)] = values[k];
  return columns;
}

/** Return the rows of a log by time; rows of one time stay in their order. */
function rowsOf(log) {
  const columns = theEngine().layout.sizes.log_columns;
  const { TIME } = theEngine().log;
  const rows = Array.from({ length: log.length / columns }, (_, i) => log.subarray(i * columns, (i + 1) * columns));
  return rows.sort((a, b) => a[TIME] - b[TIME]);
}
