/** The engine as WebAssembly: runs drops where the page is, and gives the bits that the server gives. */

const LINE = 64; // bytes of a cache line, where each block of numbers begins
const WORD = 8; // bytes of a number
const PAGE = 65536; // bytes by which memory grows

/** Return the engine, from the bytes of `engine.wasm` and `layout.json` that was written with it. */
export async function loadEngine(bytes, layout) {
  const { instance } = await WebAssembly.instantiate(bytes, {});
  return new Engine(instance.exports, layout);
}

/**
 * A drop is {mass, form, first, second, third, fourth, gap, velocity, gravity, rigid}: arrays with a number for each ball
 * or the contact below it, in SI units, `gravity` a number, `rigid` true or false; `form` is the code of a form of force, and the four
 * numbers after it are those of that form. Many drops of one height are the same with a row for each in flat arrays, `gravity` being an array.
 */
class Engine {
  constructor(exports, layout) {
    const { forms, statuses, events, log } = layout; // codes of some forms of force, of how a run ended, of events; columns of a log
    Object.assign(this, { exports, layout, forms, statuses, events, log });
    this.room = new Room(exports.memory, exports.__heap_base.value, layout.records);
    this.stacks = new Map();
  }

  /**
   * Run one drop: until a time in s, with a relative tolerance of 1e-14 to 1e-3, and at most so many events. The
   * log has the peaks of forces, unless `peaks` is false.
   *
   * Returns its status, the time of its end, the balls' velocities then, the log in rows of columns, 1 in `infinite`
   * where rigid balls have collided infinitely often, and samples at the given times, which ascend.
   */
  simulate(drop, { rtol = 1e-12, until = Infinity, eventLimit = 1e6, times = [], peaks = true } = {}) {
    const { stages, after, statuses, counter, sizes } = this.layout;
    const balls = drop.mass.length;
    const { stack, space, one, none } = this.stack(drop.rigid, balls);
    this.put(one, { ...drop, gravity: [drop.gravity] });
    return this.room.lend((room) => {
      const samples = times.length ? room.make("Samples", { balls, times: times.length }) : none;
      for (const name of Object.keys(samples.arrays)) room.floats(samples, name).fill(0);
      room.floats(samples, "time").set(times);
      const entry = drop.rigid ? "run_rigid_drop" : "run_drop";
      const parts = [];
      let status = statuses.RUNNING;
      for (let stage = peaks ? stages.BEGIN_WITH_PEAKS : stages.BEGIN; status === statuses.RUNNING; stage = stages.CONTINUE) {
        status = this.call(entry, stack, space, one, samples, 0, stage, until, rtol, ...this.limits(eventLimit));
        const rows = room.read(stack, "counter")[counter.LOG_ROWS];
        parts.push(room.floats(space, "log").slice(0, rows * sizes.log_columns));
      }
      const ends = room.read(space, "after");
      return {
        status,
        time: ends[after.END],
        velocity: ends.slice(after.AFTER),
        log: joined(parts),
        infinite: drop.rigid ? room.read(stack, "infinite") : new Int32Array(balls),
        samples: { ...room.readAll(samples), time: Float64Array.from(times) },
      };
    });
  }

  /**
   * Run many drops, with options as for one; return the arrays of their outcomes.
   *
   * `lanes` names the kernel of an engine that is many times faster, where there is one: for two balls without gravity
   * that come at one speed and are run to their end.
   */
  sweep(drops, { rtol = 1e-12, until = Infinity, eventLimit = 1e6, lanes = null } = {}) {
    const count = drops.gravity.length;
    const balls = count ? drops.mass.length / count : 1;
    const { stack, space, none } = lanes ? {} : this.stack(drops.rigid, balls);
    const outcomes = this.room.lend((room) => {
      const given = room.make("Drops", { balls, drops: count });
      const out = room.make("Outcomes", { balls, drops: count });
      this.put(given, drops);
      room.write(out, "status", new Array(count).fill(this.layout.statuses.ASK)); // none is under way
      room.write(out, "work", new Array(count).fill(0)); // not counted of springs and rigid balls in lanes
      if (lanes) {
        const scratch = room.make("Workspace", { balls, scratch: this.layout.sizes.scratch });
        this.call(lanes, given, lanes === "run_pairs" ? rtol : eventLimit, out, scratch);
      } else {
        const entry = drops.rigid ? "run_rigid_batch" : "run_batch";
        const limits = this.limits(eventLimit);
        for (let row = 0; row < count; ) row = this.call(entry, stack, space, given, none, until, rtol, ...limits, out, row);
      }
      return room.readAll(out);
    });
    if (lanes) this.answer(drops, outcomes, { rtol, until, eventLimit });
    return outcomes;
  }

  /** Run the drops that an engine in lanes is not sure of by the general engine. */
  answer(drops, outcomes, options) {
    const { limits, statuses } = this.layout;
    const rows = [...outcomes.status.keys()].filter((row) => outcomes.status[row] === statuses.ASK);
    if (!rows.length) return;
    const near = { ...options, rtol: Math.min(options.rtol, limits.asked) };
    const width = (values) => values.length / outcomes.status.length;
    const some = { rigid: false };
    for (const { name } of this.layout.records.Drops) {
      const each = width(drops[name]);
      some[name] = rows.flatMap((row) => Array.from(drops[name].slice(row * each, (row + 1) * each)));
    }
    for (const [name, values] of Object.entries(this.sweep(some, near))) {
      const each = values.length / rows.length;
      rows.forEach((row, k) => outcomes[name].set(values.subarray(k * each, (k + 1) * each), row * each));
    }
  }

  /** Lend pushes that move a stack sideways: `use` gets `{put(numbers), read(name), call(entry, ...given)}`. */
  lendPushes(balls, times, use) {
    return this.room.lend((room) => {
      const pushes = room.make("Pushes", { balls, times });
      for (const name of Object.keys(pushes.arrays)) room.floats(pushes, name).fill(0);
      return use({
        put: (numbers) => Object.entries(numbers).forEach(([name, values]) => room.write(pushes, name, values)),
        read: (name) => room.read(pushes, name),
        call: (entry, ...given) => this.call(entry, pushes, ...given),
      });
    });
  }

  /** Return the limits of a run: events, and the work that a run may cost, which is more where more events are asked for. */
  limits(eventLimit) {
    const { work, events: usual } = this.layout.limits;
    return [eventLimit, Math.floor((work * Math.max(usual, eventLimit)) / usual)];
  }

  /** Return the memory of runs of stacks of one height, which is kept. */
  stack(rigid, balls) {
    const key = `${rigid ? "rigid" : "finite"} ${balls}`;
    if (!this.stacks.has(key)) {
      const stack = this.room.make(rigid ? "RigidStack" : "Stack", { balls });
      this.stacks.set(key, {
        stack,
        space: this.room.make("Workspace", { balls, scratch: 0 }, { floats: stack.float, integers: stack.int }),
        one: this.room.make("Drops", { balls, drops: 1 }),
        none: this.room.make("Samples", { balls, times: 0 }),
      });
    }
    return this.stacks.get(key);
  }

  /** Write the numbers of drops. */
  put(record, drops) {
    for (const name of Object.keys(record.arrays)) this.room.write(record, name, drops[name]);
  }

  /** Call an entry with records and numbers; return its answer. */
  call(entry, ...given) {
    const kinds = this.layout.entries[entry];
    const passed = given.map((value, k) => value.address ?? (kinds[k] === "int" ? BigInt(value) : value));
    const answer = Number(this.exports[entry](...passed));
    if (answer < 0) throw new Error(`${entry} failed`);
    return answer;
  }
}

/** Memory: what is made stays, but what is made in `lend` is gone after it. */
class Room {
  constructor(memory, begin, records) {
    this.memory = memory;
    this.top = begin;
    this.records = records;
    this.look();
  }

  look() {
    this.f64 = new Float64Array(this.memory.buffer);
    this.i64 = new BigInt64Array(this.memory.buffer);
  }

  lend(use) {
    const before = this.top;
    try {
      return use(this);
    } finally {
      this.top = before;
    }
  }

  /** Return the address of room for so many numbers. */
  take(numbers) {
    const address = Math.ceil(this.top / LINE) * LINE;
    const end = address + WORD * numbers;
    const lacking = end - this.memory.buffer.byteLength;
    if (lacking > 0) {
      this.memory.grow(Math.ceil(lacking / PAGE));
      this.look();
    }
    this.top = end;
    return address;
  }

  /** Make a record: blocks of its floats and integers, but for what lies elsewhere, and the table of all. */
  make(name, sizes, elsewhere = {}) {
    const blocks = { float: { length: 0 }, int: { length: 0 } };
    const arrays = {};
    for (const field of this.records[name]) {
      const [rows, columns] = [total(field.rows, sizes), total(field.columns, sizes)];
      const block = blocks[field.kind];
      arrays[field.name] = { block, from: block.length, length: rows * columns, rows, columns };
      block.length += rows * columns;
    }
    for (const block of Object.values(blocks)) block.address = this.take(block.length);
    const address = this.take(3 * this.records[name].length);
    const table = Object.entries(arrays).flatMap(([field, array]) => {
      array.at = array.block.address / WORD + array.from;
      array.whole = array.block === blocks.int;
      const other = elsewhere[field];
      return other ? [other.address, other.length, 1] : [array.at * WORD, array.rows, array.columns];
    });
    this.i64.set(table.map(BigInt), address / WORD);
    return { address, arrays, ...blocks };
  }

  /** Return an array of floats as it lies in memory: a view until memory grows. */
  floats(record, name) {
    const { at, length } = record.arrays[name];
    return this.f64.subarray(at, at + length);
  }

  /** Return a copy of an array. */
  read(record, name) {
    const { at, length, whole } = record.arrays[name];
    return whole ? Int32Array.from(this.i64.subarray(at, at + length), Number) : this.f64.slice(at, at + length);
  }

  readAll(record) {
    return Object.fromEntries(Object.keys(record.arrays).map((name) => [name, this.read(record, name)]));
  }

  write(record, name, values) {
    const { at, whole } = record.arrays[name];
    if (whole) this.i64.set(Array.from(values, BigInt), at);
    else this.f64.set(values, at);
  }
}

/** Return a sum of products of sizes, such as {"": 3, "balls times": 2}. */
function total(terms, sizes) {
  let sum = 0;
  for (const [names, factor] of Object.entries(terms)) {
    sum += names ? names.split(" ").reduce((product, name) => product * sizes[name], factor) : factor;
  }
  return sum;
}

function joined(parts) {
  if (parts.length === 1) return parts[0];
  const all = new Float64Array(parts.reduce((length, part) => length + part.length, 0));
  parts.reduce((at, part) => all.set(part, at) ?? at + part.length, 0);
  return all;
}
