"""The truths of arrays are the program's, and arguments are checked."""

import itertools
import json
import threading
import time

import numpy as np
import pytest

import hairline


def cases_of(program, tmp_path, scalar, count):
    """Cases of all families: their numbers, and the truths that the program prints."""
    lines = program("generate", "--scalar", scalar, "-n", str(count)).splitlines()
    words = [line.split() for line in lines if line.startswith("case ")]
    numbers = np.array([[float(word) for word in case[3:]] for case in words])
    # The program reads finite numbers from JSON.
    numbers = numbers[np.isfinite(numbers[:, :15]).all(axis=1) & ~np.isnan(numbers[:, 15:]).any(axis=1)]
    path = tmp_path / "cases.jsonl"
    with path.open("w") as file:
        for i, row in enumerate(numbers.tolist()):
            vectors = {name: row[3 * k : 3 * k + 3] for k, name in enumerate(("origin", "direction", "a", "b", "c"))}
            ends = {name: end for name, end in zip(("t_min", "t_max"), row[15:]) if np.isfinite(end)}
            if len(ends) == 2 or row[15:] == [0, np.inf] or np.isfinite(row[15]) and row[16] == np.inf:
                file.write(json.dumps({"name": f"c{i}", "scalar": scalar, **vectors, **ends}) + "\n")
    truths = [json.loads(line) for line in program("truth", str(path)).splitlines()]
    kept = [int(truth["name"][1:]) for truth in truths]
    return numbers[kept], truths


def arguments(numbers, dtype):
    numbers = numbers.astype(dtype)
    return [numbers[:, i : i + 3] for i in range(0, 15, 3)] + [numbers[:, 15], numbers[:, 16]]


def expected(truth):
    """Class, facing, place, feature and hit, from the program's words."""
    contact = truth["contact"]
    feature = truth["feature"]
    if contact is not None:
        feature = {"none": "outside", "segment": "segment"}.get(contact["kind"], contact.get("feature"))
    code = lambda kind, word: kind.NONE if word is None else kind[word.upper()]
    return (
        code(hairline.Class, truth["class"]), code(hairline.Facing, truth["facing"]), code(hairline.Place, truth["t"]),
        code(hairline.Feature, feature), truth["hits_closed"] is True,
    )


@pytest.mark.parametrize("scalar, dtype", [("f32", np.float32), ("f64", np.float64)])
def test_truths_are_those_of_the_program(program, tmp_path, scalar, dtype):
    numbers, truths = cases_of(program, tmp_path, scalar, 450)
    assert len(truths) >= 10_000
    found = hairline.truth(*arguments(numbers, dtype))
    assert [tuple(row)[:4] + (row["hit"],) for row in found] == [expected(truth) for truth in truths]
    assert {truth["class"] for truth in truths} >= {"transversal", "parallel", "coplanar", "degenerate"}
    # The same numbers in a wider type are the same question.
    assert (hairline.truth(*arguments(numbers, np.float64)) == found).all()


TRIANGLE = ([0, 0, 0], [4, 0, 0], [0, 4, 0])


def test_one_triangle_serves_many_rays_and_ends_count():
    origin = np.array([[1, 1, 1], [2, 2, 1], [9, 9, 1]], np.float32)
    found = hairline.truth(origin, [0, 0, -1], *TRIANGLE)
    assert found["hit"].tolist() == [True, True, False]
    assert found["feature"].tolist() == [hairline.Feature.INTERIOR, hairline.Feature.EDGE_BC, hairline.Feature.OUTSIDE]
    assert (found["t_sign"] == 1).all() and (found["facing"] == hairline.Facing.FRONT).all()
    assert hairline.truth([1, 1, 1], [0, 0, -1], *TRIANGLE, t_max=0.5)["place"] == hairline.Place.BEYOND
    assert hairline.truth([1, 1, np.nan], [0, 0, -1], *TRIANGLE)["class"] == hairline.Class.INVALID
    assert hairline.truth(origin[:0], [0, 0, -1], *TRIANGLE).shape == (0,)
    # Rows that do not lie next to each other, and columns in Fortran's order.
    assert (hairline.truth(np.repeat(origin, 2, axis=0)[::2], [0, 0, -1], *TRIANGLE) == found).all()
    assert (hairline.truth(np.asfortranarray(origin), [0, 0, -1], *TRIANGLE) == found).all()


@pytest.mark.parametrize("origin, t_max, words", [
    (np.zeros((2, 4)), np.inf, r"origin has the shape \(2, 4\), expected \(n, 3\) or \(3,\)"),
    (np.zeros((2, 3)), np.ones(5), r"t_max has 5 rows, the arguments before it 2"),
    (np.zeros((2, 3)), np.ones((2, 1)), r"t_max has the shape \(2, 1\), expected \(n,\) or a number"),
    (np.array([["a", "b", "c"]]), np.inf, "origin is of <U1, expected float32, float64"),
    (np.array([2**53 + 1, 0, 0]), np.inf, "origin is of int64"),
    (np.zeros((2, 3), complex), np.inf, "origin is of complex128"),
])
def test_wrong_arguments_are_value_errors(origin, t_max, words):
    with pytest.raises(ValueError, match=words):
        hairline.truth(origin, [0, 0, -1], *TRIANGLE, t_max=t_max)


def test_the_interpreter_runs_meanwhile():
    rays = np.random.default_rng(1).normal(size=(3_000_000, 3))
    ticks, stop = itertools.count(), threading.Event()
    def tick():
        while not stop.is_set():
            next(ticks)
            time.sleep(0.001)
    thread = threading.Thread(target=tick)
    thread.start()
    before = next(ticks)
    hairline._hairline.truth([np.ascontiguousarray(rays)] * 5 + [np.zeros(1), np.ones(1)], len(rays), False)
    after = next(ticks)
    stop.set()
    thread.join()
    assert after - before > 5
