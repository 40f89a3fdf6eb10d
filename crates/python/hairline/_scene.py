"""Rays and points at a whole mesh, exactly."""

import operator
from enum import IntEnum
from typing import Any, List, NamedTuple, Optional, Tuple

import numpy as np
import numpy.typing as npt

from . import _hairline
from ._picture import Picture
from ._truth import _columns, _numbers

Judgement = IntEnum("Judgement", {name.upper(): code for code, name in enumerate(_hairline.judgements())}, module=__name__)
Judgement.__doc__ = """The judgement of an answer.

Not wrong: RIGHT; TIE, one of several right answers; NEIGHBOUR, off by a hair, which nobody sees; NOT_DEFINED, a point at an open surface.

Wrong: WRONG_T, off by over 1/1000 of the face's longest edge; LOST, a miss where the mesh is hit; FARTHER, a face behind the nearest one;
GHOST, a face elsewhere that the ray does not meet, or a hit where nothing is; SELF_HIT, the face that the ray starts at and misses by a
hair; TOO_FEW and TOO_MANY hits; TWICE, one hit named twice;
WRONG_ORDER, a hit named before one that is nearer; WRONG_SIDE of the surface."""


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
        """Judges the nearest hits that a program answered: `face` of each ray (below 0 for a miss) and, if it gives one, its `t`, both
        of shape (n,). Returns codes of `Judgement`, and how far each answered point lies behind the exact one, in longest edges of the
        nearest face (NaN where that is not known)."""
        rays = self._rays(origin, direction, t_min, t_max)
        count = len(rays[0])
        faces = _whole("face", face, count)
        # What programs with unsigned numbers write for a miss.
        faces = np.where(faces == 2**32 - 1, -1, faces)
        times = np.full(count, np.nan) if t is None else _shaped("t", np.ascontiguousarray(t, np.float64), count)
        return self._scene.judge(rays, faces, times, t is not None)

    def judge_any(
        self,
        origin: npt.ArrayLike,
        direction: npt.ArrayLike,
        hit: npt.ArrayLike,
        t_min: npt.ArrayLike = 0.0,
        t_max: npt.ArrayLike = np.inf,
    ) -> npt.NDArray[np.uint8]:
        """Judges if rays hit anything, as a shadow test answers it: `hit` of shape (n,), of bools. Returns codes of `Judgement`: RIGHT,
        LOST, GHOST or NEIGHBOUR."""
        rays = self._rays(origin, direction, t_min, t_max)
        return self._scene.judge_any(rays, _bools("hit", hit, len(rays[0])))[0]

    def judge_count(
        self,
        origin: npt.ArrayLike,
        direction: npt.ArrayLike,
        count: npt.ArrayLike,
        t_min: npt.ArrayLike = 0.0,
        t_max: npt.ArrayLike = np.inf,
    ) -> npt.NDArray[np.uint8]:
        """Judges the numbers of hits that a program counted: `count` of shape (n,), whole numbers from 0. Every point of the surface
        counts once, or every face there (two at an edge). Returns codes of `Judgement`: RIGHT, TIE, TOO_FEW, TOO_MANY or NEIGHBOUR."""
        rays = self._rays(origin, direction, t_min, t_max)
        counts = _whole("count", count, len(rays[0]))
        if (counts < 0).any():
            raise ValueError("count has numbers below 0")
        return self._scene.judge_count(rays, counts.astype(np.uint64))[0]

    def judge_hits(
        self,
        origin: npt.ArrayLike,
        direction: npt.ArrayLike,
        ray: npt.ArrayLike,
        face: npt.ArrayLike,
        t: Optional[npt.ArrayLike] = None,
        t_min: npt.ArrayLike = 0.0,
        t_max: npt.ArrayLike = np.inf,
    ) -> npt.NDArray[np.uint8]:
        """Judges all hits that a program named for n rays, as m hits in flat arrays: `ray` of shape (m,), the number of the ray from 0;
        `face` (m,), and `t` (m,) if it gives them. The hits of one ray stand in the program's order, the nearer ones first; a ray
        without hits is not named. Every point has to be named once at least, by any of the faces there. Returns the codes of
        `Judgement` of the n rays."""
        rays = self._rays(origin, direction, t_min, t_max)
        numbers = _whole("ray", ray, None)
        faces = _whole("face", face, len(numbers))
        for name, array, end in (("ray", numbers, len(rays[0])), ("face", faces, 2**32 - 1)):
            if (array < 0).any() or (array >= end).any():
                raise ValueError(f"{name} has a number outside of 0 to {end - 1}; a ray without hits is not named")
        times = np.full(len(numbers), np.nan) if t is None else np.ascontiguousarray(t, np.float64)
        times = _shaped("t", times, len(numbers))
        return self._scene.judge_hits(rays, numbers, faces.astype(np.uint32), times, t is not None)[0]

    def judge_inside(
        self, points: npt.ArrayLike, inside: npt.ArrayLike
    ) -> Tuple[npt.NDArray[np.uint8], npt.NDArray[np.float64]]:
        """Judges on which side n points are, as a program answered it: `inside` of shape (n,), bools or codes of `Where` (OUTSIDE,
        INSIDE, ON). Returns codes of `Judgement`: RIGHT, WRONG_SIDE, TIE for a side that is answered of a point on the surface, or NOT_DEFINED
        at an open one; and how far each point on the wrong side is from the surface, in longest edges of the face there (NaN for the
        others)."""
        column = self._columns([("points", points, 3)])[0]
        if np.asarray(inside).dtype == np.bool_:
            places = _bools("inside", inside, len(column)).astype(np.int8)
        else:
            places = _whole("inside", inside, len(column))
            if not np.isin(places, (Where.OUTSIDE, Where.INSIDE, Where.ON)).all():
                raise ValueError("inside has other numbers than Where.OUTSIDE, Where.INSIDE and Where.ON")
        return self._scene.judge_place(column, places.astype(np.int8))

    def picture(
        self,
        origin: npt.ArrayLike,
        direction: npt.ArrayLike,
        face: Optional[int] = None,
        t: Optional[float] = None,
        t_min: float = 0.0,
        t_max: float = np.inf,
    ) -> Picture:
        """One ray as a drawing that a notebook shows: the faces around, the exact nearest hit and, if a program's `face` is given (below
        0 for a miss) with its `t` perhaps, that answer and how far it is off. `.save("ray.svg")` writes it. A ValueError if there is
        more than one ray, or if the mesh has no finite face."""
        rays = self._one_ray(origin, direction, t_min, t_max)
        if face is None and t is not None:
            raise ValueError("t is of an answer: give its face too")
        number = None if face is None else operator.index(face)
        number = -1 if number == 2**32 - 1 else number
        drawn = self._scene.picture(rays, None if number is None else (number, None if t is None else float(t)))
        if drawn is None:
            raise ValueError("the mesh has no finite face: there is nothing to draw")
        return Picture(drawn)

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
        rays = self._one_ray(origin, direction, t_min, t_max)
        found = self._scene.meetings(rays)
        return [Meeting((first, last), faces, *rest) for first, last, faces, *rest in found]

    def _rays(self, origin: Any, direction: Any, t_min: Any, t_max: Any) -> "list[npt.NDArray[Any]]":
        return self._columns([("origin", origin, 3), ("direction", direction, 3), ("t_min", t_min, 1), ("t_max", t_max, 1)])

    def _one_ray(self, origin: Any, direction: Any, t_min: Any, t_max: Any) -> "list[npt.NDArray[Any]]":
        rays = self._rays(origin, direction, t_min, t_max)
        if len(rays[0]) != 1:
            raise ValueError(f"expected one ray, found {len(rays[0])}")
        return rays

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


def _shaped(name: str, array: npt.NDArray[Any], count: Optional[int]) -> npt.NDArray[Any]:
    """The array, if it has the shape (count,); any length if that is None."""
    if array.ndim != 1 or count not in (None, len(array)):
        expected = "(m,)" if count is None else f"({count},)"
        raise ValueError(f"{name} has the shape {array.shape}, expected {expected}")
    return array


def _whole(name: str, value: Any, count: Optional[int]) -> npt.NDArray[np.int64]:
    """Whole numbers, of a shape."""
    array = _shaped(name, np.asarray(value), count)
    if array.dtype.kind not in "iu" and array.size > 0:
        raise ValueError(f"{name} is of {array.dtype}, expected whole numbers")
    return np.ascontiguousarray(array, np.int64)


def _bools(name: str, value: Any, count: int) -> npt.NDArray[np.bool_]:
    """Bools, or numbers that are 0 and 1, of a shape."""
    array = _shaped(name, np.asarray(value), count)
    if not np.isin(array, (0, 1)).all():
        raise ValueError(f"{name} is of {array.dtype} with other values than 0 and 1, expected bools")
    return np.ascontiguousarray(array, np.bool_)
