"""Audits of functions are the program's audits, and errors are Python's."""

import builtins
import json
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

import kernels
import numpy as np
import pytest

import hairline

ROOT = pathlib.Path(__file__).parents[3]
FAMILIES = ["interior", "edge-near", "vertex-exact", "sliver", "grazing", "degenerate", "shared-edge"]


def without_kernel(result):
    """Findings without what names the kernel."""
    part = lambda finding: {**finding, "causes": None, "worst": finding["worst"]["case"], "first": None}
    return {**result, "kernel": "", "set": "", "accuracy": None, "findings": [part(f) for f in result["findings"]]}


@pytest.mark.parametrize("scalar, name", [("f32", "float32"), ("f64", "float64")])
def test_an_audit_is_the_programs_audit_of_the_same_kernel_over_a_pipe(program, scalar, name):
    flags = ["--scalar", scalar, "--family", ",".join(FAMILIES), "-n", "700", "--seed", "3", "--contract", "closed-ray"]
    pipe = shlex.join([sys.executable, str(ROOT / "examples/python/numpy_kernel.py")])
    record = json.loads(program("audit", "--quiet", "--format", "json", "--kernel-cmd", pipe, *flags))
    audited = hairline.audit(kernels.moller_trumbore, scalar=name, families=FAMILIES, count=700, seed=3)
    expected = [without_kernel(result) for result in record["result"]["results"]]
    assert [without_kernel(result) for result in audited.record["result"]["results"]] == expected
    assert sum(row["count"] for row in audited.findings) > 300
    # Case by case it is the same kernel.
    one = hairline.audit(kernels.one_by_one, scalar=name, families=FAMILIES, count=700, seed=3, vectorized=False)
    assert [without_kernel(result) for result in one.record["result"]["results"]] == expected


def test_a_scene_is_run_in_the_kinds_of_the_program(program):
    pipe = shlex.join([sys.executable, str(ROOT / "examples/python/numpy_kernel.py")])
    flags = ["--scene", "room", "--scalar", "f32", "-n", "50", "--contract", "closed-ray"]
    record = json.loads(program("audit", "--quiet", "--format", "json", "--kernel-cmd", pipe, *flags))
    audited = hairline.audit(kernels.moller_trumbore, scene="room", count=50)
    parts = lambda record: list(map(without_kernel, record["result"]["results"]))
    assert len(parts(record)) > 40 and parts(audited.record) == parts(record)
    # The screen is the command's too, but for the seconds and the flag.
    mine = f"{shlex.quote(sys.executable)} -m hairline.pipe {kernels.__file__}:moller_trumbore closed-ray"
    screen = program("audit", "--quiet", "--kernel-cmd", mine, *flags[:-2])
    untimed = lambda text: re.sub(r"[\d.]+ s, plan|[0-9a-f]{16}|--kernel-cmd '.*?'", "", text)
    assert untimed(audited.summary()) == untimed(screen)


def test_the_outcome_has_the_screen_the_page_and_the_worst_cases(program):
    audited = hairline.audit(kernels.moller_trumbore, families=["edge-near"], count=300)
    assert "moller_trumbore.py" in audited.summary() and "false misses" in audited.summary()
    assert repr(audited).startswith("<hairline.Audit: moller_trumbore.py")
    assert audited._repr_html_().startswith("<iframe srcdoc=") and "&lt;table" in audited._repr_html_()
    worst = audited.worst
    assert [row["distance"] for row in worst] == sorted((row["distance"] for row in worst), reverse=True)
    # The command shows the same case with the same kernel, and so does the method.
    command = shlex.split(worst[0]["command"].replace("python3", shlex.quote(sys.executable)))
    shown = program(*command[1:])
    assert shown.startswith("moller_trumbore.py (own): ")
    # Over the pipe it runs in both scalars.
    assert set(audited.explain(worst[0]["case"]).splitlines()) < set(shown.splitlines())
    with pytest.raises(ValueError, match="nonsense"):
        audited.explain("nonsense")


def test_a_data_frame_needs_pandas(monkeypatch):
    audited = hairline.audit(kernels.moller_trumbore, families=["edge-near"], count=100)
    real = builtins.__import__
    def missing(name, *rest):
        if name == "pandas":
            raise ImportError("no pandas")
        return real(name, *rest)
    monkeypatch.setattr(builtins, "__import__", missing)
    with pytest.raises(ImportError, match="pip install pandas; without it there is .findings"):
        audited.to_pandas()
    monkeypatch.undo()
    frame = pytest.importorskip("pandas") and audited.to_pandas()
    assert frame["count"].sum() == sum(row["count"] for row in audited.findings)


def exact(origin, direction, a, b, c, t_min, t_max):
    return hairline.truth(origin, direction, a, b, c)["hit"]


@pytest.mark.parametrize("miss", [-1.0, float("inf")])
def test_a_number_that_stands_for_a_miss_is_told_before_the_audit(miss):
    def one(origin, direction, a, b, c, t_min, t_max):
        return 1.0 if exact(origin, direction, a, b, c, t_min, t_max)[0] else miss

    with pytest.raises(ValueError, match=rf"hits with t = {miss} for rays that pass far beside .*, return None instead"):
        hairline.audit(one, vectorized=False, count=10)

    def many(origin, *rest):
        return np.full(len(origin), miss)

    with pytest.raises(ValueError, match=r"return t = nan instead"):
        hairline.audit(many, vectorized=True, count=10)


def test_a_right_kernel_conforms_and_a_wrong_one_says_where():
    hairline.assert_conforms(exact, contract="extent=ray,sides=both,boundary=closed,coplanar=hit,degenerate=hit", count=200)
    with pytest.raises(AssertionError) as raised:
        hairline.assert_conforms(kernels.moller_trumbore, families=["edge-near"], count=300)
    text = str(raised.value)
    assert re.search(r"f32 edge-near .*: false-hit .*: \d+ of \d+", text), text
    assert "hairline explain 'edge-near@" in text and "hairline.pipe" in text and "cargo" not in text, text
    # What is allowed may occur.
    hairline.assert_conforms(
        kernels.moller_trumbore, families=["edge-near"], count=300, allow={"false-hit": 0.5, "false-miss": 0.5}
    )


@pytest.mark.parametrize("answer, expected", [
    (lambda n: np.ones((n, 1), np.float32), r"t of shape \(\d+, 1\) for n = \d+ rays; expected t of shape \(n,\)"),
    (lambda n: 1.0, r"t of shape \(\) for n"),
    (lambda n: (np.ones(n), np.ones(n)), "a tuple of 2; expected"),
    (lambda n: {"t": np.ones(n), "w": np.ones(n)}, r"a dict of \['t', 'w'\]; expected"),
    (lambda n: {"hit": np.ones(n)}, "hit of float64; expected"),
    (lambda n: None, "returned None; expected"),
    (lambda n: ["no"] * n, "t of <U2; expected"),
    (lambda n: np.ones(n, np.int64), r"integers; for flags make them bool, as `hits.astype\(bool\)`; expected"),
    (lambda n: (np.ones(n, int), np.ones(n), np.ones(n)), "t of int64; expected"),
])
def test_wrong_answers_are_value_errors_that_say_what_is_expected(answer, expected):
    with pytest.raises(ValueError, match=expected):
        hairline.audit(lambda *arrays: answer(len(arrays[0])), families=["interior"], count=10)


@pytest.mark.parametrize("options, expected", [
    ({"families": ["edge-neer"]}, "unknown family 'edge-neer'.*edge-near"),
    ({"contract": "closed-rey"}, "contract: .*closed-rey"),
    ({"scene": "rooom"}, "scene: .*rooom"),
    ({"scalar": "float16"}, "expected 'float32' or 'float64'"),
    ({"count": 0}, "count is 1 or more"),
    ({"allow": {"false-hits": 0.1}}, "expected one of false-miss"),
])
def test_wrong_options_are_value_errors(options, expected):
    with pytest.raises(ValueError, match=expected):
        hairline.audit(exact, **{"count": 10, **options})


def test_an_exception_in_the_kernel_comes_out_with_the_case():
    def fails(origin, direction, a, b, c, t_min, t_max):
        if (np.abs(a) > 1e3).any():
            raise ZeroDivisionError("far away")
        return np.full(len(origin), np.nan)
    with pytest.raises(hairline.KernelError, match="ZeroDivisionError: far away; on origin=.*t_max=") as raised:
        hairline.audit(fails, families=["interior", "huge"], count=100)
    assert isinstance(raised.value.__cause__, ZeroDivisionError)
    assert np.abs(raised.value.case["a"]).max() > 1e3
    # A function that changes what it returns.
    calls = []
    def changes(origin, *rest):
        calls.append(1)
        # Twice it is asked about plain rays, at a triangle and beside it.
        return np.where(origin[:, 0] < 10, 1.0, np.nan) if len(calls) <= 2 else np.ones(len(origin), bool)
    with pytest.raises(ValueError, match="returned t before, and now does not"):
        hairline.audit(changes, families=["interior"], count=10)


def test_the_program_is_in_the_wheel():
    run = lambda *words: subprocess.run([sys.executable, "-m", "hairline", *words], capture_output=True, text=True)
    assert re.match(r"hairline \d", run("--version").stdout)
    assert run("audit", "--family", "nonsense").returncode == 2
    assert run("truth", "/nowhere.jsonl").returncode == 74
    assert run("check", "--kernel", "moller-trumbore", "--expect", "/nowhere.toml").returncode != 0
    found = hairline.advise("room", "moller-trumbore", count=200)
    assert [part["kernel"] for part in found["kernels"]] == ["moller-trumbore"]
    with pytest.raises(ValueError, match="morel"):
        hairline.advise("room", "morel")


def test_the_programs_libraries_run_too(tmp_path):
    """It starts itself again for that, which is not Python's own executable."""
    compiler = shutil.which("cc") or pytest.skip("there is no C compiler")
    library = tmp_path / "mine.so"
    source = ROOT / "examples/c/moller_trumbore.c"
    subprocess.run([compiler, "-O1", "-shared", "-fPIC", "-I", ROOT / "include", source, "-o", library, "-lm"], check=True)
    words = ["audit", "--kernel-lib", str(library), "--family", "interior", "-n", "100", "--scalar", "f32"]
    done = subprocess.run([sys.executable, "-m", "hairline", *words], capture_output=True, text=True)
    assert done.returncode == 0 and "100 cases in f32" in done.stdout, done.stderr


def test_the_notebook_runs():
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    notebook = nbformat.read(ROOT / "examples/python/notebook.ipynb", 4)
    nbformat.validate(notebook)
    # It is kept without outputs, so that its differences can be read.
    assert not any(cell.get("outputs") for cell in notebook.cells)
    nbclient.NotebookClient(notebook, timeout=120).execute()
    outputs = [out for cell in notebook.cells for out in cell.get("outputs", [])]
    data = {kind: text for out in outputs for kind, text in out.get("data", {}).items()}
    assert data["text/html"].startswith("<iframe srcdoc=") and data["image/svg+xml"].startswith("<svg")
    said = "".join(out["text"] for out in outputs if out.output_type == "stream")
    assert "my_kernel.py" in said and "recommended" in data["text/plain"], said


def test_a_finding_is_as_far_off_as_the_screen_says():
    audited = hairline.audit(kernels.moller_trumbore, count=300)
    told = re.search(r"1\. moller_trumbore.*?, f32: .*?([\d.e+-]+) edges.*?explain '(\S+)'", audited.summary(), re.DOTALL)
    distance = next(row["distance"] for row in audited.findings if row["case"] == told[2])
    assert distance == pytest.approx(float(told[1]), rel=0.06)


def test_a_case_is_the_kernels_arguments():
    for row in hairline.audit(kernels.moller_trumbore, families=["edge-near"], count=300).findings:
        case = hairline.case(row["case"])
        assert case["a"].shape == (1, 3) and case["a"].dtype == np.float32 and case["t_max"].shape == (1,)
        t, _, _ = kernels.moller_trumbore(**case)
        # The kernel is judged on the whole ray, and `truth` on the interval that it is given: by default the whole ray.
        ray = {name: case[name] for name in ("origin", "direction", "a", "b", "c")}
        assert (hairline.truth(**ray)["hit"] == np.isnan(t)).all() or row["finding"] == "wrong-value"
    assert hairline.case("shared-edge@3/f64/-/1/7")["c"].shape == (2, 3)
    for wrong in ("edge", "edge-near@2/f16/-/1/7", "edge-near@2/f32/-/1"):
        with pytest.raises(ValueError, match=re.escape(wrong)):
            hairline.case(wrong)


def test_a_map_is_the_programs_map(program, tmp_path):
    audited = hairline.audit(kernels.moller_trumbore, families=["edge-near"], count=300)
    case = audited.worst[0]["case"]
    pipe = shlex.join([sys.executable, "-m", "hairline.pipe", f"{kernels.__file__}:moller_trumbore"])
    program("map", case, "--kernel-cmd", pipe, "--quiet", "-o", str(tmp_path / "map.svg"))
    mine = audited.map(case)
    assert mine._repr_svg_() == str(mine) == (tmp_path / "map.svg").read_text()


def test_what_a_test_prints_runs_where_no_environment_is_active(tmp_path):
    """By hand: the interpreter by its path, the message of the failing test, and its command in a shell."""
    text = "import hairline, kernels\nhairline.assert_conforms(kernels.moller_trumbore, families=['edge-near'], count=300)\n"
    bare = {"PATH": "/usr/bin:/bin", "PYTHONPATH": str(pathlib.Path(kernels.__file__).parent)}
    done = subprocess.run([sys.executable, "-c", text], env=bare, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 1, done.stderr
    lines = done.stderr.splitlines()
    at, command = next((i, line) for i, line in enumerate(lines) if " explain " in line)
    # Below it the case in decimals; above all a way back into Python.
    assert json.loads(lines[at + 1])["scalar"] == "f32"
    assert "hairline.case(ID)" in lines[-1]
    shown = subprocess.run(["sh", "-c", command], env=bare, cwd=tmp_path, capture_output=True, text=True)
    assert shown.returncode == 0 and shown.stdout.startswith("moller_trumbore.py"), (command, shown.stderr)


def test_a_script_is_run_again_by_its_commands(tmp_path):
    """The function is in the script that audits it, and the script prints."""
    script = tmp_path / "mine.py"
    script.write_text(pathlib.Path(kernels.__file__).read_text() + "import hairline\n"
                      "print(hairline.audit(moller_trumbore, families=['edge-near'], count=300).worst[0]['command'])\n")
    done = subprocess.run([sys.executable, script], cwd=tmp_path, capture_output=True, text=True)
    assert "mine.py:moller_trumbore" in done.stdout, done.stderr
    shown = subprocess.run(["sh", "-c", done.stdout], cwd=tmp_path, capture_output=True, text=True)
    assert shown.returncode == 0 and shown.stdout.startswith("moller_trumbore.py"), (done.stdout, shown.stderr)


def test_what_a_kernel_promises_less_is_a_warning():
    def culling_line(origin, direction, a, b, c, t_min, t_max):
        hits = hairline.truth(origin, direction, a, b, c, t_min=-np.inf)
        return hits["hit"] & (hits["facing"] == hairline.Facing.FRONT)
    with pytest.warns(UserWarning, match="misses a plain triangle from the back and hits what lies behind the ray's start; "
                      "if that is meant, contract='closed-ray,sides=front,extent=line'"):
        audited = hairline.audit(culling_line, families=["behind", "interior"], count=100)
    assert audited.findings
    meant = "closed-ray,sides=front,extent=line"
    assert hairline.audit(culling_line, families=["behind", "interior"], count=100, contract=meant).conforms
