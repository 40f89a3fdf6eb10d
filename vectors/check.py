#!/usr/bin/env python3
"""Checks the test vectors against their definition, in fractions. It shares nothing with the program that
wrote them.

    python3 check.py            the files beside this one
    ... | python3 check.py -    tests from standard input, a JSON object a line

Prints every disagreement and their number; the exit code is 1 if there is one."""
import csv, hashlib, json, struct, sys
from fractions import Fraction as Q
from math import isfinite, isnan
from pathlib import Path

HERE = Path(__file__).resolve().parent
sub = lambda p, q: [x - y for x, y in zip(p, q)]
dot = lambda p, q: sum(x * y for x, y in zip(p, q))
cross = lambda p, q: [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
rounded = lambda x: float(x) if abs(x) < 2**1024 - 2**970 else None


def meets_segment(o, d, low, high, p, q):
    """Whether o + t d is a point of the segment pq for a t in [low, high]."""
    e, to_p = sub(q, p), sub(p, o)
    n = cross(d, e)
    if any(n):
        if dot(to_p, n):
            return False
        t, s = (dot(cross(to_p, x), n) / dot(n, n) for x in (e, d))
        return 0 <= s <= 1 and low <= t <= high
    if any(cross(to_p, d)):
        return False
    ends = sorted(dot(sub(x, o), d) / dot(d, d) for x in (p, q))
    return ends[0] <= high and low <= ends[1]


def holds(a, b, c, n, p):
    """Whether the closed triangle holds the point p of its plane."""
    return all(dot(cross(sub(y, x), sub(p, x)), n) >= 0 for x, y in ((a, b), (b, c), (c, a)))


def truth(ray, triangle, aside=(0, 0, 0)):
    """What is right for a ray (8 floats), moved aside, and a triangle (9 floats)."""
    numbers, low, high = ray[:6] + triangle, ray[6], ray[7]
    if not all(map(isfinite, numbers)) or not any(ray[3:6]) or not low <= high:
        return dict(where="invalid", closed="free", open="free")
    low, high = (Q(x) if isfinite(x) else x for x in (low, high))
    o, d, a, b, c = (list(map(Q, numbers[i : i + 3])) for i in range(0, 15, 3))
    o = [x + y for x, y in zip(o, aside)]
    n = cross(sub(b, a), sub(c, a))
    area, slope, height = dot(n, n), dot(d, n), dot(sub(a, o), n)
    if area and slope:
        t = height / slope
        p = sub([x + t * y for x, y in zip(o, d)], a)
        u, v = dot(cross(p, sub(c, a)), n) / area, dot(cross(sub(b, a), p), n) / area
        weights = [1 - u - v, u, v]
        where = "outside" if min(weights) < 0 else "vertex_a vertex_b edge_ab vertex_c edge_ca edge_bc interior".split()[sum(2**i for i in range(3) if weights[i]) - 1]
        places = [(t < low, "before"), (t == low, "at_min"), (t == high, "at_max"), (t > high, "beyond"), (1, "within")]
        place = next(name for is_there, name in places if is_there)
        closed = where != "outside" and place not in ("before", "beyond")
        opened = where == "interior" and place == "within"
        found = dict(where=where, place=place, facing="front" if slope < 0 else "back", t=t, u=u, v=v, margin=min(weights))
    else:
        where = "degenerate" if not area else "parallel" if height else "coplanar"
        contact = where != "parallel" and any(meets_segment(o, d, low, high, *pq) for pq in ((a, b), (b, c), (c, a)))
        # A part of the line that ends inside the triangle meets no edge.
        ends = [[x + t * y for x, y in zip(o, d)] for t in (low, high) if isinstance(t, Q)]
        inside = where == "coplanar" and any(holds(a, b, c, n, p) for p in ends)
        found, closed, opened = dict(where=where), contact or inside, False
    return found | dict(zip(("closed", "open"), ("hit" if x else "miss" for x in (closed, opened))))


def group(ray, triangles, found):
    """What is right of a group: rays a hair beside this one cross the surface where this one does."""
    hair = Q(1, 2**600)
    counts = []
    for aside in ((3, 5, 7), (-7, 3, 5), (5, -7, -3), (-3, -5, 8), (8, -3, -7), (-5, 7, -8), (1, 9, -4), (-9, -1, 6)):
        beside = [truth(ray, triangle, [hair * x for x in aside]) for triangle in triangles]
        # A direction along an edge decides nothing.
        if all(one["closed"] == one["open"] for one in beside):
            counts.append(sum(one["open"] == "hit" for one in beside))
    closed, opened = (sum(one[reading] == "hit" for one in found) for reading in ("closed", "open"))
    crossing = {*counts} == {1}
    assert len(counts) > 3 and len({count % 2 for count in counts}) == 1, f"no rule for {counts} hits"
    result = "exactly-one" if closed == opened == 1 else "at-least-one" if crossing else "free"
    parity = "odd" if min(counts) % 2 else "even"
    return dict(closed=closed, open=opened, result=result, parity=parity, where=[one["where"] for one in found])


def check(test):
    """Yields what a test says wrongly."""
    words = test["bits"].split()
    code = {"f32": ">f", "f64": ">d"}[test["scalar"]]
    numbers = [struct.unpack(code, bytes.fromhex(word))[0] for word in words]
    ray, triangles = numbers[:8], [numbers[i : i + 9] for i in range(8, len(numbers), 9)]
    corners = [test["vertices"][i] for t in test["triangles"] for i in t] if "triangles" in test else [test[x] for x in "abc"]
    texts = test["origin"] + test["direction"] + [test["t_min"], test["t_max"]] + sum(corners, [])
    for text, number in zip(texts, numbers, strict=True):
        read = float.fromhex(text)
        if not (isnan(read) and isnan(number) or struct.pack(">d", read) == struct.pack(">d", number)):
            yield f"{text} is not {number.hex()}"
    digest = hashlib.sha256(f"{test['scalar']} {test['bits']}".encode()).hexdigest()[:16]
    if not test["id"].endswith("-" + digest):
        yield f"the numbers have the digest {digest}"
    found = [truth(ray, triangle) for triangle in triangles]
    # From these on a square rounds to a normal number, and to infinity.
    least, most = {"f32": (2**-126 - 2**-150, 2**128 - 2**103), "f64": (Q(1, 2**1022) - Q(1, 2**1075), 2**1024 - 2**970)}[test["scalar"]]
    at_end = any(one.get("place", "")[:3] == "at_" for one in found)
    extreme = any(isfinite(x) and x and not least <= Q(x) ** 2 < most for x in numbers)
    if at_end != ("interval-end" in test["flags"]) or extreme and "range-ends" not in test["flags"]:
        yield f"flags are {test['flags']}"
    expected = group(ray, triangles, found) if "triangles" in test else found[0]
    if "triangles" not in test:
        expected["result"] = expected["closed"] if expected["closed"] == expected["open"] else "free"
        if expected["result"] == "free":
            edge, end = expected["where"][:4] in ("edge", "vert"), expected.get("place", "")[:3] == "at_"
            names = ["boundary"] * edge + ["ends"] * end
            expected["free_because"] = names or [expected["where"]]
        for name in ("t", "u", "v", "margin"):
            if name in expected:
                value = expected[name]
                expected[name] = rounded(value)
                text = f"{value.numerator}/{value.denominator}"
                if name != "margin" and len(text) <= 60:
                    expected[name + "_exact"] = text
    for key in expected.keys() | test.keys() & {"t", "u", "v", "margin", "t_exact", "u_exact", "v_exact", "free_because", "place", "facing"}:
        if expected.get(key, "nothing") != test.get(key, "nothing"):
            yield f"{key} is {test.get(key)}, expected {expected.get(key)}"


def main():
    wrong = []
    tests = [json.loads(line) for line in sys.stdin] if sys.argv[1:] == ["-"] else None
    if tests is None:
        files = sorted(HERE.glob("*.json"))
        digest = hashlib.sha256(b"".join(file.read_bytes() for file in files)).hexdigest()
        if (HERE / "sha256.txt").read_text().strip() != digest:
            wrong.append(f"sha256.txt: the files have {digest}")
        tests = [test for file in files for test in json.loads(file.read_text())["tests"]]
        ids = [test["id"] for test in tests]
        wrong += [f"{id}: stands twice" for id in {id for id in ids if ids.count(id) > 1}]
        rows = {}
        for row in csv.DictReader((HERE / "core.csv").open()):
            rows.setdefault(row["id"], []).append(row)
        for test in tests:
            found = rows[test["id"]]
            bits = [word for row in found for word in list(row.values())[(18 if row["triangle"] == "0" else 26) :]]
            if bits != test["bits"].split() or found[0]["group" if "triangles" in test else "result"] != test["result"]:
                wrong.append(f"{test['id']}: core.csv differs")
    for test in tests:
        wrong += [f"{test['id']}: {message}" for message in check(test)]
    print(*wrong, f"{len(tests)} tests, {len(wrong)} disagreements", sep="\n")
    sys.exit(bool(wrong) or not tests)


if __name__ == "__main__":
    main()
