"""The exact truths of arrays of rays and triangles."""

from enum import IntEnum
from typing import Any, Iterable

import numpy as np
import numpy.typing as npt

from . import _hairline


def _enum(name: str, field: str, about: str) -> Any:
    names = [word.upper() for word in _hairline.names()[field]]
    members = {word: number for number, word in enumerate(names)}
    kind = IntEnum(name, {**members, "NONE": 255}, module=__name__)
    kind.__doc__ = about
    return kind


Class = _enum("Class", "class", "How line and triangle lie: TRANSVERSAL is one point of the plane.")
Facing = _enum("Facing", "facing", "The side that the ray comes from; NONE where it does not cross the plane.")
Place = _enum("Place", "place", "Where t lies against [t_min, t_max]; NONE where the line does not cross the plane.")
Feature = _enum("Feature", "feature", "The part of the triangle that is met: of a contact in the plane also a SEGMENT.")

TRUTH = np.dtype([(name, "u1") for name in ("class", "facing", "place", "feature")] + [("t_sign", "i1"), ("hit", "?")])
NAMES = ("origin", "direction", "a", "b", "c", "t_min", "t_max")


def truth(
    origin: npt.ArrayLike,
    direction: npt.ArrayLike,
    a: npt.ArrayLike,
    b: npt.ArrayLike,
    c: npt.ArrayLike,
    t_min: npt.ArrayLike = 0.0,
    t_max: npt.ArrayLike = np.inf,
) -> npt.NDArray[np.void]:
    """The exact truth of n rays and n triangles: no rounding, for every finite float32 and float64.

    Vectors have the shape (n, 3), t_min and t_max (n,); a vector of shape (3,) or a number counts for all n. The numbers
    are taken as they are: float16, float32, float64, or integers that float64 holds. All in one unit of length.

    Returns a structured array of shape (n,):

    - `hit`: true if the ray on [t_min, t_max] meets the closed triangle (false of invalid input);
    - `class`, `facing`, `place`, `feature`: numbers of `Class`, `Facing`, `Place` and `Feature`;
    - `t_sign`: -1, 0 or 1, the sign of t where the line crosses the plane.

    It runs on all cores (RAYON_NUM_THREADS) without the interpreter's lock.

    >>> truth([1, 1, 1], [0, 0, -1], [0, 0, 0], [2, 0, 0], [0, 2, 0])["feature"] == Feature.EDGE_BC
    array([ True])
    """
    values = (origin, direction, a, b, c, t_min, t_max)
    arrays, count = _columns(zip(NAMES, values, (3, 3, 3, 3, 3, 1, 1)))
    # Wider numbers ask the same question. A lone vector is narrowed if it can be.
    with np.errstate(all="ignore"):
        narrow = [array.dtype == np.float32 or array.size < 4 and (array == np.float32(array)).all() for array in arrays]
    single = all(narrow) and any(array.dtype == np.float32 for array in arrays)
    columns = [np.ascontiguousarray(array, np.float32 if single else np.float64) for array in arrays]
    return _hairline.truth(columns, count, single).view(TRUTH)


def _columns(columns: "Iterable[tuple[str, npt.ArrayLike, int]]") -> "tuple[list[npt.NDArray[Any]], int]":
    """Arrays of numbers, and how many rows they have: of each argument its name, its value, and how many numbers are a row.

    A lone vector or number counts for all rows; other shapes and lengths are a ValueError."""
    arrays, count = [], None
    for name, value, width in columns:
        array = _numbers(name, value)
        rows = array.shape[:-1] if width == 3 else array.shape
        if len(rows) > 1 or (width == 3 and array.shape[-1:] != (3,)):
            expected = "(n, 3) or (3,)" if width == 3 else "(n,) or a number"
            raise ValueError(f"{name} has the shape {array.shape}, expected {expected}")
        if rows and count not in (None, rows[0]):
            raise ValueError(f"{name} has {rows[0]} rows, the arguments before it {count}")
        count = rows[0] if rows else count
        arrays.append(array)
    return arrays, 1 if count is None else count


def _numbers(name: str, value: npt.ArrayLike) -> npt.NDArray[Any]:
    array = np.asarray(value)
    if array.dtype in (np.float32, np.float64):
        return array
    with np.errstate(all="ignore"):
        wide = array.astype(np.float64) if array.dtype.kind in "iuf" else None
        exact = wide is not None and ((wide.astype(array.dtype) == array) | (wide != wide)).all()
    if not exact:
        raise ValueError(f"{name} is of {array.dtype}, expected float32, float64 or numbers that float64 holds")
    return wide
