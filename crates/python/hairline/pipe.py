"""A function in Python for every command of the program, over a pipe (docs/protocol.md):

    hairline explain 'edge-near@2/f32/-/1/7' --kernel-cmd 'python3 -m hairline.pipe my_module:kernel closed-ray'

Instead of a module's name it may be a file: `tests/my_kernel.py:kernel`. The function is as `hairline.audit` takes it;
`--scalar-function` says that it takes one case at a time.
"""

import importlib
import importlib.util
import operator
import struct
import sys
from typing import Any

import numpy as np

from ._kernel import Answers


def load(place: str) -> Any:
    """The function of `module:name` or `file.py:name`."""
    module, _, name = place.rpartition(":")
    if module.endswith(".py"):
        spec = importlib.util.spec_from_file_location("hairline_kernel", module)
        loaded = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(loaded)
    else:
        sys.path.insert(0, "")
        loaded = importlib.import_module(module)
    return operator.attrgetter(name)(loaded)


def read(size: int) -> bytes:
    """Exactly so many bytes; none at the end of the input."""
    data = sys.stdin.buffer.read(size)
    if 0 < len(data) < size:
        sys.exit("the input ends within a batch")
    return data


def serve(kernel: Any, contract: str, vectorized: bool, sink: Any) -> None:
    """Answers batches until there are no more."""
    answers = {bits: Answers(kernel, vectorized, f"f{bits // 8}") for bits in (32, 64)}
    t, uv = answers[32].gives
    gives = f"gives {'t' * t} {'uv' * uv}\n" if t or uv else ""
    hello = f"hairline-kernel 1\nname {kernel.__name__}.py\nsource a function in Python\nscalars f32 f64\ncontract {contract}\n{gives}encoding binary\nready\n"
    sink.write(hello.encode())
    sink.flush()
    while head := read(16):
        _, bits, count, epsilons = struct.unpack("<4s3I", head)
        number = np.dtype(f"<f{bits // 8}")
        read(epsilons * number.itemsize)
        cases = np.frombuffer(read(count * 17 * number.itemsize), number).reshape(count, 17)
        vectors = [cases[:, i : i + 3].copy() for i in range(0, 15, 3)]
        found = answers[bits](*vectors, cases[:, 15].copy(), cases[:, 16].copy())
        verdicts = np.zeros(count, [("hit", "<i4"), ("facing", "<i4"), ("t", number), ("u", number), ("v", number)])
        for name, column in zip(("hit", "t", "u", "v"), found):
            verdicts[name] = column
        sink.write(struct.pack("<4sI", b"HLA1", count) + verdicts.tobytes())
        sink.flush()


if __name__ == "__main__":
    words = [word for word in sys.argv[1:] if word != "--scalar-function"]
    # What the module or the function prints is not an answer.
    answered, sys.stdout = sys.stdout.buffer, sys.stderr
    serve(load(words[0]), (words[1:] or ["closed-ray"])[0], len(words) == len(sys.argv) - 1, answered)
