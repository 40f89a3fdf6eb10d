// Sorting and filtering of the heat table. Everything is there without it.
"use strict";
(() => {
  const table = document.getElementById("heat-table");
  const form = document.getElementById("filters");
  if (!table || !form) return;
  const body = table.tBodies[0];
  const rows = [...body.rows];
  const count = document.getElementById("filter-count");
  const [kernel, scalar, finding] = ["kernel", "scalar", "finding"].map((name) =>
    document.getElementById("filter-" + name));
  let order = "";

  const tell = () => {
    const shown = rows.filter((row) => !row.hidden).length;
    count.textContent = `${shown} of ${rows.length} rows${order}`;
  };

  const filter = () => {
    const wanted = kernel.value.trim().toLowerCase();
    for (const row of rows) {
      const { kernel: name, scalar: of, finding: what } = row.dataset;
      row.hidden = !name.toLowerCase().includes(wanted)
        || (scalar.value !== "" && of !== scalar.value)
        || (finding.value !== "" && what !== finding.value);
    }
    tell();
  };

  const value = (row, column) => {
    const text = row.cells[column].dataset.v;
    return text === undefined ? -1 : Number(text);
  };

  const heads = [...table.tHead.rows[0].cells].filter((head) => "sort" in head.dataset);
  const unsorted = () => {
    for (const head of heads) head.removeAttribute("aria-sort");
    body.append(...rows);
    order = "";
  };
  for (const head of heads) {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...head.childNodes);
    head.append(button);
    const name = button.textContent;
    button.addEventListener("click", () => {
      const before = head.getAttribute("aria-sort");
      unsorted();
      if (before !== "ascending") {
        const down = before === null;
        const column = head.cellIndex;
        const sorted = [...rows].sort((a, b) => {
          const [x, y] = [value(a, column), value(b, column)];
          // What has no share stands last either way.
          if (x < 0 || y < 0) return y - x;
          return down ? y - x : x - y;
        });
        body.append(...sorted);
        head.setAttribute("aria-sort", down ? "descending" : "ascending");
        order = `, by ${name}, ${down ? "largest" : "smallest"} first`;
      }
      tell();
    });
  }

  form.hidden = false;
  form.addEventListener("input", filter);
  form.addEventListener("submit", (event) => event.preventDefault());
  form.addEventListener("reset", () => setTimeout(() => {
    unsorted();
    filter();
  }));
  tell();

  // A link into a closed part opens it.
  const open = () => {
    const target = location.hash && document.getElementById(location.hash.slice(1));
    if (target && target.tagName === "DETAILS") target.open = true;
  };
  addEventListener("hashchange", open);
  open();
  // On paper the kernels stand open.
  const closed = [];
  addEventListener("beforeprint", () => {
    for (const part of document.querySelectorAll("details.kernel:not([open])")) {
      part.open = true;
      closed.push(part);
    }
  });
  addEventListener("afterprint", () => {
    for (const part of closed.splice(0)) part.open = false;
  });
})();
