#!/usr/bin/env python3
"""The meshes of the table, as OBJ files: `python3 meshes.py FOLDER`.

They are made from integers and + - * / and square roots of doubles, which every machine rounds alike, so that everybody
gets the same files. All coordinates are multiples of 2^-18 below 4, which a 32-bit float holds exactly.
"""

import math
import pathlib
import sys

GRID = 2.0**18
MASK = 2**64 - 1


def on_grid(point):
    return tuple(math.floor(x * GRID + 0.5) / GRID for x in point)


class Draw:
    """A stream of numbers from a seed (splitmix64)."""

    def __init__(self, seed):
        self.state = seed

    def integer(self):
        self.state = (self.state + 0x9E3779B97F4A7C15) & MASK
        z = self.state
        z = ((z ^ (z >> 30)) * 0xBF58476D1CE4E5B9) & MASK
        z = ((z ^ (z >> 27)) * 0x94D049BB133111EB) & MASK
        return z ^ (z >> 31)

    def symmetric(self):
        """From -1 to 1."""
        return (self.integer() >> 11) / 2.0**52 - 1.0


def tetrahedron():
    vertices = [(-0.75, -0.5, -0.625), (0.875, -0.375, -0.5), (-0.125, 0.75, -0.375), (0.0625, 0.125, 0.875)]
    return vertices, [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]


def unit(point):
    x, y, z = point
    length = math.sqrt(x * x + y * y + z * z)
    return (x / length, y / length, z / length)


def icosphere(times):
    """An icosahedron whose faces are cut in four some times: 20 * 4^times faces, closed, seen from outside."""
    p = (1.0 + math.sqrt(5.0)) / 2.0
    vertices = []
    for y, z in [(1.0, p), (-1.0, p), (1.0, -p), (-1.0, -p)]:
        vertices += [unit((0.0, y, z)), unit((y, z, 0.0)), unit((z, 0.0, y))]

    def dot(a, b):
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]

    def cross(a, b):
        return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])

    faces = []
    for i in range(12):
        for j in range(i + 1, 12):
            for k in range(j + 1, 12):
                a, b, c = vertices[i], vertices[j], vertices[k]
                if min(dot(a, b), dot(b, c), dot(c, a)) > 0.4:  # neighbours: their product is 1/sqrt(5)
                    faces.append((i, j, k) if dot(a, cross(b, c)) > 0 else (i, k, j))
    for _ in range(times):
        middles, cut = {}, []

        def middle(i, j):
            key = (min(i, j), max(i, j))
            if key not in middles:
                middles[key] = len(vertices)
                p, q = vertices[key[0]], vertices[key[1]]
                vertices.append(unit((p[0] + q[0], p[1] + q[1], p[2] + q[2])))
            return middles[key]

        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            cut += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = cut
    return [on_grid(vertex) for vertex in vertices], faces


def terrain(n):
    """Hills over a square of n*n cells, two faces each: bumps of four sizes between heights on lattices."""
    draw = Draw(1)
    layers = []
    for cells in (4, 9, 28, n):
        heights = [[draw.symmetric() for _ in range(cells + 1)] for _ in range(cells + 1)]
        layers.append((cells, heights))

    def height(i, j):
        sum = 0.0
        for cells, heights in layers:
            x, y = i * cells / n, j * cells / n
            k, l = min(int(x), cells - 1), min(int(y), cells - 1)
            u, v = [t * t * (3.0 - 2.0 * t) for t in (x - k, y - l)]
            low = heights[k][l] + v * (heights[k][l + 1] - heights[k][l])
            high = heights[k + 1][l] + v * (heights[k + 1][l + 1] - heights[k + 1][l])
            sum += (low + u * (high - low)) / cells
        return sum

    rows = range(n + 1)
    vertices = [on_grid(((2 * i - n) / 256.0, (2 * j - n) / 256.0, height(i, j))) for i in rows for j in rows]
    faces = []
    for i in range(n):
        for j in range(n):
            q = i * (n + 1) + j
            faces += [(q, q + n + 1, q + n + 2), (q, q + n + 2, q + 1)]
    return vertices, faces


def soup(count):
    """Faces anywhere; one in fifty repeats another one."""
    draw = Draw(2)
    size = 4.5 / math.sqrt(math.sqrt(count) * 100.0)
    vertices, faces = [], []
    for face in range(count):
        centre = [draw.symmetric() for _ in range(3)]
        vertices += [on_grid([x + size * draw.symmetric() for x in centre]) for _ in range(3)]
        own = (3 * face, 3 * face + 1, 3 * face + 2)
        is_repeated = draw.integer() % 50 == 0 and faces
        faces.append(faces[draw.integer() % len(faces)] if is_repeated else own)
    return vertices, faces


MESHES = {
    "tetrahedron": tetrahedron,
    "icosphere-1280": lambda: icosphere(3),
    "icosphere-81920": lambda: icosphere(6),
    "terrain-100352": lambda: terrain(224),
    "soup-100000": lambda: soup(100_000),
}


def write(path, name, vertices, faces):
    lines = [f"# {name}, made by league/scenes/meshes.py"]
    lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in faces]
    path.write_text("\n".join(lines) + "\n")


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for name, make in MESHES.items():
        write(folder / f"{name}.obj", name, *make())


if __name__ == "__main__":
    main()
