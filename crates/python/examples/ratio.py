"""`hairline.truth` on a million rays as a ratio to the Rust batch, one core each, in turns: python ratio.py [RUNS]

In an environment that has the wheel, beside a Rust toolchain."""

import os
import pathlib
import subprocess
import sys
import tempfile
import time

os.environ["RAYON_NUM_THREADS"] = "1"
import numpy as np  # noqa: E402

import hairline  # noqa: E402

COUNT, RUNS = 10**6, int(sys.argv[1]) if len(sys.argv) > 1 else 40
here = pathlib.Path(__file__).parents[1]
rng = np.random.default_rng(1)
for scalar, dtype in (("f32", np.float32), ("f64", np.float64)):
    vectors = rng.normal(size=(5, COUNT, 3)).astype(dtype)
    with tempfile.NamedTemporaryFile(suffix=".rays") as file:
        vectors.tofile(file.name)
        words = ["cargo", "run", "--quiet", "--release", "--locked", "--example", "batch", scalar, file.name]
        batch = subprocess.Popen(words, cwd=here, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        times = []
        for _ in range(RUNS):
            start = time.perf_counter()
            hairline.truth(*vectors)
            mine = time.perf_counter() - start
            batch.stdin.write("\n")
            batch.stdin.flush()
            times.append((mine, float(batch.stdout.readline())))
        batch.stdin.close()
        batch.wait()
    python, rust = (1e3 * min(column) for column in zip(*times))
    print(f"{scalar}: {python:.1f} ms in Python, {rust:.1f} ms in Rust, {python / rust:.2f} times")
