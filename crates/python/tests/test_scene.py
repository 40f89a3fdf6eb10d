"""Whole meshes: as the program decides them, by hand, and by exact fractions."""

import json
from fractions import Fraction
from xml.etree import ElementTree

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


THROUGH = [[0.125, 0.125, 5], [5, 5, 5]]
DOWN = [0, 0, -1]


def test_hits_at_all_are_judged():
    scene = Scene(VERTICES, FACES)
    right = scene.judge_any(THROUGH, DOWN, [True, False])
    assert right.tolist() == [Judgement.RIGHT] * 2 and right.dtype == np.uint8
    assert scene.judge_any(THROUGH, DOWN, np.array([0, 1])).tolist() == [Judgement.LOST, Judgement.GHOST]
    # It ends before the surface.
    assert scene.judge_any(THROUGH[0], DOWN, [False], t_max=4).tolist() == [Judgement.RIGHT]
    with pytest.raises(ValueError, match=r"hit has the shape \(1,\), expected \(2,\)"):
        scene.judge_any(THROUGH, DOWN, [True])
    with pytest.raises(ValueError, match="hit is of int64 with other values than 0 and 1, expected bools"):
        scene.judge_any(THROUGH, DOWN, [2, 0])


def test_counts_are_judged():
    scene = Scene(VERTICES, FACES)
    along = [*THROUGH, [0, 0, 5]]
    assert scene.judge_count(along, DOWN, [2, 0, 1]).tolist() == [Judgement.RIGHT] * 3
    assert scene.judge_count(along, DOWN, [1, 1, 4]).tolist() == [Judgement.TOO_FEW, Judgement.TOO_MANY, Judgement.TIE]
    for counts, message in [([1.5, 0, 0], "count is of float64, expected whole numbers"), ([1, -1, 0], "count has numbers below 0")]:
        with pytest.raises(ValueError, match=message):
            scene.judge_count(along, DOWN, counts)


def test_all_hits_are_judged_in_flat_arrays():
    scene = Scene(VERTICES, FACES)

    def judged(*hits, t=None):
        ray, face = np.array(hits, int).reshape(-1, 2).T
        return scene.judge_hits(THROUGH, DOWN, ray, face, t).tolist()

    assert judged((0, 3), (0, 0)) == [Judgement.RIGHT] * 2
    assert judged((0, 3), (0, 0), t=[4.25, 5]) == [Judgement.RIGHT] * 2
    assert judged((0, 3), (0, 0), t=[4.25, 6])[0] == Judgement.WRONG_T
    assert judged((0, 0), (0, 3))[0] == Judgement.WRONG_ORDER
    assert judged((1, 1), (0, 3)) == [Judgement.LOST, Judgement.GHOST]
    assert judged((0, 3), (0, 0), (0, 0))[0] == Judgement.TWICE
    assert judged() == [Judgement.LOST, Judgement.RIGHT]
    for ray, face, message in [
        ([0, 2], [3, 0], "ray has a number outside of 0 to 1"),
        ([0], [-1], "face has a number outside of 0 to "),
        ([0, 0], [3], r"face has the shape \(1,\), expected \(2,\)"),
        (0, [3], r"ray has the shape \(\), expected \(m,\)"),
    ]:
        with pytest.raises(ValueError, match=message):
            scene.judge_hits(THROUGH, DOWN, ray, face)
    with pytest.raises(ValueError, match=r"t has the shape \(1,\), expected \(2,\)"):
        scene.judge_hits(THROUGH, DOWN, [0, 0], [3, 0], [4.25])


def test_sides_of_points_are_judged():
    scene = Scene(VERTICES, FACES)
    points = [[0.125, 0.125, 0.125], [1, 1, 1], [0, 0, 0.5]]
    codes, distance = scene.judge_inside(points, [True, False, True])
    assert codes.tolist() == [Judgement.RIGHT, Judgement.RIGHT, Judgement.TIE] and np.isnan(distance).all()
    codes, distance = scene.judge_inside(points, [Where.OUTSIDE, Where.ON, Where.ON])
    assert codes.tolist() == [Judgement.WRONG_SIDE, Judgement.WRONG_SIDE, Judgement.RIGHT]
    # 1/8 from a face whose longest edge is the root of 2.
    assert np.isclose(distance[0], 0.125 / np.sqrt(2))
    assert Scene(VERTICES, FACES[:3]).judge_inside(points[:1], [True])[0].tolist() == [Judgement.NOT_DEFINED]
    with pytest.raises(ValueError, match="inside has other numbers than Where.OUTSIDE, Where.INSIDE and Where.ON"):
        scene.judge_inside(points, [0, 1, 3])
    with pytest.raises(ValueError, match=r"inside has the shape \(2,\), expected \(3,\)"):
        scene.judge_inside(points, [True, False])


@pytest.mark.parametrize("kind, answers", [("any", "0\n1\n"), ("count", "1\n0\n"), ("all", "0,0\n1,2\n"), ("inside", "0\n1\n")])
def test_judgements_are_those_of_the_program(program, tmp_path, kind, answers):
    (tmp_path / "t.obj").write_text("".join(f"v {x} {y} {z}\n" for x, y, z in VERTICES) + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in FACES))
    points = [[0.125, 0.125, 0.125], [1, 1, 1]]
    questions = points if kind == "inside" else [[*origin, *DOWN] for origin in THROUGH]
    (tmp_path / "q.csv").write_text("".join(",".join(map(str, row)) + "\n" for row in questions))
    (tmp_path / "a.csv").write_text(answers)
    asked = ["--points", str(tmp_path / "q.csv")] if kind == "inside" else [str(tmp_path / "q.csv")]
    words = ["rays", str(tmp_path / "t.obj"), *asked, "--answers", str(tmp_path / "a.csv"), "--answered", kind, "--scalar", "f64", "-q", "--format", "json"]
    counts = json.loads(program(*words, code=1))["result"]["counts"]
    scene = Scene(VERTICES, FACES)
    codes = {
        "any": lambda: scene.judge_any(THROUGH, DOWN, [0, 1]),
        "count": lambda: scene.judge_count(THROUGH, DOWN, [1, 0]),
        "all": lambda: scene.judge_hits(THROUGH, DOWN, [0, 1], [0, 2]),
        "inside": lambda: scene.judge_inside(points, [False, True])[0],
    }[kind]()
    words = {"farther face": "farther"}
    expected = {words.get(it["judgement"], it["judgement"]).replace(" ", "_").upper(): it["count"] for it in counts if it["count"]}
    assert {Judgement(code).name: int((codes == code).sum()) for code in set(codes.tolist())} == expected


def test_a_wrong_ray_is_a_picture(tmp_path):
    scene = Scene(VERTICES, FACES)
    wrong = scene.picture(THROUGH[0], DOWN, face=0, t=5)
    drawn = ElementTree.fromstring(wrong._repr_svg_())
    assert drawn.tag == "{http://www.w3.org/2000/svg}svg"
    words = " ".join(it.text for it in drawn.iter("{http://www.w3.org/2000/svg}text"))
    assert "exact: face 3" in words and "answer: face 0" in words
    assert "Farther face: the nearest is face 3 at t = 4.25; answered face 0 at t = 5.0, which it meets 0.530 longest edges behind." in words
    wrong.save(tmp_path / "wrong.svg")
    assert (tmp_path / "wrong.svg").read_text(encoding="utf-8") == wrong
    assert "answer:" not in scene.picture(THROUGH[0], DOWN)
    assert "answered a miss" in scene.picture(np.float64(THROUGH[:1]), DOWN, face=-1)
    # The words have the answer's t, and the drawing has no such number.
    drawn = ElementTree.fromstring(str(scene.picture(THROUGH[1], DOWN, face=1, t=np.nan)))
    attributes = [pair for it in drawn.iter() for pair in it.attrib.items()]
    assert attributes and not any("nan" in value.lower() for name, value in attributes if name != "aria-label")
    for arguments, message in [
        ((THROUGH, DOWN), "expected one ray, found 2"),
        ((THROUGH[0], DOWN, None, 4.0), "t is of an answer: give its face too"),
        ((THROUGH[0], [0, 0, 0]), "the ray's direction is zero"),
    ]:
        with pytest.raises(ValueError, match=message):
            scene.picture(*arguments)
    with pytest.raises(ValueError, match="the mesh has no finite face"):
        Scene([[np.nan, 0, 0]] * 3, [[0, 1, 2]]).picture(THROUGH[0], DOWN)


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
