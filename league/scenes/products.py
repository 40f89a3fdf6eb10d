"""The products of the table: who answers, in which version, and by which command."""

import dataclasses
import json
import os
import pathlib

from questions import HERE, ROOT, run

EXAMPLES = ROOT / "examples/scenes"
PYTHON = pathlib.Path(os.environ.get("LEAGUE_PYTHON", ROOT / "league/python/venv/bin/python"))
CRATES = HERE / "target/release/hairline-league-scenes"
BUILT = HERE / "built"


@dataclasses.dataclass
class Product:
    name: str
    scalar: str
    # What a reader of the table should know of how it is asked.
    note: str
    # Its version, and the command to which a mesh and rays are added.
    version: str = ""
    command: list = dataclasses.field(default_factory=list)
    # Answers so many rays of a kind at most, because it is slow.
    at_most: int = 0


def in_python(name, package, scalar, script, *words, note="", at_most=0):
    version = run(PYTHON, "-c", f"from importlib.metadata import version; print(version('{package}'))").strip()
    # Imports may fail where a library of the system is missing.
    run(PYTHON, "-c", f"import {'igl' if package == 'libigl' else package}")
    script = EXAMPLES / f"{script}_answers.py"
    # The words stand behind the mesh and the rays.
    command = ["sh", "-c", 'exec "$0" "$1" "$3" "$4" $2', PYTHON, script, " ".join(words)]
    return Product(name, scalar, note, version, command, at_most)


def three_mesh_bvh():
    folder = EXAMPLES / "node_modules/three-mesh-bvh"
    version = json.loads((folder / "package.json").read_text())["version"]
    return Product("three-mesh-bvh", "f64", "vertices are stored in f32", version, ["node", EXAMPLES / "three_mesh_bvh_answers.mjs"])


def of_crates(name, note=""):
    listed = [line.split("\t") for line in run(CRATES, "list").splitlines()]
    version, scalar = next(words[1:] for words in listed if words[0] == name)
    return Product(name, scalar, note, version, [CRATES, "answers", name])


def of_header(name, note=""):
    words = next(line.split() for line in (HERE / "headers.txt").read_text().splitlines() if line.startswith(f"{name} "))
    if not (BUILT / name).exists():
        raise FileNotFoundError(f"{BUILT / name} is not built")
    return Product(name, "f32", note, words[4], [BUILT / name])


def cgal():
    version = run(BUILT / "cgal", "version").strip()
    return Product("CGAL", "f64", "AABB_tree, exact predicates", version, [BUILT / "cgal", "epick", "answers"])


UNIT = "rays get unit directions, as it requires"
SLOW = "asked 500 rays of a kind at a mesh, because it is slow"

PRODUCTS = {
    "Embree, robust": lambda: in_python("Embree, robust", "embreex", "f32", "embreex", note="embreex, which has Embree 4.4.0"),
    "Embree, fast": lambda: in_python("Embree, fast", "embreex", "f32", "embreex", "fast", note="the same without its robust flag"),
    "Open3D": lambda: in_python("Open3D", "open3d", "f32", "open3d", note="RaycastingScene, an Embree inside"),
    "trimesh": lambda: in_python("trimesh", "trimesh", "f64", "trimesh", note=f"without Embree; {SLOW}", at_most=500),
    "libigl": lambda: in_python("libigl", "libigl", "f64", "libigl", note="AABB.intersect_ray_first"),
    "three-mesh-bvh": three_mesh_bvh,
    "parry3d": lambda: of_crates("parry3d"),
    "parry3d-f64": lambda: of_crates("parry3d-f64"),
    "bvh": lambda: of_crates("bvh", f"{UNIT}; every face stands twice in it, because it culls"),
    "bvh-f64": lambda: of_crates("bvh-f64", "the same in f64"),
    "obvhs": lambda: of_crates("obvhs", "Bvh2"),
    "obvhs-cwbvh": lambda: of_crates("obvhs-cwbvh", "CwBvh"),
    "tinybvh": lambda: of_header("tinybvh", f"BVH; {UNIT}"),
    "nanort": lambda: of_header("nanort"),
    "CGAL": cgal,
}


def installed():
    """The products that answer here, and a line for each that does not."""
    there, missing = [], []
    for name, make in PRODUCTS.items():
        try:
            there.append(make())
        except (OSError, RuntimeError) as error:
            missing.append(f"{name}: {str(error).splitlines()[-1]}")
    return there, missing
