// The mesh, turned by pointer, touch and keys. Without this tables hold the first places.
(() => {
  const canvas = document.getElementById("view");
  const brush = canvas && canvas.getContext("2d");
  if (!brush) return;
  const get = (id) => document.getElementById(id);
  const numbers = (text) => (text ? text.split(" ").map(Number) : []);
  const [points, vertices, triangles] = ["points", "vertices", "triangles"].map((name) => numbers(canvas.dataset[name]));
  const { directions, faces, file } = canvas.dataset;
  const rows = [...document.querySelectorAll("details.row")];
  const WORDS = ["crack", "double", "wrong at a fold"];
  const count = vertices.length;
  const corner = (p) => [points[3 * p], points[3 * p + 1], points[3 * p + 2]];
  const minus = (u, v) => u.map((x, i) => x - v[i]);
  const middle = ({ a, b }) => corner(a).map((x, i) => (x + corner(b)[i]) / 2);
  const face = (i) => triangles.slice(3 * i, 3 * i + 3);
  // A triangle's normal, of length 1 or 0.
  const normals = [];
  let radius = 1, edges = 0;
  for (let p = 0; p < count; p++) radius = Math.max(radius, Math.hypot(...corner(p)));
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = face(i / 3).map(corner);
    const [u, v] = [minus(b, a), minus(c, a)];
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const length = Math.hypot(...n) || 1;
    normals.push(n.map((x) => x / length));
    edges += Math.hypot(...u);
  }
  // Marks are drawn over the triangles around them, and behind others.
  const lift = triangles.length ? 2.4 * edges / triangles.length : 0;
  const START = { yaw: -0.6, pitch: 0.45, zoom: 1, centre: [0, 0, 0] };
  let eye = { ...START }, marks = [], chosen = -1, waiting = false;
  const [x, y, z] = [0, 0, 0].map(() => new Float32Array(count));

  const shown = ({ wrong }) => get("kind-" + wrong)?.checked ?? true;
  const turn = (v) => {
    const [sy, cy, sp, cp] = [Math.sin(eye.yaw), Math.cos(eye.yaw), Math.sin(eye.pitch), Math.cos(eye.pitch)];
    const forth = -v[0] * sy + v[2] * cy;
    return [v[0] * cy + v[2] * sy, v[1] * cp - forth * sp, v[1] * sp + forth * cp];
  };
  const path = (...ends) => {
    brush.beginPath();
    ends.forEach((p) => brush.lineTo(x[p], y[p]));
  };
  const draw_mark = ({ a, b, wrong }, colour) => {
    brush.strokeStyle = brush.fillStyle = colour;
    if (a !== b) {
      brush.lineWidth = 2.6;
      brush.setLineDash([[], [7, 4], [2, 4]][wrong]);
      path(a, b);
      brush.stroke();
      brush.setLineDash([]);
      return;
    }
    brush.beginPath();
    if (wrong === 0) brush.arc(x[a], y[a], 4, 0, 7);
    else if (wrong === 1) brush.rect(x[a] - 4, y[a] - 4, 8, 8);
    else [[0, -5], [5, 4], [-5, 4]].forEach(([dx, dy]) => brush.lineTo(x[a] + dx, y[a] + dy));
    brush.fill();
  };
  const draw = () => {
    waiting = false;
    const style = getComputedStyle(canvas);
    const colour = (name) => style.getPropertyValue("--" + name).trim();
    const [lit, dim] = [numbers(colour("lit")), numbers(colour("dim"))];
    const [wire, ink, ...marked] = ["wire", "ink", "crack", "double", "fold"].map(colour);
    const through = get("through").checked;
    const sharp = devicePixelRatio || 1;
    const size = [canvas.clientWidth, canvas.clientHeight];
    [canvas.width, canvas.height] = size.map((side) => Math.round(side * sharp));
    brush.scale(sharp, sharp);
    brush.lineJoin = brush.lineCap = "round";
    const scale = 0.47 * Math.min(...size) * eye.zoom / radius;
    const place = (point) => {
      const at = turn(minus(point, eye.centre));
      return [size[0] / 2 + at[0] * scale, size[1] / 2 - at[1] * scale, at[2]];
    };
    for (let p = 0; p < count; p++) [x[p], y[p], z[p]] = place(corner(p));
    const faces = normals.length;
    const depth = new Float32Array(faces + marks.length);
    for (let i = 0; i < faces; i++) depth[i] = face(i).reduce((sum, p) => sum + z[p], 0) / 3;
    marks.forEach(({ a, b }, i) => { depth[faces + i] = through ? 1e9 : (z[a] + z[b]) / 2 + lift; });
    for (const item of Uint32Array.from(depth.keys()).sort((i, j) => depth[i] - depth[j])) {
      if (item >= faces) {
        if (shown(marks[item - faces])) draw_mark(marks[item - faces], marked[marks[item - faces].wrong]);
        continue;
      }
      path(...face(item));
      brush.closePath();
      if (!through) {
        const light = Math.abs(turn(normals[item])[2]);
        brush.fillStyle = `rgb(${lit.map((part, i) => Math.round(part * light + dim[i] * (1 - light))).join(" ")})`;
        brush.fill();
      }
      brush.strokeStyle = wire;
      brush.lineWidth = through ? 0.4 : 0.6;
      brush.stroke();
    }
    if (marks[chosen]) {
      const [px, py] = place(middle(marks[chosen]));
      brush.strokeStyle = ink;
      brush.lineWidth = 2;
      brush.beginPath();
      brush.arc(px, py, 13, 0, 7);
      brush.stroke();
    }
  };
  const redraw = () => {
    if (!waiting) requestAnimationFrame(draw);
    waiting = true;
  };

  const choose = (number, near) => {
    chosen = number;
    const mark = marks[number];
    const { dataset } = rows[get("row").value];
    if (mark) {
      const [part, before, name] = mark.a === mark.b
        ? ["vertex", dataset.vertices, `${vertices[mark.a]}`]
        : ["edge", dataset.edges, `${vertices[mark.a]}–${vertices[mark.b]}`];
      get("what").textContent = `${WORDS[mark.wrong]} at ${part} ${name} of ${file}, ${faces} ${mark.lines}: `
        + `${mark.rays} of ${directions} rays aimed at this ${part}. The first:`;
      get("command").textContent = before + mark.index + dataset.after;
    } else {
      get("what").textContent = marks.length ? "Click a mark, or step from place to place." : "No place of this row is marked.";
      get("command").textContent = "";
    }
    if (mark && near) {
      const n = [0, 0, 0];
      normals.forEach((normal, i) => {
        if (face(i).includes(mark.a)) normal.forEach((part, k) => { n[k] += part; });
      });
      // Of a large mesh only what is around the place is there to be seen.
      if (!("whole" in canvas.dataset)) eye.zoom = Math.max(eye.zoom, radius / (8 * lift));
      eye = { ...eye, centre: middle(mark), yaw: Math.atan2(-n[0], n[2]), pitch: Math.atan2(n[1], Math.hypot(n[0], n[2])) };
    }
    redraw();
  };
  const step = (by) => {
    let next = chosen;
    for (let tried = 0; tried < marks.length; tried++) {
      next = next < 0 && by < 0 ? marks.length - 1 : (next + by + marks.length) % marks.length;
      if (shown(marks[next])) return choose(next, true);
    }
  };
  const take = () => {
    const row = rows[get("row").value];
    marks = row.dataset.marks.split(";").filter(Boolean).map((text) => {
      const [wrong, a, b, rays, index, lines] = text.split(" ");
      return { wrong: Number(wrong), a: Number(a), b: Number(b), rays, index, lines: lines.replaceAll(",", ", ") };
    });
    get("sum").textContent = row.querySelector(".sum").textContent;
    choose(-1);
  };
  // The nearest mark under a pointer, of several the one in front.
  const pick = (px, py) => {
    let [best, most] = [-1, 13];
    marks.forEach((mark, i) => {
      const { a, b } = mark;
      const [dx, dy] = [x[b] - x[a], y[b] - y[a]];
      const s = Math.max(0, Math.min(1, ((px - x[a]) * dx + (py - y[a]) * dy) / (dx * dx + dy * dy || 1)));
      const off = Math.max(0, Math.hypot(px - x[a] - s * dx, py - y[a] - s * dy) - 4) - 6 * (z[a] + z[b]) / (2 * radius);
      if (off < most && shown(mark)) [best, most] = [i, off];
    });
    return best;
  };
  const look = (change) => {
    eye = { ...eye, ...change };
    redraw();
  };
  const zoom = (by) => look({ zoom: Math.max(0.2, Math.min(5000, eye.zoom * by)) });
  const rotate = (right, down) => look({ yaw: eye.yaw + right, pitch: Math.max(-1.57, Math.min(1.57, eye.pitch + down)) });
  const reset = () => look(START);

  const down = new Map();
  let moved = 0;
  const spread = () => {
    const [p, q] = [...down.values()];
    return Math.hypot(p[0] - q[0], p[1] - q[1]) || 1;
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    down.set(event.pointerId, [event.offsetX, event.offsetY]);
    moved = down.size > 1 ? 99 : 0;
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = down.get(event.pointerId);
    if (!before) return;
    const wide = down.size === 2 ? spread() : 0;
    down.set(event.pointerId, [event.offsetX, event.offsetY]);
    const [dx, dy] = [event.offsetX - before[0], event.offsetY - before[1]];
    moved += Math.abs(dx) + Math.abs(dy);
    if (wide) zoom(spread() / wide);
    else if (down.size === 1) rotate(dx / 120, dy / 120);
  });
  canvas.addEventListener("pointerup", (event) => {
    if (down.delete(event.pointerId) && moved < 5) choose(pick(event.offsetX, event.offsetY));
  });
  canvas.addEventListener("pointercancel", (event) => down.delete(event.pointerId));
  // Who scrolls past it scrolls the page; who clicked into it zooms.
  canvas.addEventListener("wheel", (event) => {
    if (document.activeElement !== canvas) return;
    event.preventDefault();
    zoom(Math.exp(-event.deltaY / 500));
  }, { passive: false });
  const KEYS = {
    ArrowLeft: () => rotate(-0.1, 0), ArrowRight: () => rotate(0.1, 0), ArrowUp: () => rotate(0, -0.1), ArrowDown: () => rotate(0, 0.1),
    "+": () => zoom(1.25), "=": () => zoom(1.25), "-": () => zoom(0.8), 0: reset, n: () => step(1), p: () => step(-1),
  };
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !(event.key in KEYS)) return;
    event.preventDefault();
    KEYS[event.key]();
  });
  for (const [id, act] of Object.entries({ in: KEYS["+"], out: KEYS["-"], reset, next: KEYS.n, previous: KEYS.p })) {
    get(id).addEventListener("click", act);
  }
  get("row").addEventListener("input", take);
  get("stage-controls").addEventListener("submit", (event) => event.preventDefault());
  get("stage-controls").addEventListener("change", redraw);
  rows.forEach((row, i) => row.querySelectorAll("tbody tr").forEach((line, number) => {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...line.cells[0].childNodes);
    line.cells[0].append(button);
    button.addEventListener("click", () => {
      get("row").value = i;
      take();
      choose(number, true);
      canvas.focus();
    });
  }));
  for (const id of ["stage", "stage-controls", "place"]) get(id).hidden = false;
  addEventListener("resize", redraw);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  take();
})();
