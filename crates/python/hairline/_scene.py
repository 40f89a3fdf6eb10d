"""Rays and points at a whole mesh, exactly."""

from enum import IntEnum
from typing import Any, List, NamedTuple, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _hairline
from ._truth import _columns, _numbers

Judgement = IntEnum("Judgement", {name.upper(): code for code, name in enumerate(_hairline.judgements())}, module=__name__)
Judgement.__doc__ = """The judgement of a nearest hit that a program answered: RIGHT; TIE, one of several nearest faces; NEIGHBOUR, a face
that the ray misses by a hair, with nothing in front of it; WRONG_T, off by over 1/1000 of the face's longest edge; LOST, a miss where the
mesh is hit; FARTHER, a face behind the nearest one; GHOST, a face elsewhere that the ray does not meet."""


class Where(IntEnum):
    """The place of a point at a closed surface."""

    OUTSIDE = 0
    INSIDE = 1
    ON = 2
    NOT_DEFINED = 3


NEAREST = np.dtype([("face", "i8"), ("t", "f8"), ("ties", "u4")])


class Meeting(NamedTuple):
    """A point, or a segment in the surface, that a ray shares with it."""

    t: Tuple[float, float]
    faces: List[int]
    is_segment: bool
    #: True if the ray comes out on the other side; None where the surface is open.
    crosses: Optional[bool]
    #: The winding numbers before and behind; None where they are not defined.
    winding: Optional[Tuple[int, int]]


class Scene:
    """A mesh, against which rays and points are decided exactly: no rounding, for every finite float32 and float64.

    `vertices` has the shape (m, 3), `faces` (k, 3) with the places of vertices. A mesh of float32 stays float32: rays and points
    are then taken as float32 too, and must be numbers that it holds.

    >>> scene = Scene([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> scene.nearest([0.25, 0.25, 1], [0, 0, -1])["t"]
    array([1.])
    """

    def __init__(self, vertices: npt.ArrayLike, faces: npt.ArrayLike) -> None:
        points = _numbers("vertices", vertices)
        self.dtype = np.dtype(np.float32 if points.dtype == np.float32 else np.float64)
        places = np.asarray(faces)
        for name, array in (("vertices", points), ("faces", places)):
            if array.ndim != 2 or array.shape[1] != 3:
                raise ValueError(f"{name} has the shape {array.shape}, expected (n, 3)")
        if places.dtype.kind not in "iu" or (places < 0).any() or (places >= 2**32).any():
            raise ValueError(f"faces is of {places.dtype}, expected places of vertices from 0")
        self._scene = _hairline.ExactScene(
            np.ascontiguousarray(points, self.dtype), np.ascontiguousarray(places, np.uint32), self.dtype == np.float32
        )

    def nearest(
        self, origin: npt.ArrayLike, direction: npt.ArrayLike, t_min: npt.ArrayLike = 0.0, t_max: npt.ArrayLike = np.inf
    ) -> npt.NDArray[np.void]:
        """The nearest hits of n rays: a structured array with `face` (the first of the nearest ones, -1 for a miss), `t` (the
        nearest double, NaN for a miss) and `ties`, how many faces the ray meets at that t; each of them is a right answer."""
        face, t, ties = self._scene.nearest(self._rays(origin, direction, t_min, t_max))
        found = np.empty(len(face), NEAREST)
        found["face"], found["t"], found["ties"] = face, t, ties
        return found

    def judge(
        self,
        origin: npt.ArrayLike,
        direction: npt.ArrayLike,
        face: npt.ArrayLike,
        t: Optional[npt.ArrayLike] = None,
        t_min: npt.ArrayLike = 0.0,
        t_max: npt.ArrayLike = np.inf,
    ) -> Tuple[npt.NDArray[np.uint8], npt.NDArray[np.float64]]:
        """Judges what a program answered: `face` of each ray (below 0 for a miss) and, if it gives one, its `t`. Returns codes of
        `Judgement`, and how far each answered point lies behind the exact one, in longest edges of the nearest face (NaN where
        that is not known)."""
        rays = self._rays(origin, direction, t_min, t_max)
        count = len(rays[0])
        faces = np.ascontiguousarray(face, np.int64)
        # What programs with unsigned numbers write for a miss.
        faces = np.where(faces == 2**32 - 1, -1, faces)
        times = np.full(count, np.nan) if t is None else np.ascontiguousarray(t, np.float64)
        for name, array in (("face", faces), ("t", times)):
            if array.shape != (count,):
                raise ValueError(f"{name} has the shape {array.shape}, expected ({count},)")
        return self._scene.judge(rays, faces, times, t is not None)

    def locate(self, points: npt.ArrayLike) -> Tuple[npt.NDArray[np.int8], npt.NDArray[np.int64]]:
        """The places of n points, as codes of `Where`, and their winding numbers."""
        return self._scene.locate(self._columns([("points", points, 3)])[0])

    def inside(self, points: npt.ArrayLike) -> npt.NDArray[np.bool_]:
        """True for each point that is inside, false outside and on the surface. A ValueError if the surface is open: then there is
        no inside."""
        places, _ = self.locate(points)
        if (places == Where.NOT_DEFINED).any():
            raise ValueError(f"the surface is open, at an edge of face {self._scene.open_at()} among others: it has no inside")
        return places == Where.INSIDE

    def meetings(
        self, origin: npt.ArrayLike, direction: npt.ArrayLike, t_min: float = 0.0, t_max: float = np.inf
    ) -> List[Meeting]:
        """Everything that one ray meets, in order."""
        rays = self._rays(origin, direction, t_min, t_max)
        if len(rays[0]) != 1:
            raise ValueError(f"expected one ray, found {len(rays[0])}")
        found = self._scene.meetings(rays)
        return [Meeting((first, last), faces, *rest) for first, last, faces, *rest in found]

    def _rays(self, origin: Any, direction: Any, t_min: Any, t_max: Any) -> "list[npt.NDArray[Any]]":
        return self._columns([("origin", origin, 3), ("direction", direction, 3), ("t_min", t_min, 1), ("t_max", t_max, 1)])

    def _columns(self, columns: "list[tuple[str, Any, int]]") -> "list[npt.NDArray[Any]]":
        """Contiguous arrays of one length, in the mesh's scalar."""
        arrays, count = _columns(columns)
        filled = []
        for (name, _, width), array in zip(columns, arrays):
            with np.errstate(all="ignore"):
                narrow = array.astype(self.dtype)
            if not ((narrow == array) | (array != array)).all():
                raise ValueError(f"{name} has numbers that {self.dtype} does not hold; give vertices as float64, or round them yourself")
            shape = (count, 3) if width == 3 else (count,)
            filled.append(np.ascontiguousarray(np.broadcast_to(narrow, shape)))
        return filled
