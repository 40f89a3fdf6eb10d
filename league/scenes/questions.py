"""Meshes and rays that all products are asked about, as files in a folder."""

import pathlib
import struct
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
HAIRLINE = ROOT / "target/release/hairline"

# The kinds of `hairline rays --make`, and how the page calls them.
KINDS = {
    "random": "anywhere",
    "vertex": "at vertices",
    "edge": "at the middles of edges",
    "axis": "along an axis",
    "plane": "in the plane of a face",
    "surface": "from face to face",
}


def meshes(folder):
    """The paths of the meshes, by name; made where they are not there."""
    sys.path.insert(0, str(HERE))
    import meshes as made

    paths = {name: folder / "meshes" / f"{name}.obj" for name in made.MESHES}
    if not all(path.exists() for path in paths.values()):
        subprocess.run([sys.executable, HERE / "meshes.py", folder / "meshes"], check=True)
    return {**paths, "mobius": HERE / "mobius.obj"}


def rays(folder, name, mesh, kind, seed, count):
    """The path of a file of rays, made where it is not there."""
    path = folder / "rays" / f"{name}-{kind}-{seed}-{count}.csv"
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        words = ["rays", mesh, "--make", count, "--kinds", kind, "--seed", seed, "--scalar", "f32", "--quiet"]
        made = run(HAIRLINE, *words, "--format", "csv").splitlines()
        path.write_text("\n".join([made[0], *map(in_full, made[1:])]) + "\n")
    return path


def in_full(line):
    """The floats of a line with all their digits, so that what reads doubles reads the same numbers."""
    return ",".join(repr(struct.unpack("f", struct.pack("f", float(word)))[0]) for word in line.split(","))


def run(*words):
    """What a command prints. An error if it fails; hairline's 1, for wrong answers, is none."""
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if done.returncode not in (0, 1) or (done.returncode == 1 and words[0] != HAIRLINE):
        raise RuntimeError(f"{' '.join(map(str, words))}: {done.stderr.strip()}")
    return done.stdout
