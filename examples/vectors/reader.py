"""Runs Möller and Trumbore's test, in doubles, on the core set: python3 reader.py ../../vectors results.json"""
import json
import sys
from pathlib import Path

PRODUCT = "Moller-Trumbore in Python"
folder = Path(sys.argv[1] if len(sys.argv) > 1 else "vectors")


def minus(p, q):
    return [x - y for x, y in zip(p, q)]


def dot(p, q):
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]


def cross(p, q):
    return [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]


def hits(o, d, t_min, t_max, a, b, c):
    e, f, s = minus(b, a), minus(c, a), minus(o, a)
    p, q = cross(d, f), cross(s, e)
    det = dot(e, p)
    if det == 0:
        return False
    u, v, t = dot(s, p) / det, dot(d, q) / det, dot(f, q) / det
    return u >= 0 and v >= 0 and u + v <= 1 and t_min <= t <= t_max


def numbers(texts):
    return [float.fromhex(text) for text in texts]


results, failed = {}, 0
for file in sorted(folder.glob("*.json")):
    for test in json.loads(file.read_text())["tests"]:
        ray = [numbers(test["origin"]), numbers(test["direction"]), *numbers([test["t_min"], test["t_max"]])]
        corners = [numbers(vertex) for vertex in test.get("vertices") or [test["a"], test["b"], test["c"]]]
        count = sum(hits(*ray, *(corners[i] for i in t)) for t in test.get("triangles", [[0, 1, 2]]))
        answer = count if "triangles" in test else "hit" if count else "miss"
        right = {"exactly-one": count == 1, "at-least-one": count > 0, "free": True}
        failed += not right.get(test["result"], answer == test["result"])
        results[test["id"]] = answer
print(f"{PRODUCT}: {len(results) - failed} passed, {failed} failed")
digest = (folder / "sha256.txt").read_text().strip()
text = json.dumps({"vectors": digest, "product": PRODUCT, "results": results}, indent=0)
Path(sys.argv[2] if len(sys.argv) > 2 else "results.json").write_text(text + "\n")
