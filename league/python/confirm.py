"""Confirms the deepest false verdicts of an edition without hairline: what is right by vectors/check.py, in fractions, and
what the published function says where it is installed.

    league/python/venv/bin/python league/python/confirm.py [EDITION] [KERNEL …]     from the project's root; the newest edition
"""

import json
import re
import shlex
import subprocess
import sys
from fractions import Fraction
from math import inf
from pathlib import Path
from struct import unpack

LEAGUE = Path(__file__).resolve().parent.parent
sys.path.append(str(LEAGUE.parent / "vectors"))
from check import cross, dot, sub, truth  # noqa: E402


def numbers(bits, scalar):
    """Origin, direction, a, b, c, t_min and t_max of a case."""
    words = [word for part in bits.split() for word in part[2:].split(",")]
    code = {"f32": ">f", "f64": ">d"}[scalar]
    return [unpack(code, bytes.fromhex(word))[0] for word in words]


def is_right(case, contract):
    """The verdicts that a contract allows for a case: a set of "hit" and "miss". Bands are left to hairline."""
    extent = contract.split(",")[0]
    interval = {"line": [-inf, inf], "ray": [0.0, inf]}.get(extent, case[15:])
    found = truth(case[:6] + interval, case[6:15])
    d, a, b, c = (list(map(Fraction, case[i : i + 3])) for i in (3, 6, 9, 12))
    if "front only" in contract and found.get("facing") == "back":
        return {"miss"}
    allowed = {found["open"]} | ({found["closed"]} if "boundary free" in contract or "ends free" in contract else set())
    least = re.search(r"no hit owed at \|det\| < (\S+?)(,|$)", contract)
    if least and abs(dot(d, cross(sub(b, a), sub(c, a)))) < Fraction(float(least[1])):
        allowed.add("miss")
    return {found["closed"]} if ", closed" in contract else allowed


def says(command, scalar, case):
    """The verdict of a kernel's process; none if the command does not start one."""
    words = shlex.split(command)
    if "--kernel-cmd" not in words:
        return None
    kernel = shlex.split(words[words.index("--kernel-cmd") + 1])
    if not Path(kernel[0]).exists() and "/" in kernel[0]:
        return None
    text = f"case 0 {scalar} {' '.join(map(repr, case))}\nend 1\n"
    done = subprocess.run(kernel, input=text, capture_output=True, text=True, cwd=LEAGUE.parent)
    answers = [line.split()[1] for line in done.stdout.splitlines() if line.startswith("0 ")]
    return answers[0] if answers else None


def main():
    names = sys.argv[1:]
    editions = sorted((LEAGUE / "editions").iterdir())
    edition = LEAGUE / "editions" / names.pop(0) if names and names[0].startswith("league-") else editions[-1]
    wrong, cases, shown = [], 0, 0
    for file in sorted((edition / "entrants").glob("*.json")):
        entrant = json.loads(file.read_text())
        if names and entrant["kernel"] not in names:
            continue
        for scalar, result in entrant["scalars"].items():
            for verdict in ("miss", "hit"):
                depth = result[f"deepest_{verdict}"]
                if depth is None:
                    continue
                case, cases = numbers(depth["bits"], scalar), cases + 1
                if verdict in is_right(case, entrant["contract"]):
                    wrong.append(f"{file.stem} {scalar} {depth['case']}: a {verdict} is right")
                answer = says(depth["command"], scalar, case) if names else None
                shown += answer is not None
                if answer not in (None, verdict):
                    wrong.append(f"{file.stem} {scalar} {depth['case']}: it says {answer}")
    print(*wrong, f"{edition.name}: {cases} cases, {shown} shown by the function, {len(wrong)} not confirmed", sep="\n")
    sys.exit(bool(wrong) or not cases)


main()
