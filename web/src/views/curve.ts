// What false hits and false misses do as an epsilon grows.
import { drawn } from "../dom";

export interface Point { epsilons: string; false_misses: [number, number]; false_hits: [number, number]; others: number }

/** The epsilons of a curve: 0, and powers of ten in steps of a half. */
export const POINTS = [0, ...Array.from({ length: 17 }, (_, i) => 10 ** (i - 16))];

const [WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM] = [560, 250, 52, 14, 12, 44];

/** The drawing, and in words what it shows. `at` is the epsilon now. */
export function curve(points: Point[], gate: string, at: number): SVGElement {
  const share = ([count, of]: [number, number]) => (of === 0 ? 0 : count / of);
  const most = Math.max(1e-3, ...points.flatMap((point) => [share(point.false_misses), share(point.false_hits)]));
  const top = [0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1].find((tick) => most <= tick) ?? 1;
  const x = (i: number) => LEFT + ((WIDTH - LEFT - RIGHT) * i) / (POINTS.length - 1);
  const y = (part: number) => HEIGHT - BOTTOM - (HEIGHT - BOTTOM - TOP) * (part / top);
  const percent = (part: number) => `${Number((100 * part).toPrecision(3))} %`;
  const line = (name: "false_misses" | "false_hits") => {
    const path = points.map((point, i) => `${i ? "L" : "M"}${x(i).toFixed(1)} ${y(share(point[name])).toFixed(1)}`).join("");
    const dots = points.map((point, i) => drawn("circle", { cx: x(i), cy: y(share(point[name])), r: 2.6, class: `dot ${name}` },
      drawn("title", {}, `${gate} = ${label(POINTS[i])}: ${percent(share(point[name]))}`)));
    return [drawn("path", { d: path, class: `line ${name}` }), ...dots];
  };
  const ticks = [0, 0.25, 0.5, 0.75, 1].map((part) => part * top).flatMap((part) => [
    drawn("line", { x1: LEFT, x2: WIDTH - RIGHT, y1: y(part), y2: y(part), class: "grid" }),
    drawn("text", { x: LEFT - 6, y: y(part) + 4, "text-anchor": "end" }, percent(part)),
  ]);
  const labels = POINTS.flatMap((value, i) => (i === 0 || i % 4 === 1 ? [
    drawn("text", { x: x(i), y: HEIGHT - BOTTOM + 16, "text-anchor": i === 0 ? "end" : "middle" }, label(value)),
  ] : []));
  const near = at <= 0 ? 0 : Math.min(POINTS.length - 1, Math.max(0.5, Math.log10(at) + 17));
  const words = `False misses grow from ${percent(share(points[0].false_misses))} to ${percent(share(points.at(-1)!.false_misses))}, `
    + `false hits go from ${percent(share(points[0].false_hits))} to ${percent(share(points.at(-1)!.false_hits))}.`;
  return drawn("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, class: "curve", role: "img", "aria-label": words },
    ...ticks, ...labels,
    drawn("line", { x1: x(near), x2: x(near), y1: TOP, y2: HEIGHT - BOTTOM, class: "now" }),
    ...line("false_hits"), ...line("false_misses"),
    drawn("text", { x: LEFT, y: HEIGHT - 8, class: "key false_misses" }, "● false misses"),
    drawn("text", { x: LEFT + 110, y: HEIGHT - 8, class: "key false_hits" }, "● false hits"),
    drawn("text", { x: LEFT + 210, y: HEIGHT - 8 }, `| ${gate} now`));
}

const label = (value: number) => (value === 0 ? "0" : `1e${Math.round(Math.log10(value))}`);
