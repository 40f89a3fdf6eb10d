"""Audits of functions, and what comes out of them."""

import functools
import html
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import warnings
from typing import Any, Callable, Mapping, Sequence

import numpy as np

from . import _hairline
from ._kernel import Answers
from ._picture import Picture


class Audit:
    """The outcome of `audit`. In a notebook it shows the report's page."""

    def __init__(self, audited: _hairline.Audited) -> None:
        self._audited = audited

    def summary(self, details: bool = False) -> str:
        """The screen of `hairline audit`."""
        return _runnable(self._audited.text(details))

    @functools.cached_property
    def record(self) -> "dict[str, Any]":
        """The record of `hairline audit --format json`."""
        return json.loads(self._audited.json())

    @property
    def conforms(self) -> bool:
        """True if the kernel keeps its contract on every case, but for what is allowed."""
        return self._audited.conforms()

    @functools.cached_property
    def findings(self) -> "list[dict[str, Any]]":
        """One dict for each kind of finding in each class of a family: `scalar`, `family`, `class`, `finding`; how often, as
        `count` among `of`, `rate` and its 95 % interval `low`, `high`; `distance`, how far the worst one is from where the
        verdict would be right, in longest edges of the triangle; the worst `case`, and the `command` that shows it."""
        rows = []
        distances = iter(self._audited.distances())
        for result in self.record["result"]["results"]:
            for part in result["findings"]:
                rate, worst = part["rate"], part["worst"]
                low, high = rate["interval"] or (None, None)
                rows.append({
                    "scalar": result["scalar"], "family": result["family"], "class": part["class"],
                    "finding": part["finding"], "count": rate["count"], "of": rate["of"], "rate": rate["rate"],
                    "low": low, "high": high, "distance": next(distances),
                    "case": worst["case"], "command": _runnable(worst["command"]),
                })
        return rows

    @property
    def worst(self) -> "list[dict[str, Any]]":
        """The findings, the farthest off first."""
        return sorted(self.findings, key=lambda row: -(row["distance"] or 0))

    def to_pandas(self) -> Any:
        """The findings as a pandas.DataFrame."""
        try:
            import pandas
        except ImportError as error:
            raise ImportError("to_pandas needs pandas: pip install pandas; without it there is .findings") from error
        return pandas.DataFrame(self.findings)

    def explain(self, case: str) -> str:
        """A case of it, by its id: the exact truth, the kernel's answer, and by how much that is wrong."""
        return self._audited.explain(case)

    def map(self, case: str) -> "Picture":
        """The verdicts around a case of it, one pixel a float of the ray's origin, beside the exact ones."""
        return Picture(self._audited.map(case))

    def html(self) -> str:
        """The page of `hairline audit --format html`, without its maps."""
        return self._audited.html()

    def _repr_html_(self) -> str:
        return f'<iframe srcdoc="{html.escape(self.html())}" style="width:100%;height:36em;border:0"></iframe>'

    def __repr__(self) -> str:
        return f"<hairline.Audit: {self._audited.title()}>"


def audit(
    kernel: Callable[..., Any],
    *,
    scalar: Any = "float32",
    contract: str = "closed-ray",
    families: "Sequence[str] | None" = None,
    count: int = 2000,
    scene: "str | None" = None,
    seed: int = 1,
    band: "str | None" = None,
    allow: "Mapping[str, float] | None" = None,
    vectorized: bool = True,
) -> Audit:
    """Runs a ray-triangle test on cases that are hard for it, and compares each answer with the exact truth.

    `kernel(origin, direction, a, b, c, t_min, t_max)` gets n cases in arrays of `scalar`: vectors of shape (n, 3), t_min and
    t_max of shape (n,). It returns one of

    - t of shape (n,), in lengths of the direction, with nan for a miss;
    - a tuple (t, u, v) of such arrays: u is the weight of b, v that of c;
    - a bool array of hits;
    - a dict of `hit`, `t`, `u`, `v`, of which `hit` or `t` is there.

    With `vectorized=False` it gets one case: vectors of shape (3,) and two numbers; then None is a miss.

    - `contract`: what the kernel promises, as `hairline list contracts` names it, or in words (docs/protocol.md).
    - `families`: the names of `hairline list families`; all if not given. `count` cases of each, from `seed`.
    - `scene`: rays in a scene instead, as "room" or "extent=1000,edge=0.01..10,distance=0..2000" (one unit of length).
    - `band`: both answers are right nearer than this to the boundary: "4ulps", or "1e-6" of the longest edge.
    - `allow`: shares of findings that may occur in each family, as {"false-hit": 0.05}.

    An exception in the kernel ends the audit with a `KernelError` that has the case.
    """
    dtype = np.dtype({"f32": "float32", "f64": "float64"}.get(scalar, scalar))
    if dtype not in (np.float32, np.float64):
        raise ValueError(f"scalar={scalar!r}: expected 'float32' or 'float64'")
    if count < 1 or seed < 0:
        raise ValueError("count is 1 or more, seed 0 or more")
    short = "f32" if dtype == np.float32 else "f64"
    in_scene = ["--scene", scene] if scene else []
    of_families = ["--family", ",".join(families)] if families else []
    counted = ["-n", str(count), *([] if seed == 1 else ["--seed", str(seed)])]
    answers = Answers(kernel, vectorized, dtype)
    if answers.less and contract == "closed-ray":
        does = {"sides=front": "misses a plain triangle from the back", "extent=line": "hits what lies behind the ray's start"}
        meant = ",".join([contract, *answers.less])
        message = f"the kernel {' and '.join(does[word] for word in answers.less)}; if that is meant, contract={meant!r}"
        warnings.warn(message, stacklevel=2)
    name = "".join(c for c in getattr(kernel, "__name__", "kernel") if c.isalnum() and c.isascii() or c == "_")
    return Audit(_hairline.audit(answers, {
        "name": f"{name or 'kernel'}.py",
        "selector": _selector(kernel, contract, vectorized),
        "gives": answers.gives,
        "in_f32": short == "f32",
        "contract": contract,
        "families": None if families is None else list(families),
        "count": count,
        "scene": scene,
        "seed": seed,
        "band": band,
        "allow": dict(allow or {}),
        "sources": shlex.join(["--scalar", short, *in_scene, *of_families, *counted]),
        # It takes a scene whole.
        "epsilon": shlex.join(["--scalar", short, *(in_scene or of_families), *counted]),
    }))


def assert_conforms(kernel: Callable[..., Any], **options: Any) -> None:
    """Audits a kernel and raises an AssertionError unless it keeps its contract: for pytest.

    The options are those of `audit`. The message has each kind of finding, its first cases in decimal numbers, and the
    command that shows each.
    """
    __tracebackhide__ = True
    audited = audit(kernel, **options)
    if not audited.conforms:
        hint = "In Python a case is hairline.case(ID), which are the kernel's arguments, and audit(…).explain(ID) shows it"
        raise AssertionError(f"{_runnable(audited._audited.complaint())}{hint}")


def advise(
    scene: str = "room", kernel: str = "moller-trumbore", *, scalar: str = "f32", count: "int | None" = None
) -> "dict[str, Any]":
    """Which epsilons a built-in kernel needs in a scene: the part `result` of `hairline epsilon --format json`.

    A function in Python has no epsilons that could be varied from outside: audit it once for each value. `count` is the
    number of rays of each kind.
    """
    words = ["epsilon", "--kernel", kernel, "--scene", scene, "--scalar", scalar, "--quiet", "--format", "json"]
    words += [] if count is None else ["-n", str(count)]
    done = subprocess.run([sys.executable, "-m", "hairline", *words], capture_output=True, text=True, encoding="utf-8")
    if done.returncode != 0:
        raise ValueError(done.stderr.strip())
    return json.loads(done.stdout)["result"]


def _selector(kernel: Any, contract: str, vectorized: bool) -> str:
    """The flag with which the command line runs the kernel; none of one that cannot be imported."""
    module, name = getattr(kernel, "__module__", None), getattr(kernel, "__qualname__", "<")
    file = getattr(sys.modules.get(module or ""), "__file__", None)
    if file is None or hasattr(kernel, "__self__") or "<" in name:
        return ""
    place = module if "." in module else os.path.relpath(file)
    words = [_python("python3"), "-m", "hairline.pipe", f"{place}:{name}", contract, *([] if vectorized else ["--scalar-function"])]
    return f"--kernel-cmd {shlex.quote(shlex.join(words))}"


def _python(name: str) -> str:
    """This interpreter by a name that a shell finds it under, or else by its path."""
    found = shutil.which(name)
    return name if found and os.path.samefile(os.path.dirname(found), os.path.dirname(sys.executable)) else sys.executable


def _runnable(text: str) -> str:
    """Commands as a shell can run them, whether this environment is active or not."""
    program = _python("hairline")
    if program == "hairline":
        return text
    again = f"{shlex.quote(program)} -m hairline"
    return re.sub(r"(?m)^( *)hairline(?= [a-z]+ )", lambda found: found[1] + again, text)
