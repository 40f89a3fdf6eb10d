// What the program wrote as HTML or SVG, made into nodes that do nothing by themselves.
//
// The program escapes what it writes, and no kernel shares the judge's realm. Should either ever fail, a report still must
// not act: DOMPurify, which is made for that and kept up with browsers' parsers, drops scripts, frames, handlers, refreshes
// and addresses that run.
import DOMPurify from "dompurify";

const ALLOWED = {
  USE_PROFILES: { html: true, svg: true },
  FORBID_TAGS: ["style", "audio", "video", "picture", "source"],
  // Ids stay, one of which is `reset`, the name of a property of forms: nothing here looks elements up as properties. A form
  // sends nothing, which the page's policy forbids.
  SANITIZE_DOM: false,
  RETURN_DOM_FRAGMENT: true,
};

export const markup = (text: string): DocumentFragment => DOMPurify.sanitize(text, ALLOWED) as unknown as DocumentFragment;
