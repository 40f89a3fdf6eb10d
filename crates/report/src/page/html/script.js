// Of every page.
"use strict";
// Makes a table's columns sortable by a button in each head that has data-sort. `changed` is told the order in words.
// Returns what puts the rows back into their own order.
const sortable = (table, changed = () => {}) => {
  const body = table.tBodies[0];
  const rows = [...body.rows];
  const heads = [...table.tHead.rows[0].cells].filter((head) => "sort" in head.dataset);
  const value = (row, column) => {
    const text = row.cells[column].dataset.v;
    return text === undefined ? null : Number(text);
  };
  const unsort = () => {
    for (const head of heads) head.removeAttribute("aria-sort");
    body.append(...rows);
    changed("");
  };
  for (const head of heads) {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...head.childNodes);
    head.append(button);
    const name = button.textContent;
    button.addEventListener("click", () => {
      const before = head.getAttribute("aria-sort");
      unsort();
      if (before === "ascending") return;
      const down = before === null;
      const column = head.cellIndex;
      body.append(...[...rows].sort((a, b) => {
        const [x, y] = [value(a, column), value(b, column)];
        // What has no share stands last either way.
        if (x === null || y === null) return (x === null) - (y === null);
        return down ? y - x : x - y;
      }));
      head.setAttribute("aria-sort", down ? "descending" : "ascending");
      changed(`, by ${name}, ${down ? "largest" : "smallest"} first`);
    });
  }
  return unsort;
};
// A link into a closed part opens it.
const open_target = () => {
  const target = location.hash && document.getElementById(location.hash.slice(1));
  if (target && target.tagName === "DETAILS") target.open = true;
};
addEventListener("hashchange", open_target);
open_target();
for (const table of document.querySelectorAll("table.heat")) sortable(table);
