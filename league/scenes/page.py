"""docs/league-scenes.md, from the numbers that hairline wrote."""

from questions import KINDS

WRONG = ["lost", "farther face", "ghost", "self-hit", "wrong t"]
FINE = ["right", "tie", "neighbour"]
# In which kinds a triangle is met plainly, so that any program should get them right.
PLAIN = ["random", "vertex", "edge", "axis"]

HEAD = """# Whole scenes

When your renderer shoots a ray at a wall, does the library under it return the wall, or something behind it? Here libraries that find the
nearest triangle of a mesh are asked about rays where they err, and `hairline rays` compares each answer with the exact one
([how](guide/rays.md)).

The page is made by [`league/scenes/table`](../league/scenes/table) from the counts in [league-scenes.json](league-scenes.json), which
hairline {hairline} wrote. [The league](league.md) judges the triangle tests of libraries alone.

## Wrong answers per 10,000 rays

"""

LEGEND = """
Wrong is an answer that may be seen: a miss where the mesh is hit, a face behind the nearest one, a face elsewhere, the face where the ray starts, or a t that is off by
more than 1/1000 of the face's longest edge. {rays}
"""

READ = """
## How to read it

- All numbers of meshes and rays are floats of 32 bits, which a program in f64 gets exactly. So nothing is lost by reading them.
- Rays *at vertices* and *at the middles of edges* meet them exactly. Every face there is a right answer, so a program that misses all of
  them lets light through a closed wall.
- Rays *in the plane of a face* meet the edges of its neighbours too. Many libraries leave faces out that are seen edge-on; whether that is
  an error is for them to say. A wrong t there is what a renderer calls a spark.
- Rays *from face to face* begin on a face as nearly as floats can say it: on it, a hair in front of it, or a hair behind it. A program that
  answers with the face it starts from, though that lies behind the start, is wrong: a self-hit.
- The rates are of these rays. They compare libraries, and say nothing about how often your scene has such a ray.
- Faces with no area are in none of the meshes.

## The meshes

`python3 league/scenes/meshes.py FOLDER` makes them with integers and + - * / and square roots alone, so everybody gets the same bits.

| mesh | what it is |
|---|---|
| tetrahedron | 4 faces, closed |
| icosphere-1280, icosphere-81920 | spheres, closed |
| terrain-100352 | hills over a square of 224 by 224 cells, open |
| soup-100000 | faces anywhere, one in fifty twice |
| mobius | a strip of 1,960 faces, many of them thin: Open3D's `create_mobius(twists=2)`, as in its issue #5430 |

The rays are those of `hairline rays MESH --make {count} --kinds KIND --scalar f32 --seed 1`.
"""


# Fewer lost hits do not say who loses them.
FEWEST = 10


def grouped(number):
    return f"{number:,}"


class Sums:
    """Sums of the rows of a product, by kind and mesh, of one seed."""

    def __init__(self, rows):
        self.rows = rows

    def of(self, **chosen):
        return Sums([row for row in self.rows if all(row[key] == value for key, value in chosen.items())])

    def count(self, judgement):
        return sum(row["counts"][judgement] for row in self.rows)

    def wrong(self):
        return sum(map(self.count, WRONG))

    def rays(self):
        return sum(row["rays"] for row in self.rows)

    def rate(self):
        """Wrong answers per 10,000 rays."""
        wrong, rays = self.wrong(), self.rays()
        if wrong == 0 or rays == 0:
            return "0" if rays else "-"
        rate = 1e4 * wrong / rays
        return f"{rate:,.0f}" if rate >= 9.95 else f"{rate:.2g}"

    def most_off(self):
        return max((row["most_off"] for row in self.rows if row["most_off"] is not None), default=None)

    def blame(self):
        """The built-in kernel or slab test that explains most of the lost hits."""
        lost = sum(row["lost_hits"] for row in self.rows)
        if lost == 0:
            return ""
        by = {}
        for row in self.rows:
            for name, count in [*row["by_kernels"].items(), *row["by_box_tests"].items()]:
                by[name] = by.get(name, 0) + count
        if lost < FEWEST:
            return f"too few to say: {grouped(lost)} lost"
        name, most = max(by.items(), key=lambda it: (it[1], it[0]), default=("", 0))
        if most < lost / 2:
            return f"no built-in test: {grouped(lost)} lost"
        return f"{name}, {100 * most / lost:.0f} % of {grouped(lost)}"


def table(heads, rows):
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines) + "\n"


def written(record):
    sums = Sums(record["rows"])
    first, second = sums.of(seed=1), sums.of(seed=2)
    names = [product["name"] for product in record["products"]]
    by_name = {product["name"]: product for product in record["products"]}

    def plain_rate(name):
        of_plain = [first.of(product=name, kind=kind) for kind in PLAIN]
        return sum(it.wrong() for it in of_plain) / max(1, sum(it.rays() for it in of_plain))

    names.sort(key=plain_rate)
    meshes = list(dict.fromkeys(row["mesh"] for row in record["rows"]))
    text = HEAD.format(hairline=record["hairline"])
    text += table(
        ["library", "version", "scalar", *KINDS.values()],
        [
            [name, by_name[name]["version"], by_name[name]["scalar"], *(first.of(product=name, kind=kind).rate() for kind in KINDS)]
            for name in names
        ],
    )
    most = max(row["rays"] for row in record["rows"])
    text += LEGEND.format(rays=f"{grouped(most)} rays of each kind at each of {len(meshes)} meshes.")
    notes = [f"{name}: {by_name[name]['note']}" for name in names if by_name[name]["note"]]
    text += "\n" + "\n".join(f"- {note}." for note in notes) + "\n"
    if record["left_out"]:
        text += "\nNot installed when the page was made: " + "; ".join(record["left_out"]) + ".\n"
    text += seeds(first, second, names)
    for kind in PLAIN:
        text += f"\n## Rays {KINDS[kind]}, by mesh\n\n"
        rows = [[name, *(first.of(product=name, kind=kind, mesh=mesh).rate() for mesh in meshes)] for name in names]
        text += table(["library", *meshes], rows)
    text += READ.format(count=most)
    text += (
        "\n## What the wrong answers are\n\nAll meshes together. *Most off* is the farthest wrong answer with a t, in longest edges of "
        "the nearest face. *Who loses them*: the\nbuilt-in kernel or slab test that alone misses at least half of the hits that the library lost, "
        "and not those that it found:\nits own is likely the same.\n\n"
    )
    heads = ["library", "rays", "number", *(f"{it}" for it in FINE + WRONG), "most off", "who loses them"]
    rows = []
    for name in names:
        for kind in KINDS:
            its = first.of(product=name, kind=kind)
            off = its.most_off()
            counts = [grouped(its.count(judgement)) for judgement in FINE + WRONG]
            rows.append([name, kind, grouped(its.rays()), *counts, "" if off is None else f"{off:.2g}", its.blame()])
    return text + table(heads, rows)


def seeds(first, second, names):
    """Where the second seed says something else."""
    others = []
    for name in names:
        for kind in KINDS:
            one, two = first.of(product=name, kind=kind), second.of(product=name, kind=kind)
            if (one.wrong() == 0) != (two.wrong() == 0):
                others.append(f"{name} on rays {KINDS[kind]} ({one.wrong()} wrong of {grouped(one.rays())}, then {two.wrong()})")
            elif one.wrong():
                # Four deviations of a difference of two counts.
                if abs(one.wrong() - two.wrong()) > 4 * (one.wrong() + two.wrong()) ** 0.5:
                    others.append(f"{name} on rays {KINDS[kind]} ({grouped(one.wrong())} wrong, then {grouped(two.wrong())})")
    say = "\nThe same with other rays (seed 2): which libraries are wrong on which kinds, and the numbers within what chance allows"
    return say + (".\n" if not others else ", but for " + "; ".join(others) + ".\n")
