"""Whole meshes: as the program decides them, by hand, and by exact fractions."""

from fractions import Fraction

import numpy as np
import pytest

from hairline import Judgement, Scene, Where

# A tetrahedron with corners at the origin and at 1 on each axis, wound to the outside.
VERTICES = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
FACES = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]


def test_the_nearest_faces_and_their_ties():
    found = Scene(VERTICES, FACES).nearest([[0.125, 0.125, 5], [0, 0, 5], [5, 5, 5]], [0, 0, -1])
    assert found["face"].tolist() == [3, 1, -1]
    assert found["t"][:2].tolist() == [4.25, 4.0] and np.isnan(found["t"][2])
    assert found["ties"].tolist() == [1, 3, 0]
    bounded = Scene(VERTICES, FACES).nearest([0.125, 0.125, 5], [0, 0, -1], t_max=[4, 4.25])
    assert bounded["face"].tolist() == [-1, 3]


def test_what_one_ray_meets():
    first, second = Scene(VERTICES, FACES).meetings([0.125, 0.125, 5], [0, 0, -1])
    assert (first.t, first.faces, first.crosses, first.winding) == ((4.25, 4.25), [3], True, (0, 1))
    assert (second.faces, second.winding) == ([0], (1, 0))
    (along,) = Scene(VERTICES, FACES).meetings([0, 0, 5], [0, 0, -1])
    assert along.is_segment and along.t == (4.0, 5.0) and along.crosses is False
    with pytest.raises(ValueError, match="expected one ray, found 2"):
        Scene(VERTICES, FACES).meetings(np.zeros((2, 3)), [0, 0, 1])


def test_answers_are_judged():
    origin = [[0.125, 0.125, 5]] * 4 + [[5, 5, 5]]
    codes, behind = Scene(VERTICES, FACES).judge(origin, [0, 0, -1], [3, -1, 0, 3, 2], [4.25, 0, 5, 4.5, 1])
    expected = [Judgement.RIGHT, Judgement.LOST, Judgement.FARTHER, Judgement.WRONG_T, Judgement.GHOST]
    assert codes.tolist() == expected
    assert behind[0] == 0 and np.isclose(behind[3], 0.25 / np.sqrt(2))
    assert Scene(VERTICES, FACES).judge(origin[0], [0, 0, -1], [2**32 - 1])[0] == [Judgement.LOST]


def test_points_inside_and_surfaces_that_have_none():
    points = [[0.125, 0.125, 0.125], [1, 1, 1], [0, 0, 0.5]]
    scene = Scene(VERTICES, FACES)
    assert scene.locate(points)[0].tolist() == [Where.INSIDE, Where.OUTSIDE, Where.ON]
    assert scene.inside(points).tolist() == [True, False, False]
    with pytest.raises(ValueError, match="the surface is open, at an edge of face"):
        Scene(VERTICES, FACES[:3]).inside(points)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_against_fractions(dtype):
    rng = np.random.default_rng(5)
    vertices = rng.integers(-4, 5, (12, 3)).astype(dtype) / dtype(4)
    faces = np.array([rng.permutation(12)[:3] for _ in range(14)])
    origin = rng.integers(-12, 13, (300, 3)).astype(dtype) / dtype(4)
    # At edges, some of which lie in planes of other faces.
    ends = vertices[faces[rng.integers(0, 14, 300), 0]], vertices[faces[rng.integers(0, 14, 300), 1]]
    direction = ends[0] + ends[1] - 2 * origin
    direction[(direction == 0).all(axis=1)] = 1
    found = Scene(vertices, faces).nearest(origin, direction)
    hits = 0
    for o, d, one in zip(origin, direction, found):
        met = [crossing(o, d, vertices[face]) for face in faces]
        if PARALLEL in met:
            # A face in whose plane the ray lies may be nearer.
            continue
        met = [t for t in met if t is not None]
        assert (one["face"] >= 0) == bool(met)
        if met:
            assert one["t"] == float(min(met)) and one["ties"] == met.count(min(met))
            hits += 1
    assert hits > 20


PARALLEL = "parallel"


def crossing(origin, direction, triangle):
    """The t of a crossing, in fractions; None for a miss."""
    exact = lambda vector: [Fraction(float(x)) for x in vector]
    o, d, (a, b, c) = exact(origin), exact(direction), map(exact, triangle)
    sub = lambda p, q: [x - y for x, y in zip(p, q)]
    dot = lambda p, q: sum(x * y for x, y in zip(p, q))
    cross = lambda p, q: [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
    normal = cross(sub(b, a), sub(c, a))
    along = dot(d, normal)
    if along == 0:
        return PARALLEL
    signs = [dot(d, cross(sub(p, o), sub(q, o))) for p, q in ((a, b), (b, c), (c, a))]
    t = dot(sub(a, o), normal) / along
    inside = all(s >= 0 for s in signs) or all(s <= 0 for s in signs)
    return t if inside and t >= 0 else None


def test_bad_arguments_are_refused():
    for arguments, message in [
        ((VERTICES, [[0, 1, 9]]), "face 0 names vertex 9, which does not exist"),
        ((VERTICES, [[0, 1, -1]]), "expected places of vertices from 0"),
        ((VERTICES, [0, 1, 2]), r"faces has the shape \(3,\), expected \(n, 3\)"),
    ]:
        with pytest.raises(ValueError, match=message):
            Scene(*arguments)
    scene = Scene(np.float32(VERTICES), FACES)
    with pytest.raises(ValueError, match="origin has numbers that float32 does not hold"):
        scene.nearest([0.1, 0, 5], [0, 0, -1])
    with pytest.raises(ValueError, match="row 0: the ray's direction is zero"):
        scene.nearest([0, 0, 5], [0, 0, 0])
    with pytest.raises(ValueError, match="direction has 2 rows, the arguments before it 3"):
        scene.nearest(np.zeros((3, 3)), np.ones((2, 3)))
