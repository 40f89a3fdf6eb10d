// A mesh of the visitor's own: chosen or dropped, and its cracks drawn by the program's own script.
import { element } from "../dom";
import draw from "virtual:mesh-script";

/** Asks about each file that is chosen or dropped, and shows the answer. */
export function meshes(
  ask: (file: File) => Promise<{ title: string; html: string }>, fill: (parent: HTMLElement, html: string) => void,
) {
  const show = async (file: File | undefined) => {
    if (!file) return;
    const title = element("mesh-title");
    title.hidden = false;
    title.textContent = "Running…";
    element("mesh").replaceChildren();
    try {
      const answer = await ask(file);
      title.textContent = answer.title;
      fill(element("mesh"), answer.html);
      draw();
    } catch (error) {
      title.textContent = (error as Error).message;
    }
  };
  element("file").addEventListener("change", (event) => void show((event.target as HTMLInputElement).files?.[0]));
  element("drop").addEventListener("dragover", (event) => event.preventDefault());
  element("drop").addEventListener("drop", (event) => {
    event.preventDefault();
    void show(event.dataTransfer?.files[0]);
  });
}
