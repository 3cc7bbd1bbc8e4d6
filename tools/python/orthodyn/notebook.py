"""HTML pages in a notebook."""
from __future__ import annotations

import html
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class Page:
    """An HTML page that a notebook shows; elsewhere open `path` in a browser."""
    path: Path
    height: int
    shown: Any = None  # keeps the results, and so the temporary folders that contain the page

    def _repr_html_(self) -> str:
        page = html.escape(self.path.read_text(encoding="utf-8"), quote=True)
        return f'<iframe srcdoc="{page}" width="100%" height="{self.height}" style="border:0"></iframe>'

    def __repr__(self) -> str:
        return str(self.path)
