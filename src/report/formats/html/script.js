// Sorting of the tables, and filtering of the heat table. Everything is there without it.
(() => {
  const questions = document.getElementById("questions-table");
  if (questions) sortable(questions);
  const table = document.getElementById("heat-table");
  const form = document.getElementById("filters");
  if (!table || !form) return;
  const rows = [...table.tBodies[0].rows];
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

  const unsort = sortable(table, (said) => {
    order = said;
    tell();
  });

  form.hidden = false;
  form.addEventListener("input", filter);
  form.addEventListener("submit", (event) => event.preventDefault());
  form.addEventListener("reset", () => setTimeout(() => {
    unsort();
    filter();
  }));
  tell();

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
