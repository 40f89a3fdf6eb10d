# %% [markdown]
# Is my numpy function right? Cells for Jupyter (with jupytext), VS Code or Spyder; `pip install` the wheel of
# `bash crates/python/build` first.
import hairline
import numpy as np


# %% A ray-triangle test as it is often written: n rays, n triangles, arrays of shape (n, 3).
def my_kernel(origin, direction, a, b, c, t_min, t_max):
    ab, ac, start = b - a, c - a, origin - a
    p = np.cross(direction, ac)
    det = np.einsum("ij,ij->i", ab, p)
    q = np.cross(start, ab)
    u = np.einsum("ij,ij->i", start, p) / det
    v = np.einsum("ij,ij->i", direction, q) / det
    t = np.einsum("ij,ij->i", ac, q) / det
    hit = (abs(det) > 1e-6) & (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0)
    return np.where(hit, t, np.nan), u, v


# %% Where is it wrong, in a room of 10 m with triangles from 1 cm? In a notebook the last line shows the report.
audited = hairline.audit(my_kernel, scene="room", count=2000)
print(audited.summary())
audited  # noqa: B018

# %% The worst case: exact t, u, v, and what the function said.
worst = audited.worst[0]
print(audited.explain(worst["case"]))

# %% How many rays does it lose as its epsilon grows? The exact answer needs no epsilon.
rng = np.random.default_rng(1)
a, b, c, origin = rng.normal(size=(4, 100_000, 3)).astype(np.float32)
a, b, c = a * np.float32(0.05), b * np.float32(0.05), c * np.float32(0.05)
direction = (a + b + c) / 3 - origin
right = hairline.truth(origin, direction, a, b, c)["hit"]
det = np.abs(np.einsum("ij,ij->i", b - a, np.cross(direction, c - a)))
lost = {epsilon: int((right & (det <= epsilon)).sum()) for epsilon in (1e-8, 1e-6, 1e-4, 1e-2)}
print(lost)
assert right.mean() > 0.99 and lost[1e-8] < lost[1e-2]
