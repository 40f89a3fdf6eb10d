// Small helpers for the page's elements.

/** The element of an id, which the page has. */
export function element<T extends Element = HTMLElement>(id: string): T {
  return document.getElementById(id) as unknown as T;
}

/** A new element with attributes and contents. */
export function made<K extends keyof HTMLElementTagNameMap>(
  name: K, attributes: Record<string, string> = {}, ...contents: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  node.append(...contents);
  return node;
}

/** A new element of SVG with attributes and contents. */
export function drawn(name: string, attributes: Record<string, string | number> = {}, ...contents: (Node | string)[]): SVGElement {
  const node = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, String(value));
  node.append(...contents);
  return node;
}

/** A function that is called once, some time after the last of many calls. */
export function afterwards(milliseconds: number, action: () => void) {
  let timer: ReturnType<typeof setTimeout>;
  return () => {
    clearTimeout(timer);
    timer = setTimeout(action, milliseconds);
  };
}

export const digits = (n: number) => n.toLocaleString("en");
