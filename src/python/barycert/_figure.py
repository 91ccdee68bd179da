"""Pictures, as notebooks show them and files hold them."""

from __future__ import annotations

import base64
import os
import tempfile
from typing import Callable, Union


class Picture:
    """A picture of a mesh, or a plot. Notebooks show it; `save` writes it. Fields are drawn as they are at that time."""

    def __init__(self, draw: Callable[[str], None]) -> None:
        self._draw = draw
        self._png = self._bytes(".png")

    def save(self, path: Union[str, os.PathLike]) -> None:
        """Writes .png, .svg or .pdf, of a mesh also .html: a page on which it turns. Error: the file cannot be written."""
        self._draw(os.fspath(path))

    def _bytes(self, suffix: str) -> bytes:
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "picture" + suffix)
            self._draw(path)
            with open(path, "rb") as file:
                return file.read()

    def _repr_png_(self) -> bytes:
        return self._png

    def _repr_svg_(self) -> str:
        return self._bytes(".svg").decode()

    def _repr_html_(self) -> str:
        return f'<img src="data:image/png;base64,{base64.b64encode(self._png).decode()}"/>'
