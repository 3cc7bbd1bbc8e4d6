"""Pages within a notebook."""
from __future__ import annotations

import html
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class Page:
    """A page that a notebook shows; anywhere else open `path` in a browser."""
    path: Path
    height: int
    shown: Any = None  # results whose folders hold it

    def _repr_html_(self) -> str:
        page = html.escape(self.path.read_text(encoding="utf-8"), quote=True)
        return f'<iframe srcdoc="{page}" width="100%" height="{self.height}" style="border:0"></iframe>'

    def __repr__(self) -> str:
        return str(self.path)
