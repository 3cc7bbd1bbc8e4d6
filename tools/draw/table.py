"""A CSV file with a header of names and units, `t [s],kinetic [J]`, as columns."""
import csv
import re
from dataclasses import dataclass

import numpy as np

from .errors import DrawError, unknown


@dataclass
class Column:
    name: str
    unit: str
    values: np.ndarray


class Table:
    def __init__(self, path):
        self.path = path
        if not path.is_file():
            raise DrawError(f"{path}: missing; add {path.stem} to the output of the scene")
        with path.open(newline="", encoding="utf-8", errors="replace") as stream:
            rows = [(number, row) for number, row in enumerate(csv.reader(stream), 1)
                    if row and not row[0].startswith("#")]
        if len(rows) < 2:
            raise DrawError(f"{path}: no rows below the header")
        header = [re.fullmatch(r"\s*(.*?)\s*(?:\[(.*)\])?\s*", cell).groups(default="") for cell in rows[0][1]]
        values = self._numbers(rows[1:], len(header))
        self.columns = {name: Column(name, unit, values[:, k]) for k, (name, unit) in enumerate(header)}

    def _numbers(self, rows, width):
        """The rows as numbers. Leaves out an incomplete last row, as a stopped run may leave it."""
        if len(rows[-1][1]) < width and len(rows) > 1:
            rows = rows[:-1]
        numbers = []
        for line, row in rows:
            if len(row) != width:
                raise DrawError(f"{self.path}:{line}: {len(row)} values where the header names {width}")
            try:
                numbers.append([float(cell) if cell.strip() else np.nan for cell in row])
            except ValueError as error:
                raise DrawError(f"{self.path}:{line}: {error}") from None
        return np.array(numbers)

    def __getitem__(self, name):
        if name not in self.columns:
            raise unknown(f"column in {self.path}", name, self.columns)
        return self.columns[name]

    def __contains__(self, name):
        return name in self.columns

    @property
    def axis(self):
        """The first column: the time, or the load factor of a static analysis."""
        return next(iter(self.columns.values()))

    def others(self):
        """All columns except the first."""
        return list(self.columns.values())[1:]
