/** What the classes of made/laws.js derive from: fields with limits, and copies as plain values. */

import { within } from "./errors.js";

/** A law of a contact. `tell` gives each class its constants, its fields, and the limits of its numbers. */
export class LawBase {
  static tell({ constants, law, fields = [], numbers = {} }) {
    Object.assign(this, constants);
    Object.assign(this.prototype, constants);
    Object.defineProperty(this, "__name__", { value: law ?? this.name });
    this.fields = fields;
    const check = (limits) => (name, value) => within(name, value, limits);
    this.numbers = Object.fromEntries(Object.entries(numbers).map(([name, one]) => [name, { ...one, check: check(one) }]));
  }

  /** Return a law of values in the order of its fields, and of values by name; they are checked. */
  static make(values, named = {}) {
    const law = new this();
    const inOrder = this.fields.filter((field) => !field.named);
    for (const { name, default: usual } of this.fields) {
      const place = inOrder.findIndex((field) => field.name === name);
      law[name] = named[name] ?? (place >= 0 && place < values.length ? values[place] : (usual ?? null));
    }
    law.__post_init__();
    return law;
  }

  static quantities() {
    return this.numbers;
  }

  quantities() {
    return this.constructor.numbers;
  }

  /** Return a copy with fields changed. */
  replaced(changes) {
    return this.constructor.make([], { ...this.given(), ...changes });
  }

  /** Return the law as plain values, with its name as `law`. */
  to_mapping() {
    return { law: this.constructor.__name__, ...this.given() };
  }

  given() {
    return Object.fromEntries(this.constructor.fields.map(({ name }) => [name, this[name]]));
  }
}

/** A number of a law that a formula checks by itself. */
export class Quantity {
  static make([unit, check]) {
    return Object.assign(new Quantity(), { unit, check });
  }
}
