"""A user's function as something that answers with hit, t, u, v: what it returns, checked."""

from typing import Any, Callable

import numpy as np

from . import _hairline

NAMES = ("origin", "direction", "a", "b", "c", "t_min", "t_max")
MANY = "t of shape (n,) with nan for a miss, a tuple (t, u, v) of such arrays, a bool array, or a dict of 'hit', 't', 'u', 'v'"
ONE = "None for a miss, t, a tuple (t, u, v), a bool, or a dict of 'hit', 't', 'u', 'v'"


def case(id: str) -> "dict[str, Any]":
    """The arguments of a case by its id, for a kernel or for `truth`: `my_kernel(**hairline.case("edge-near@2/f32/-/1/7"))`.

    Vectors have the shape (n, 3), t_min and t_max (n,), with n = 1 but for cases of several triangles.
    """
    return dict(zip(NAMES, _hairline.case(id)))


class KernelError(Exception):
    """The kernel raised an exception, which is the cause of this one.

    `case` has the arguments of one ray on which it does, by name; it is None if no single ray is enough.
    """

    def __init__(self, error: Exception, case: "dict[str, Any] | None") -> None:
        where = "on several rays together, on none alone"
        if case is not None:
            where = "on " + ", ".join(f"{name}={np.asarray(value).tolist()}" for name, value in case.items())
        super().__init__(f"the kernel raised {type(error).__name__}: {error}; {where}")
        self.case = case


class Answers:
    """Calls the kernel on arrays of n cases and returns the arrays hit, t, u, v."""

    def __init__(self, kernel: Callable[..., Any], vectorized: bool, dtype: Any) -> None:
        self.kernel, self.vectorized, self.dtype = kernel, vectorized, np.dtype(dtype)
        # What does it return? Rays through the middle of a triangle, from both sides, and such that leave it behind.
        named = self._plain(1)
        self.gives = ("t" in named, "u" in named and "v" in named)
        front, back, *behind = named["hit"]
        beside = self._plain(40)
        if beside["hit"].all():
            told = f" with t = {beside['t'][0]}" if "t" in beside else ""
            miss = "t = nan" if vectorized else "None"
            raise ValueError(f"the kernel reports hits{told} for rays that pass far beside a triangle: if that stands for a miss, return {miss} instead")
        # What it promises less than a closed ray, in the words of a contract.
        self.less = (["sides=front"] if front and not back else []) + (["extent=line"] if any(behind) else [])

    def _plain(self, aside: float) -> "dict[str, Any]":
        """What it says of four rays along z, so far aside in x and y, at a triangle with legs of 4."""
        corners = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0]], self.dtype)
        from_z, along = (np.array(z, self.dtype)[:, None] * [[0, 0, 1]] for z in ([1, -1, 1, -1], [-1, 1, 1, -1]))
        rays = [(from_z + [[aside, aside, 0]]).astype(self.dtype), along.astype(self.dtype)]
        ends = np.zeros(4, self.dtype), np.full(4, np.inf, self.dtype)
        return self._named((*rays, *(np.array([corner] * 4) for corner in corners), *ends))

    def __call__(self, *arrays: Any) -> "tuple[Any, Any, Any, Any]":
        named = self._named(arrays)
        nothing = np.full(len(arrays[5]), np.nan, self.dtype)
        for name, given in (("t", self.gives[0]), ("u", self.gives[1]), ("v", self.gives[1])):
            if given and name not in named and named["hit"].any():
                raise ValueError(f"the kernel returned {name} before, and now does not")
        return (named["hit"], *(named.get(name, nothing) for name in "tuv"))

    def _named(self, arrays: Any) -> "dict[str, Any]":
        count = len(arrays[5])
        with np.errstate(all="ignore"):
            try:
                answer = self.kernel(*arrays) if self.vectorized else [self.kernel(*case) for case in zip(*arrays)]
            except Exception as error:
                raise KernelError(error, self._failing(arrays)) from error
        if self.vectorized:
            return self._columns(_fields(answer, MANY), count)
        rows = [_fields(one, ONE) for one in answer]
        keys = {key for row in rows for key in row} - {"hit"}
        columns = self._columns({"hit": [True] * count, **{key: [row.get(key, np.nan) for row in rows] for key in keys}}, count)
        t = columns.get("t", np.zeros(count))
        columns["hit"] = np.array([bool(row.get("hit", row and not np.isnan(t[i]))) for i, row in enumerate(rows)])
        return columns

    def _failing(self, arrays: Any) -> "dict[str, Any] | None":
        for i in range(len(arrays[5])):
            rows = [array[i : i + 1] if self.vectorized else array[i] for array in arrays]
            try:
                self.kernel(*rows)
            except Exception:
                return dict(zip(NAMES, (array[i] for array in arrays)))
        return None

    def _columns(self, fields: "dict[str, Any]", count: int) -> "dict[str, Any]":
        columns = {name: self._column(name, value, count) for name, value in fields.items()}
        if "hit" not in columns:
            columns["hit"] = ~np.isnan(columns["t"])
        return columns

    def _column(self, name: str, value: Any, count: int) -> Any:
        array = np.ma.filled(value, np.nan) if isinstance(value, np.ma.MaskedArray) else np.asarray(value)
        expected = MANY if self.vectorized else ONE
        if array.shape != (count,):
            raise ValueError(f"the kernel returned {name} of shape {array.shape} for n = {count} rays; expected {expected}")
        if array.dtype.kind not in {"hit": "b", "t": "f" if self.vectorized else "fiu"}.get(name, "fiu"):
            raise ValueError(f"the kernel returned {name} of {array.dtype}; expected {expected}")
        return np.ascontiguousarray(array, bool if name == "hit" else self.dtype)


def _fields(answer: Any, expected: str) -> "dict[str, Any]":
    """The parts of an answer by name; none of a miss."""
    if isinstance(answer, dict):
        if set(answer) - set("tuv") - {"hit"} or not {"hit", "t"} & set(answer):
            raise ValueError(f"the kernel returned a dict of {sorted(answer)}; expected {expected}")
        return answer
    if isinstance(answer, tuple):
        if len(answer) != 3:
            raise ValueError(f"the kernel returned a tuple of {len(answer)}; expected {expected}")
        return dict(zip("tuv", answer))
    if answer is None and expected is ONE:
        return {}
    if answer is None:
        raise ValueError(f"the kernel returned None; expected {expected}")
    if np.asarray(answer).dtype.kind in "iu":
        # As t they could say no miss, and 0 and 1 are more likely flags.
        flags = "bool(hit)" if expected is ONE else "hits.astype(bool)"
        raise ValueError(f"the kernel returned integers; for flags make them bool, as `{flags}`; expected {expected}")
    return {"hit" if np.asarray(answer).dtype == np.bool_ else "t": answer}
