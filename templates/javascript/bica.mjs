// The runtime of generated components. Names that begin with $ belong to it; all others are names of the design.
// Times are whole nanoseconds in doubles, which are exact up to 2^53 ns (104 days).

const MAX_INT = 2 ** 53;

export const STAY = Object.freeze([""]);

/** Holds one instance of each component, and runs iterations. */
export class Root {
  iteration = 0;
  nowNs = 0;
  trace = null;
  #lagNs = 0;
  #components = new Map();

  /** Returns the instance of a component; `use` gives another one, such as a hand-written subclass. */
  component(type) {
    if (!this.#components.has(type)) {
      this.#components.set(type, new type(this));
    }
    return this.#components.get(type);
  }

  use(type, instance) {
    this.#components.set(type, instance);
  }

  /** Runs one iteration. With an array in `trace`, each step appends its record. */
  step(component, clockNs) {
    if (!Number.isSafeInteger(clockNs)) {
      throw new RangeError(`${clockNs} is no whole number of nanoseconds up to 2^53`);
    }
    this.iteration += 1;
    this.#lagNs += Math.max(0, this.nowNs - this.#lagNs - clockNs);
    this.nowNs = clockNs + this.#lagNs;
    component.$step(null, "root", {});
  }
}

/** A component. One without a design overrides `$work` and `$restart`, and has outputs as properties or methods. */
export class Component {
  $states = null;
  $state = "";
  $parameters = {};
  /** The parameters of the newest call, also those that have the name of an output. */
  $given = {};
  $names = [];
  #initial = "";
  #steppedIn = null;
  #restartedIn = null;
  #startedNs = 0;
  #enteredNs = 0;
  #workedNs = 0;
  #calls = [];
  #stored = [];
  #left = null;
  #transition = null;

  constructor(root, name, { periodNs = 0, resume = false, xabsl = false } = {}) {
    this.$root = root;
    this.$name = name;
    this.$periodNs = periodNs;
    this.$resume = resume;
    this.$isXabsl = xabsl;
  }

  /** With the rules of XABSL: whether each step of this iteration is a restart. */
  get #isRestartedAgain() {
    return this.$isXabsl && this.#restartedIn === this.$root.iteration;
  }

  $work() {}
  $restart() {}
  $decideCommon() {}
  $actCommon() {}

  /** Declares the values with their initial ones; parameters get these also when a call omits them. */
  $declare(parameters, values) {
    this.$parameters = this.$given = parameters;
    this.#stored = Object.keys(parameters).filter((name) => !Object.hasOwn(values, name));
    this.$names = Object.keys({ ...parameters, ...values });
    Object.assign(this, parameters, values);
  }

  $define(initial, states) {
    this.#initial = this.$state = initial;
    this.$states = new Map(Object.entries(states));
  }

  $step(by, link, parameters) {
    const root = this.$root;
    const record = {};
    root.trace?.push(record);
    this.#left = this.#transition = null;
    const isStepped = this.#steppedIn === root.iteration;
    if (this.#steppedIn === null || (isStepped ? this.#isRestartedAgain : this.#steppedIn < root.iteration - 1)) {
      this.#start();
    }
    this.#steppedIn = root.iteration;
    this.#require(this.#active.requires ?? []);
    const hasWorked = root.nowNs - this.#workedNs >= this.$periodNs;
    if (hasWorked) {
      this.#workedNs = root.nowNs;
      this.#calls = [];
      this.#workOnce();
    } else {
      for (const [component, given] of this.#calls) {
        this.#stepWith(component, given);
      }
    }
    if (root.trace) {
      Object.assign(record, {
        component: this.$name,
        by,
        link,
        worked: hasWorked,
        state: this.$state,
        state_time_ns: root.nowNs - this.#enteredNs,
        component_time_ns: root.nowNs - this.#startedNs,
        changed_from: this.#left,
        transition: this.#transition,
        parameters,
        done: this.$done,
        values: this.$values(),
      });
    }
  }

  $values() {
    return Object.fromEntries(this.$names.map((name) => [name, this[name]]));
  }

  get $done() {
    if (this.#steppedIn === null || this.#active.final !== true) {
      return false;
    }
    const isAnew = this.#steppedIn === this.$root.iteration && this.#isRestartedAgain;
    return !isAnew && this.#steppedIn >= this.$root.iteration - 1;
  }

  get $actionDone() {
    return (this.#active.calls ?? []).some((component) => component.$done);
  }

  get $stateNs() {
    return this.$root.nowNs - this.#enteredNs;
  }

  get $componentNs() {
    return this.$root.nowNs - this.#startedNs;
  }

  $call(component, given) {
    const parameters = { ...component.$parameters, ...given };
    this.#calls.push([component, parameters]);
    this.#stepWith(component, parameters);
  }

  get #active() {
    return this.$states?.get(this.$state) ?? {};
  }

  #stepWith(component, parameters) {
    component.$given = parameters;
    for (const name of component.#stored) {
      component[name] = parameters[name];
    }
    component.$step(this.$name, "modulates", parameters);
  }

  #require(components) {
    for (const component of components) {
      component.$step(this.$name, "requires", {});
    }
  }

  #start() {
    this.#restartedIn = this.$root.iteration;
    if (this.$resume && this.#steppedIn !== null) {
      return;
    }
    this.#startedNs = this.#enteredNs = this.$root.nowNs;
    this.#workedNs = this.$root.nowNs - this.$periodNs;
    this.#calls = [];
    this.$state = this.#initial;
    this.$restart();
    this.#active.enter?.();
  }

  #workOnce() {
    if (this.$states === null) {
      this.$work();
      return;
    }
    const [target, transition = null] = this.$decideCommon() ?? this.#active.decide?.() ?? STAY;
    if (target !== "" && target !== this.$state) {
      this.#change(target, transition);
    }
    this.$actCommon();
    this.#active.act?.();
  }

  #change(target, transition) {
    const old = this.#active;
    old.leave?.();
    this.#left = this.$state;
    this.#transition = transition;
    this.$state = target;
    this.#enteredNs = this.$root.nowNs;
    this.#active.enter?.();
    const required = old.requires ?? [];
    this.#require((this.#active.requires ?? []).filter((component) => !required.includes(component)));
  }
}

// Ints. Those that are stored are numbers; an expression that may leave ±2^53 calculates with BigInt.

/** Returns a stored int: a number within ±2^53. */
export function limit(x) {
  return x > MAX_INT ? MAX_INT : x < -MAX_INT ? -MAX_INT : Number(x);
}

export const toBig = BigInt;
export const toNumber = Number;

/** Returns the result of an operation, limited to 64 bits. */
export function saturate(x) {
  return maximum(-(2n ** 63n), minimum(2n ** 63n - 1n, x));
}

function rounded(x) {
  // The sum turns -0 into 0.
  return x !== x ? 0 : limit(x) + 0;
}

export const toInt = (x) => rounded(Math.trunc(x));
export const floor = (x) => rounded(Math.floor(x));
export const ceil = (x) => rounded(Math.ceil(x));
export const round = (x) => rounded(halfEven(x));

function halfEven(x) {
  const below = Math.floor(x);
  const rest = x - below;
  return rest > 0.5 || (rest === 0.5 && below % 2 !== 0) ? below + 1 : below;
}

/** Returns a time in whole nanoseconds; it may be infinite or nan. */
export const nanoseconds = (time, unit) => halfEven(time * unit);

export function floorDivide(a, b) {
  if (b === 0) {
    return a / b;
  }
  let rest = a % b;
  let quotient = (a - rest) / b;
  if (rest !== 0 && b < 0 !== rest < 0) {
    quotient -= 1;
  }
  if (quotient === 0) {
    return Object.is(a / b, -0) || a / b < 0 ? -0 : 0;
  }
  const whole = Math.floor(quotient);
  return quotient - whole > 0.5 ? whole + 1 : whole;
}

export function modulo(a, b) {
  const rest = a % b;
  if (rest !== 0) {
    return b < 0 !== rest < 0 ? rest + b : rest;
  }
  return b < 0 ? -0 : 0;
}

export const xabslDivide = (a, b) => a / (b === 0 ? 1e-7 : b);

export function xabslModulo(a, b) {
  return Number.isFinite(a) && Number.isFinite(b) && Math.abs(b) >= 1 ? Math.trunc(a) % Math.trunc(b) : 0;
}

export const abs = (x) => (typeof x === "bigint" ? (x < 0n ? -x : x) : Math.abs(x));
export const minimum = (first, ...others) => others.reduce((a, b) => (b < a ? b : a), first);
export const maximum = (first, ...others) => others.reduce((a, b) => (b > a ? b : a), first);
export const clamp = (x, low, high) => (x < low ? low : high < x ? high : x);
export const sign = (x) => (x > 0 ? 1 : x < 0 ? -1 : 0);
export const isNan = (x) => x !== x;
export const hypot = (x, y) => Math.sqrt(x * x + y * y);
export const degrees = (x) => x * (180 / Math.PI);
export const radians = (x) => x * (Math.PI / 180);
export const { sqrt, exp, log, sin, cos, tan, asin, acos, atan, atan2 } = Math;

/** Compares a chain such as a < b < c; each operand is evaluated at most once. */
export function chain(first, ...links) {
  let left = first;
  for (const [holds, next] of links) {
    const right = next();
    if (!holds(left, right)) {
      return false;
    }
    left = right;
  }
  return true;
}
