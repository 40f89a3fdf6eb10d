// The map of verdicts around a case: two canvases of one pixel a float.
import { digits, element, made } from "../dom";

export const SIDE = 128;

export interface MapAnswer {
  computed: string;
  exact: string;
  legends: [string, string, number][][];
  axes: [string, string, string][];
  wrong: number;
}

/** Draws an answer; `inks` are the colours by number. */
export function draw(map: MapAnswer, inks: string[]) {
  const colours = inks.map((ink) => [1, 3, 5].map((at) => Number.parseInt(ink.slice(at, at + 2), 16)));
  for (const side of ["computed", "exact"] as const) {
    const canvas = element<HTMLCanvasElement>(side);
    const picture = new ImageData(SIDE, SIDE);
    for (let pixel = 0; pixel < SIDE * SIDE; pixel++) {
      const [r, g, b] = colours[map[side].charCodeAt(pixel) - 48];
      picture.data.set([r, g, b, 255], 4 * pixel);
    }
    canvas.getContext("2d")!.putImageData(picture, 0, 0);
  }
  map.legends.forEach((legend, side) => {
    element(`${["computed", "exact"][side]}-legend`).replaceChildren(...legend.map(([ink, words, count]) => {
      const swatch = made("i", { class: "swatch" });
      swatch.style.background = ink;
      return made("span", {}, swatch, ` ${words}: ${digits(count)} `);
    }));
  });
  const [right, up] = map.axes.map(([name, centre, step]) => `${name} in steps of ${step} about ${centre}`);
  element("axes").textContent = `${digits(map.wrong)} of ${digits(SIDE * SIDE)} wrong. To the right: ${right}. Upwards: ${up}.`;
}

export interface Controls {
  move(x: number, y: number): void;
  zoom(factor: number): void;
  pick(x: number, y: number): void;
}

/** Lets pointer and keys move, zoom and pick; steps are pixels, to the right and upwards. */
export function control({ move, zoom, pick }: Controls) {
  for (const id of ["computed", "exact"]) {
    const canvas = element<HTMLCanvasElement>(id);
    let from: [number, number] | undefined;
    const place = (event: PointerEvent): [number, number] => {
      const box = canvas.getBoundingClientRect();
      const within = (value: number) => Math.max(0, Math.min(SIDE - 1, Math.floor(value * SIDE)));
      return [within((event.clientX - box.left) / box.width), within((box.bottom - event.clientY) / box.height)];
    };
    canvas.addEventListener("pointerdown", (event) => { from = place(event); canvas.setPointerCapture(event.pointerId); });
    canvas.addEventListener("pointerup", (event) => {
      if (!from) return;
      const [x, y] = place(event);
      const by = [from[0] - x, from[1] - y];
      from = undefined;
      if (Math.abs(by[0]) + Math.abs(by[1]) < 2) pick(x, y);
      else move(by[0], by[1]);
    });
    canvas.addEventListener("wheel", (event) => {
      if (!event.ctrlKey) return;
      event.preventDefault();
      zoom(event.deltaY < 0 ? 0.5 : 2);
    }, { passive: false });
  }
  element("computed").addEventListener("keydown", (event) => {
    const keys: Record<string, () => void> = {
      ArrowLeft: () => move(-16, 0), ArrowRight: () => move(16, 0), ArrowUp: () => move(0, 16), ArrowDown: () => move(0, -16),
      "+": () => zoom(0.5), "-": () => zoom(2), Enter: () => pick(SIDE / 2, SIDE / 2),
    };
    const action = keys[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
  element("zoom-in").addEventListener("click", () => zoom(0.5));
  element("zoom-out").addEventListener("click", () => zoom(2));
}
