"""The Rust part. The package's own functions check what goes in."""

from typing import Any, Callable, Sequence

import numpy as np
import numpy.typing as npt

def names() -> dict[str, list[str]]:
    """The names of the numbers in each field of a truth."""

def truth(columns: Sequence[npt.NDArray[Any]], count: int, in_f32: bool) -> npt.NDArray[np.uint8]:
    """Six bytes a case. `columns` are origin, direction, a, b, c, t_min, t_max: contiguous, of `count` cases or of one."""

def case(id: str) -> list[npt.NDArray[Any]]:
    """The arguments of a case by its id: origin, direction, a, b, c, t_min, t_max, a row for each triangle."""

def run(words: list[str], again: list[str]) -> int:
    """Runs the program on a command line, its name first, and returns its exit code."""

def audit(answers: Callable[..., Any], asked: dict[str, Any]) -> Audited:
    """Audits a function that returns hit, t, u, v."""

class Audited:
    def text(self, details: bool) -> str: ...
    def html(self) -> str: ...
    def json(self) -> str: ...
    def title(self) -> str: ...
    def conforms(self) -> bool: ...
    def distances(self) -> list[float | None]: ...
    def complaint(self) -> str: ...
    def explain(self, case: str) -> str: ...
    def map(self, case: str) -> str: ...
