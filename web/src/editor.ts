// The editor of a kernel's text.
import { javascript } from "@codemirror/lang-javascript";
import { syntaxHighlighting } from "@codemirror/language";
import { Prec } from "@codemirror/state";
import { keymap } from "@codemirror/view";
import { classHighlighter } from "@lezer/highlight";
import { basicSetup, EditorView } from "codemirror";

/** Puts an editor into an element. Colours are those of the page's style. */
export function editor(parent: HTMLElement, edited: () => void, run: () => void) {
  const view = new EditorView({
    parent,
    extensions: [
      Prec.highest(keymap.of([{ key: "Mod-Enter", run: () => (run(), true) }])),
      basicSetup,
      javascript(),
      syntaxHighlighting(classHighlighter),
      EditorView.contentAttributes.of({ "aria-label": "The kernel's text", tabindex: "0" }),
      EditorView.updateListener.of((update) => { if (update.docChanged) edited(); }),
    ],
  });
  return {
    get text() { return view.state.doc.toString(); },
    set text(text: string) {
      view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: text } });
    },
  };
}
