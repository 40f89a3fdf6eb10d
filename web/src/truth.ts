// The codes of truths (crates/web/src/truths.rs).

export type Feature = "interior" | "edge_ab" | "edge_bc" | "edge_ca" | "vertex_a" | "vertex_b" | "vertex_c" | "outside";
/** Where a line meets a triangle, exactly. */
export type Truth =
  | { class: "transversal"; facing: "front" | "back"; place: "before" | "at_min" | "within" | "at_max" | "beyond"; tSign: -1 | 0 | 1; feature: Feature }
  | { class: "coplanar" | "degenerate"; contact: "none" | "segment" | Feature; meetsRay: boolean; meetsLine: boolean }
  | { class: "parallel" | "invalid" };

const FEATURES: Feature[] = ["interior", "edge_ab", "edge_bc", "edge_ca", "vertex_a", "vertex_b", "vertex_c", "outside"];
const PLACES = ["before", "at_min", "within", "at_max", "beyond"] as const;

/** The truth of a code. */
export function truthOf(code: number): Truth {
  const bits = (from: number, count: number) => (code >> from) & ((1 << count) - 1);
  switch (bits(0, 3)) {
    case 0:
      return {
        class: "transversal",
        facing: bits(3, 1) ? "back" : "front",
        place: PLACES[bits(4, 3)],
        tSign: (bits(11, 2) - 1) as -1 | 0 | 1,
        feature: FEATURES[bits(7, 4)],
      };
    case 1: return { class: "parallel" };
    case 4: return { class: "invalid" };
    default: {
      const kind = bits(3, 2);
      return {
        class: bits(0, 3) === 2 ? "coplanar" : "degenerate",
        contact: kind === 0 ? "none" : kind === 2 ? "segment" : FEATURES[bits(5, 4)],
        meetsRay: bits(9, 1) === 1,
        meetsLine: bits(10, 1) === 1,
      };
    }
  }
}
