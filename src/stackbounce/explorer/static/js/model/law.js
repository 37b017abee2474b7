/** The contact laws: model.json has the fields of each, their limits, and what the engine takes. */

import { LAW_CODE } from "../../made/laws.js";
import { InvalidValue, between, fraction, general, within, writeFloat } from "./errors.js";
import { known } from "./known.js";

/** Return the kind of the law without a contact time. */
export function rigidKind() {
  return Object.values(known.models).find((kind) => kind.rigid);
}

/** A law of a contact, of a kind, with its numbers. */
export class Law {
  /** Take numbers by name, which are checked; where one is not given it is the usual one. */
  constructor(kind, numbers) {
    Object.defineProperties(this, { kind: { value: kind }, derived: { value: "", writable: true } });
    this.exponent = kind.exponent;
    for (const { name, usual } of kind.fields) this[name] = numbers[name] ?? usual ?? null;
    const twins = kind.loss_fields.length > 1 ? kind.loss_fields : [];
    for (const { name, ...limits } of kind.fields) if (!twins.includes(name)) within(name, this[name], limits);
    if (twins.length) this.derive();
  }

  get rigid() {
    return this.kind.rigid;
  }

  /** Set restitution and unloading exponent, of which one is given: e² = (p + 1)/(n + 1). */
  derive() {
    const { exponent: p, restitution, unloading_exponent: unloading } = this;
    const { steepest } = known;
    const e = restitution === null ? null : fraction("restitution", restitution, { zero: false });
    const n = unloading === null ? null : between("unloading_exponent", unloading, p, steepest);
    const fromE = e && Math.max(p, (p + 1) / e / e - 1);
    const fromN = n && Math.sqrt((p + 1) / (n + 1));
    if (n === null && fromE > steepest) {
      const least = general(1.001 * Math.sqrt((p + 1) / (steepest + 1)), 3);
      const why = `for exponent ${general(p)}, so that unloading_exponent is at most ${general(steepest)}`;
      throw new InvalidValue(`restitution must be at least ${least} ${why}, got ${writeFloat(restitution)}`);
    }
    if (e !== null && (n === null || n === fromE)) Object.assign(this, { unloading_exponent: fromE, derived: "unloading_exponent" });
    else if (n !== null && (e === null || e === fromN)) Object.assign(this, { restitution: fromN, derived: "restitution" });
    else {
      throw new InvalidValue(`restitution and unloading_exponent: exactly one of the two must be given, got ${e === null ? "neither" : "both"}`);
    }
  }

  /** Return the law as the engine takes it: the form of its force, and four numbers. */
  engineNumbers() {
    const { law, form, parameters } = this.kind;
    const parameter = (name) => (name ? this[name] : 0);
    return [form, ...(LAW_CODE[law]?.numbers?.(this) ?? [this.stiffness ?? 1, this.exponent ?? 1, ...parameters.map(parameter)])];
  }

  /** Return a copy with some numbers changed; a derived one is computed again. */
  replaced(changes) {
    const numbers = this.given();
    const twins = this.kind.loss_fields;
    if (twins.some((name) => name in changes)) for (const name of twins) delete numbers[name];
    return new Law(this.kind, { ...numbers, ...changes });
  }

  /** Return the law as plain values, with its name as `law`. */
  toMapping() {
    return { law: this.kind.law, ...this.given() };
  }

  given() {
    const names = this.kind.fields.map(({ name }) => name).filter((name) => name !== this.derived);
    return Object.fromEntries(names.map((name) => [name, this[name]]));
  }
}
