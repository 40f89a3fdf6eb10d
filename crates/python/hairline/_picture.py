"""Drawings for notebooks and files."""

import os
import pathlib
from typing import Union


class Picture(str):
    """A drawing as the text of an SVG, which a notebook shows."""

    def _repr_svg_(self) -> str:
        return str(self)

    def save(self, path: "Union[str, os.PathLike[str]]") -> None:
        """Writes it as an SVG file."""
        pathlib.Path(path).write_text(self, encoding="utf-8")
