// A kernel in WGSL that ends: no page can stop a shader that is running, and a browser does so late or never. WGSL has no
// recursion, so a shader that does not end is in a loop. Each loop's body begins with a count of steps, and breaks when
// they are used up.

/** The steps of all loops together on one case; tests of a triangle take a handful. */
export const STEPS = 1 << 14;
/** A variable of each case's own. */
export const DECLARED = `var<private> hairline_steps: u32 = ${STEPS}u;`;
const COUNTED = " if (hairline_steps == 0u) { break; } hairline_steps -= 1u; ";

// What ends a line in WGSL, and so a comment.
const LINE_END = /[\n\v\f\r\u0085\u2028\u2029]/;

/** The text with counted loops, on the same lines. */
export function bounded(text: string): string {
  let out = "";
  let isLoop = false;
  for (let at = 0; at < text.length;) {
    const end = afterComment(text, at) ?? afterWord(text, at) ?? at + 1;
    const piece = text.slice(at, end);
    if (piece.startsWith("hairline_")) throw new Error(`line ${text.slice(0, at).split("\n").length}: names that begin with hairline_ are the lab's`);
    // These are no names of anything else in WGSL.
    if (piece === "for" || piece === "while" || piece === "loop") isLoop = true;
    out += piece;
    if (piece === "{" && isLoop) {
      out += COUNTED;
      isLoop = false;
    }
    at = end;
  }
  return out;
}

/** Where a comment ends that begins here; nothing if none does. Block comments may be in one another. */
function afterComment(text: string, at: number): number | undefined {
  if (text.startsWith("//", at)) {
    const line = text.slice(at).search(LINE_END);
    return line < 0 ? text.length : at + line;
  }
  if (!text.startsWith("/*", at)) return undefined;
  let depth = 0;
  for (let i = at; i < text.length;) {
    const [opens, closes] = [text.startsWith("/*", i), text.startsWith("*/", i)];
    depth += Number(opens) - Number(closes);
    i += opens || closes ? 2 : 1;
    if (depth === 0) return i;
  }
  return text.length;
}

const WORD = /[\p{XID_Start}_]\p{XID_Continue}*/uy;

function afterWord(text: string, at: number): number | undefined {
  WORD.lastIndex = at;
  return WORD.test(text) ? WORD.lastIndex : undefined;
}
