// A triangle with its ray in space, to be turned.
import { drawn } from "../dom";

type Point = [number, number, number];
const SIZE = 300;

const minus = (p: Point, q: Point): Point => [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
const along = (p: Point, d: Point, t: number): Point => [p[0] + t * d[0], p[1] + t * d[1], p[2] + t * d[2]];
const length = (p: Point) => Math.hypot(...p);

/** The number of a fraction of whole numbers of any size. */
function quotient(text: string | null): number | null {
  if (text === null) return null;
  const [above, below = "1"] = text.split("/").map((part) => part.trim());
  const [p, q] = [BigInt(above), BigInt(below)];
  // 60 digits in binary are enough, whatever the sizes.
  const shift = BigInt(Math.max(0, 60 + q.toString(2).length - p.toString(2).length));
  return Number((p << shift) / q) / 2 ** Number(shift);
}

/** Puts the drawing of 17 numbers into an element; nothing if they are not all finite. The fraction is the t at which the
 * line meets the plane, if it does. */
export function space(parent: HTMLElement, numbers: (number | null)[], fraction: string | null) {
  parent.replaceChildren();
  const t = quotient(fraction);
  if (numbers.slice(0, 15).includes(null)) return;
  const at = (i: number) => numbers.slice(3 * i, 3 * i + 3) as Point;
  const corners = [at(2), at(3), at(4)];
  const edge = Math.max(...corners.map((p, i) => length(minus(p, corners[(i + 1) % 3]))));
  const speed = length(at(1));
  if (!(edge > 0 && Number.isFinite(edge) && speed > 0 && Number.isFinite(speed))) return;
  const centre = [0, 1, 2].map((i) => corners.reduce((sum, p) => sum + p[i] / 3, 0)) as Point;
  const small = (p: Point) => minus(p, centre).map((x) => x / edge) as Point;
  const direction = at(1).map((x) => x / speed) as Point;
  const origin = small(at(0));
  // Where it meets the plane, or the point nearest to the middle; the ray is drawn for some edges about it.
  const meets = t === null ? undefined : (t * speed) / edge;
  const middle = meets !== undefined && Number.isFinite(meets) ? meets : -(origin[0] * direction[0] + origin[1] * direction[1] + origin[2] * direction[2]);
  const start = Math.max(Math.min(0, middle), middle - 1.2);
  const ends = [along(origin, direction, start), along(origin, direction, middle + 1)];
  const isCut = start > 0;
  const reach = Math.max(...[...corners.map(small), ...ends].map(length));
  const crossing = meets === undefined ? undefined : along(origin, direction, middle);
  let [yaw, pitch] = [0.6, 0.5];
  const scale = (0.43 * SIZE) / reach;
  const svg = drawn("svg", { viewBox: `${-SIZE / 2} ${-SIZE / 2} ${SIZE} ${SIZE}`, class: "space", tabindex: 0, role: "img",
    "aria-label": "The triangle and its ray in space; arrows turn it" });
  const flat = ([x, y, z]: Point): [number, number] => {
    const [c, s, k, n] = [Math.cos(yaw), Math.sin(yaw), Math.cos(pitch), Math.sin(pitch)];
    const [across, deep] = [c * x + s * z, c * z - s * x];
    return [scale * across, -scale * (k * y - n * deep)];
  };
  const draw = () => {
    const text = (p: Point, word: string) => {
      const [x, y] = flat(p.map((value) => value * 1.15) as Point);
      return drawn("text", { x, y: y + 4, "text-anchor": "middle" }, word);
    };
    const [from, to] = ends.map(flat);
    const shape = corners.map((p) => flat(small(p)).map((value) => value.toFixed(2)).join(",")).join(" ");
    const dot = (p: Point, name: string) => {
      const [cx, cy] = flat(p);
      return drawn("circle", { cx, cy, r: 4, class: name });
    };
    svg.replaceChildren(
      drawn("polygon", { points: shape, class: "face" }),
      drawn("line", { x1: from[0], y1: from[1], x2: to[0], y2: to[1], class: "ray" }),
      ...(isCut ? [] : [dot(origin, "origin")]),
      ...(crossing ? [dot(crossing, "crossing")] : []),
      ...corners.map((p, i) => text(small(p), "abc"[i])),
    );
  };
  const turn = (x: number, y: number) => {
    yaw += x;
    pitch = Math.max(-1.5, Math.min(1.5, pitch + y));
    draw();
  };
  svg.addEventListener("pointerdown", (event) => (event.target as Element).closest("svg")!.setPointerCapture((event as PointerEvent).pointerId));
  svg.addEventListener("pointermove", (event) => {
    const { buttons, movementX, movementY } = event as PointerEvent;
    if (buttons & 1) turn(movementX / 120, movementY / 120);
  });
  svg.addEventListener("keydown", (event) => {
    const turns: Record<string, [number, number]> = { ArrowLeft: [-0.15, 0], ArrowRight: [0.15, 0], ArrowUp: [0, -0.15], ArrowDown: [0, 0.15] };
    const by = turns[(event as KeyboardEvent).key];
    if (by) {
      event.preventDefault();
      turn(...by);
    }
  });
  draw();
  parent.append(svg);
}
