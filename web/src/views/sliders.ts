// A slider and a number for each epsilon.
import { afterwards, element, made } from "../dom";

/** An epsilon's name, the comparison it stands in, its own value, and whether it may be changed. */
export type Gate = [string, string, string, boolean];

/** The slider's places: 0, and powers of ten in steps of a half. */
const PLACES = [0, ...Array.from({ length: 37 }, (_, i) => 10 ** (i / 2 - 18))];

/** A slider for each epsilon of a kernel. */
export function drawSliders(
  kernel: string, all: Gate[], valueOf: (gate: string, own: string) => string, set: (gate: string, own: string, value: string) => void,
) {
  const parent = element("sliders");
  element("epsilons").hidden = all.length === 0;
  const key = JSON.stringify([kernel, all]);
  if (parent.dataset.key === key) return;
  parent.dataset.key = key;
  parent.replaceChildren(...all.map(([gate, refuses, own]) => {
    const value = valueOf(gate, own);
    const range = made("input", { type: "range", min: "0", max: String(PLACES.length - 1), step: "1", id: `e-${gate}`, autocomplete: "off" });
    const text = made("input", { type: "text", size: "9", value, "aria-label": `${gate}, as a number`, autocomplete: "off", spellcheck: "false" });
    const put = (words: string) => {
      const number = Number(words);
      range.value = String(number <= 0 ? 0 : PLACES.reduce((best, place, i) => (Math.abs(Math.log(place / number)) < Math.abs(Math.log(PLACES[best] / number)) ? i : best), 1));
      range.setAttribute("aria-valuetext", words);
    };
    const change = afterwards(250, () => set(gate, own, text.value.trim()));
    put(value);
    range.addEventListener("input", () => {
      text.value = PLACES[Number(range.value)] === 0 ? "0" : PLACES[Number(range.value)].toExponential(0).replace("e+", "e");
      range.setAttribute("aria-valuetext", text.value);
      change();
    });
    text.addEventListener("change", () => { put(text.value); change(); });
    const what = refuses ? made("span", { class: "what" }, `refuses where ${refuses}`) : "";
    return made("div", { class: "slider" }, made("label", { for: `e-${gate}` }, gate, what), range, text);
  }));
}
