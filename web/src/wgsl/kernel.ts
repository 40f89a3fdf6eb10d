// A kernel in WGSL, evaluated in all ways that WGSL permits.
import { WgslParser } from "wgsl_reflect";
import * as n from "./permitted";
import type { Truth, Value } from "./permitted";

/** What evaluations may say of a case: each is a way through the kernel's branches. */
export interface Way { hit: Truth; t: Value; u: Value; v: Value }

/** What is not known here of WGSL. */
class Unknown extends Error {}
const unknown = (what: string): never => { throw new Unknown(`the kernel has ${what}, which this page does not evaluate`); };
/** More ways, or more steps, than are looked at. */
class Endless extends Error {}
const WAYS = 64;
const STEPS = 20_000;

interface Whole { whole: number }
/** A vector or an array. */
interface List { items: Item[] }
interface Struct { fields: Map<string, Item> }
type Item = Value | Truth | Whole | List | Struct;

const isFloat = (item: Item): item is Value => typeof item === "object" && item !== null && "lo" in item;
const isWhole = (item: Item): item is Whole => typeof item === "object" && item !== null && "whole" in item;
const isList = (item: Item): item is List => typeof item === "object" && item !== null && "items" in item;
const isTruth = (item: Item): item is Truth => item === null || typeof item === "boolean";
const float = (item: Item): Value => (isFloat(item) ? item : isWhole(item) ? n.literal(item.whole) : unknown("a number of another kind"));
const vector = (item: Item): Value[] => (isList(item) ? item.items.map(float) : unknown("a vector of another kind"));
const list = (...items: Item[]): List => ({ items });

// The parser's nodes, as far as they are looked at.
interface Node {
  astNodeType: string; name: string; operator: string; value: any; type: any; args: any[]; body: Node[]; returnType: any; postfix: Node | null;
  left: Node; right: Node; index: Node; condition: Node; elseif: Node[] | null; else: Node[] | null; init: Node | null; increment: Node | null;
  variable: Node; initializer: Node; continuing: { body: Node[] } | null; members: { name: string; type: any }[];
}

/** On each number of two items, which may be vectors. */
function each(a: Item, b: Item, of: (a: Item, b: Item) => Item): Item {
  if (!isList(a) && !isList(b)) return of(a, b);
  const count = isList(a) ? a.items.length : (b as List).items.length;
  const at = (item: Item, i: number) => (isList(item) ? item.items[i] : item);
  return list(...Array.from({ length: count }, (_, i) => each(at(a, i), at(b, i), of)));
}
const map = (item: Item, of: (x: Value) => Item): Item => each(item, item, (x) => of(float(x)));

const dot = (a: Item, b: Item) => vector(each(a, b, (x, y) => n.times(float(x), float(y)))).reduce(n.plus);
const length = (a: Item) => n.root(dot(a, a));
const minus = (a: Item, b: Item) => each(a, b, (x, y) => n.minus(float(x), float(y)));
const select = (no: Item, yes: Item, condition: Truth): Item =>
  each(no, yes, (a, b) => {
    if (condition !== null && isWhole(a) && isWhole(b)) return condition ? b : a;
    if (isTruth(a)) return condition === null ? (a === b ? a : null) : condition ? b : a;
    return condition === null ? n.hull(float(a), float(b)) : condition ? float(b) : float(a);
  });
const number = (truth: Truth) => select(n.given(0), n.given(1), truth) as Value;
const two = (of: (a: Value, b: Value) => Value) => (a: Item, b: Item) => each(a, b, (x, y) => of(float(x), float(y)));
const clamped = (x: Value, lo: Value, hi: Value) => (n.less(hi, lo) === false ? n.smaller(n.larger(x, lo), hi) : n.ANYTHING);

const BUILT_IN: Record<string, (...items: any[]) => Item> = {
  dot, length,
  abs: (a: Item) => map(a, n.size),
  all: ({ items }: List) => (items as Truth[]).reduce(n.both),
  any: ({ items }: List) => n.not((items as Truth[]).map(n.not).reduce(n.both)),
  ceil: (a: Item) => map(a, (x) => n.whole(x, Math.ceil)),
  cross: (a: Item, b: Item) => {
    const [p, q] = [vector(a), vector(b)];
    return list(...[[1, 2], [2, 0], [0, 1]].map(([i, j]) => n.minus(n.times(p[i], q[j]), n.times(p[j], q[i]))));
  },
  distance: (a: Item, b: Item) => length(minus(a, b)),
  floor: (a: Item) => map(a, (x) => n.whole(x, Math.floor)),
  inverseSqrt: (a: Item) => map(a, n.inverse_root),
  max: two(n.larger), min: two(n.smaller),
  normalize: (a: Item) => { const size = length(a); return map(a, (x) => n.over(x, size)); },
  saturate: (a: Item) => map(a, (x) => clamped(x, n.given(0), n.given(1))),
  select: (no: Item, yes: Item, condition: Item) => (isList(condition)
    ? list(...condition.items.map((one, i) => select((no as List).items[i], (yes as List).items[i], one as Truth))) : select(no, yes, condition as Truth)),
  sign: (a: Item) => map(a, (x) => n.whole(x, Math.sign)),
  sqrt: (a: Item) => map(a, n.root),
  step: two((edge, x) => number(n.not(n.less(x, edge)))),
  trunc: (a: Item) => map(a, (x) => n.whole(x, Math.trunc)),
  clamp: (x: Item, lo: Item, hi: Item) => zip(x, lo, hi, clamped),
  fma: (x: Item, y: Item, z: Item) => zip(x, y, z, (a, b, c) => n.plus(n.times(a, b), c)),
  mix: (x: Item, y: Item, z: Item) => zip(x, y, z, (a, b, c) => n.plus(n.times(a, n.minus(n.given(1), c)), n.times(b, c))),
};
function zip(x: Item, y: Item, z: Item, of: (a: Value, b: Value, c: Value) => Value): Item {
  const count = [x, y, z].map((item) => (isList(item) ? item.items.length : 0)).reduce((a, b) => Math.max(a, b));
  const at = (item: Item, i: number) => float(isList(item) ? item.items[i] : item);
  return count === 0 ? of(at(x, 0), at(y, 0), at(z, 0)) : list(...Array.from({ length: count }, (_, i) => of(at(x, i), at(y, i), at(z, i))));
}

const COMPARED: Record<string, (a: Value, b: Value) => Truth> = {
  "<": n.less, ">": (a, b) => n.less(b, a), "<=": (a, b) => n.not(n.less(b, a)), ">=": (a, b) => n.not(n.less(a, b)),
  "==": n.equal, "!=": (a, b) => n.not(n.equal(a, b)),
};
const COMPUTED: Record<string, (a: Value, b: Value) => Value> = { "+": n.plus, "-": n.minus, "*": n.times, "/": n.over };
const OF_WHOLES: Record<string, (a: number, b: number) => number | boolean> = {
  "+": (a, b) => a + b, "-": (a, b) => a - b, "*": (a, b) => a * b, "/": (a, b) => Math.trunc(a / b), "%": (a, b) => a % b,
  "<": (a, b) => a < b, ">": (a, b) => a > b, "<=": (a, b) => a <= b, ">=": (a, b) => a >= b, "==": (a, b) => a === b, "!=": (a, b) => a !== b,
};

function binary(operator: string, a: Item, b: Item): Item {
  return each(a, b, (x, y) => {
    if (isTruth(x) && isTruth(y)) {
      if (operator === "&") return n.both(x, y);
      if (operator === "|") return n.not(n.both(n.not(x), n.not(y)));
      const same = x === null || y === null ? null : x === y;
      return operator === "==" ? same : operator === "!=" ? n.not(same) : unknown(`${operator} of truths`);
    }
    if (isWhole(x) && isWhole(y)) {
      const result = (OF_WHOLES[operator] ?? unknown(`${operator} of whole numbers`))(x.whole, y.whole);
      return typeof result === "boolean" ? result : { whole: result };
    }
    const of = COMPARED[operator] ?? COMPUTED[operator] ?? unknown(`the operator ${operator}`);
    return of(float(x), float(y));
  });
}

type Leaving = "break" | "continue" | { returned: Item };

/** A kernel's text. An error where it has what is not known here. */
export class Kernel {
  #functions = new Map<string, Node>();
  #globals = new Map<string, Node>();
  #structs = new Map<string, { name: string; type: any }[]>();
  /** The values of literals that are no floats. */
  #between = new Map<number, number>();
  #scopes: Map<string, Item>[] = [];
  /** The branches taken where evaluations differ, and how many of them were asked for. */
  #way: boolean[] = [];
  #asked = 0;
  #steps = 0;

  /** `prelude` has the structures that the kernel's text uses. */
  constructor(prelude: string, text: string, readonly epsilons: string[]) {
    // The parser reads no hexadecimal floats.
    text = text.replace(/\b0x([\da-f]*)(?:\.([\da-f]*))?(?:p([+-]?\d+))?([fh]?)\b/gi, (word, ones: string, rest: string | undefined, power: string | undefined) => {
      if (rest === undefined && power === undefined) return word;
      return `${(parseInt(`0${ones}${rest ?? ""}`, 16) * 2 ** (Number(power ?? 0) - 4 * (rest ?? "").length)).toExponential()}f`;
    });
    for (const [word] of text.matchAll(/(?<![\w.])(\d+\.?\d*|\.\d+)(e[+-]?\d+)?/gi)) {
      const value = Number(word);
      if (Math.fround(value) !== value) this.#between.set(Math.fround(value), value);
    }
    for (const node of new WgslParser().parse(prelude + text) as unknown as Node[]) {
      if (node.astNodeType === "function") this.#functions.set(node.name, node);
      else if (node.astNodeType === "struct") this.#structs.set(node.name, node.members);
      else if (node.astNodeType === "const" || node.astNodeType === "let") this.#globals.set(node.name, node);
      else unknown(`a declaration of ${node.name ?? node.astNodeType}`);
    }
    if (!this.#functions.has("kernel")) unknown("no function named kernel");
  }

  /** The ways through it on a case of 17 numbers; undefined if there are too many. */
  ways(numbers: ArrayLike<number>, epsilons: ArrayLike<number>): Way[] | undefined {
    const v = (at: number) => list(...[0, 1, 2].map((i) => n.given(numbers[at + i])));
    const struct = (fields: Record<string, Item>): Struct => ({ fields: new Map(Object.entries(fields)) });
    const ray = struct({ origin: v(0), direction: v(3), t_min: n.given(numbers[15]), t_max: n.given(numbers[16]) });
    const triangle = struct({ a: v(6), b: v(9), c: v(12) });
    const epsilon = struct(Object.fromEntries(this.epsilons.map((name, i) => [name, n.given(Math.fround(epsilons[i]))])));
    const found: Way[] = [];
    this.#way = [];
    this.#steps = 0;
    try {
      for (;;) {
        this.#asked = 0;
        const { fields } = this.#call("kernel", [ray, triangle, epsilon]) as Struct;
        const [hit, t, u, v] = ["hit", "t", "u", "v"].map((name) => fields.get(name)!);
        found.push({ hit: hit as Truth, t: float(t), u: float(u), v: float(v) });
        // The next way: the last branch that was not taken.
        this.#way.length = this.#asked;
        while (this.#way.at(-1)) this.#way.pop();
        if (this.#way.length === 0) return found;
        this.#way[this.#way.length - 1] = true;
        if (found.length === WAYS) return undefined;
      }
    } catch (error) {
      if (error instanceof Endless) return undefined;
      throw error;
    }
  }

  #call(name: string, args: Item[]): Item {
    const called = this.#functions.get(name);
    if (!called) return (Object.hasOwn(BUILT_IN, name) ? BUILT_IN[name] : unknown(`the function ${name}`))(...args);
    const before = this.#scopes;
    this.#scopes = [new Map(called.args.map((argument, i) => [argument.name, this.#of_type(argument.type, args[i])]))];
    const left = this.#block(called.body);
    this.#scopes = before;
    return typeof left === "object" ? this.#of_type(called.returnType, left.returned) : unknown("a function without a result");
  }

  #block(body: Node[]): Leaving | undefined {
    this.#scopes.push(new Map());
    let left: Leaving | undefined;
    for (const node of body) {
      left = this.#statement(node);
      if (left) break;
    }
    this.#scopes.pop();
    return left;
  }

  /** Which branch is taken: both in turn where evaluations differ. */
  #decide(condition: Item): boolean {
    if (!isTruth(condition)) return unknown("a condition of another kind");
    if (condition !== null) return condition;
    if (this.#asked === this.#way.length) this.#way.push(false);
    return this.#way[this.#asked++];
  }

  #statement(node: Node): Leaving | undefined {
    if (++this.#steps > STEPS) throw new Endless();
    switch (node.astNodeType) {
      case "let": case "var": case "const":
        this.#scopes.at(-1)!.set(node.name, node.value ? this.#of_type(node.type, this.#value(node.value)) : this.#zero(node.type));
        return undefined;
      case "assign": {
        const operator = node.operator.slice(0, -1);
        const value = this.#value(node.value as Node);
        this.#assign(node.variable, operator ? binary(operator, this.#value(node.variable), value) : value);
        return undefined;
      }
      case "increment":
        this.#assign(node.variable, binary(node.operator[0], this.#value(node.variable), { whole: 1 }));
        return undefined;
      case "if": {
        if (this.#decide(this.#value(node.condition))) return this.#block(node.body);
        const other = node.elseif?.find(({ condition }) => this.#decide(this.#value(condition)));
        return other ? this.#block(other.body) : this.#block(node.else ?? []);
      }
      case "for": case "while": case "loop": {
        this.#scopes.push(new Map());
        if (node.init) this.#statement(node.init);
        let left: Leaving | undefined;
        while (!left && (!node.condition || this.#decide(this.#value(node.condition)))) {
          left = this.#block(node.body);
          if (left === "continue") left = undefined;
          if (!left && node.increment) this.#statement(node.increment);
          if (node.continuing) unknown("continuing");
          if (++this.#steps > STEPS) throw new Endless();
        }
        this.#scopes.pop();
        return left === "break" ? undefined : left;
      }
      case "return": return { returned: node.value ? this.#value(node.value) : unknown("a return without a value") };
      case "break": case "continue": return node.astNodeType;
      default: return unknown(`a statement ${node.astNodeType}`);
    }
  }

  #assign(target: Node, value: Item) {
    const scope = this.#scopes.findLast((scope) => scope.has(target.name)) ?? unknown(`no variable ${target.name}`);
    scope.set(target.name, this.#put(scope.get(target.name)!, target.postfix, value));
  }

  /** An item with a part of it replaced. */
  #put(item: Item, postfix: Node | null, value: Item): Item {
    if (!postfix) return isFloat(item) ? float(value) : value;
    const place = this.#place(item, postfix);
    if (isList(item)) {
      if (place.length !== 1) unknown("an assignment to several parts");
      return list(...item.items.map((one, i) => (i === place[0] ? this.#put(one, postfix.postfix, value) : one)));
    }
    const { fields } = item as Struct;
    return { fields: new Map([...fields, [postfix.value as string, this.#put(fields.get(postfix.value)!, postfix.postfix, value)]]) };
  }

  /** Which parts a word or an index names. */
  #place(item: Item, postfix: Node): number[] {
    if (postfix.index) {
      const index = this.#value(postfix.index);
      return isWhole(index) ? [index.whole] : unknown("an index of another kind");
    }
    return isList(item) ? [...(postfix.value as string)].map((letter) => "xyzwrgba".indexOf(letter) % 4) : [];
  }

  #value(node: Node): Item {
    let item = this.#plain(node);
    for (let { postfix } = node; postfix; { postfix } = postfix) {
      if (isList(item)) {
        const items: Item[] = this.#place(item, postfix).map((i) => (item as List).items[i]);
        item = items.length === 1 ? items[0] : list(...items);
      } else {
        item = (item as Struct)?.fields?.get(postfix.value) ?? unknown(`.${postfix.value}`);
      }
      if (item === undefined) unknown("an index out of range");
    }
    return item;
  }

  #plain(node: Node): Item {
    switch (node.astNodeType) {
      case "literalExpr": return this.#literal(node);
      case "constExpr": return this.#value(node.initializer);
      case "varExpr": {
        const scope = this.#scopes.findLast((scope) => scope.has(node.name));
        if (scope) return scope.get(node.name)!;
        return this.#value((this.#globals.get(node.name) ?? unknown(`no variable ${node.name}`)).value);
      }
      case "unaryOp": {
        const of = this.#value(node.right);
        if (node.operator === "!") return each(of, of, (x) => n.not(x as Truth));
        return node.operator === "-" ? each(of, of, (x) => (isWhole(x) ? { whole: -x.whole } : n.negative(float(x)))) : unknown(`the operator ${node.operator}`);
      }
      case "binaryOp": {
        const left = this.#value(node.left);
        if (node.operator === "&&") return left === false ? false : n.both(left as Truth, this.#value(node.right) as Truth);
        if (node.operator === "||") return left === true ? true : n.not(n.both(n.not(left as Truth), n.not(this.#value(node.right) as Truth)));
        return binary(node.operator, left, this.#value(node.right));
      }
      case "callExpr": return this.#call(node.name, node.args.map((one: Node) => this.#value(one)));
      case "createExpr": case "typecastExpr": return this.#created(node.type, node.args.map((one: Node) => this.#value(one)));
      default: return unknown(`an expression ${node.astNodeType}`);
    }
  }

  #literal({ type, value }: Node): Item {
    const x = value.data[0] as number;
    if (type.name === "bool") return x !== 0;
    if (["x32", "i32", "u32"].includes(type.name)) return { whole: x };
    if (type.name !== "f32") return unknown(`a number of ${type.name}`);
    const written = this.#between.get(Math.abs(x));
    return written === undefined ? n.given(x) : x < 0 ? n.negative(n.literal(written)) : n.literal(written);
  }

  #created(type: { name: string; format?: { name: string } }, args: Item[]): Item {
    const fields = this.#structs.get(type.name);
    if (fields) return { fields: new Map(fields.map(({ name, type }, i) => [name, this.#of_type(type, args[i])])) };
    const [, size, kind] = /^vec([234])(.?)$/.exec(type.name) ?? [];
    if (size) {
      const items = args.flatMap((one) => (isList(one) ? one.items : [one]));
      if (items.length === 0) return this.#zero(type);
      const all = items.length === 1 ? Array<Item>(Number(size)).fill(items[0]) : items;
      return kind === "i" || kind === "u" ? unknown("a vector of whole numbers") : list(...all.map((one) => (isWhole(one) ? float(one) : one)));
    }
    if (type.name === "array") return list(...args.map((one) => this.#of_type(type.format ?? null, one)));
    if (type.name === "f32" && args.length === 1) return isTruth(args[0]) ? number(args[0]) : float(args[0]);
    if (["i32", "u32"].includes(type.name) && isWhole(args[0])) return args[0];
    return unknown(`the type ${type.name}`);
  }

  /** A value of a declared type: whole numbers become floats. */
  #of_type(type: { name: string } | null, item: Item): Item {
    return type?.name === "f32" && isWhole(item) ? float(item) : item;
  }

  #zero(type: { name: string; format?: { name: string }; count?: number }): Item {
    const fields = this.#structs.get(type?.name);
    if (fields) return { fields: new Map(fields.map(({ name, type }) => [name, this.#zero(type)])) };
    if (type?.name === "bool") return false;
    if (["i32", "u32"].includes(type?.name)) return { whole: 0 };
    if (type?.name === "f32") return n.given(0);
    const [, size] = /^vec([234])f?$/.exec(type?.name ?? "") ?? [];
    if (size) return list(...Array<Item>(Number(size)).fill(n.given(0)));
    if (type?.name === "array" && type.format && type.count) return list(...Array.from({ length: type.count }, () => this.#zero(type.format!)));
    return unknown(`a variable of ${type?.name} without a value`);
  }
}
