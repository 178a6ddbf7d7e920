# SPDX-License-Identifier: BSD-3-Clause
"""Tables over time that the solver writes: history.csv and gauges.csv."""
import csv
import pathlib
import re

import numpy as np

from report.errors import NotARun


class History:
    """Holds the columns of a CSV file by their names without unit. Columns that a run does not write are absent."""

    def __init__(self, path: pathlib.Path):
        self.columns = {}
        self.units = {}
        if not path.is_file():
            return
        with path.open(newline="") as stream:
            rows = list(csv.reader(stream))
        if not rows:
            return
        data = [row for row in rows[1:] if len(row) == len(rows[0])]  # a row in the making may be incomplete
        try:
            values = np.array([[float(cell) for cell in row] for row in data]).reshape(len(data), len(rows[0]))
        except ValueError as error:
            raise NotARun(f"{path}: {error}") from None
        for i, head in enumerate(rows[0]):
            match = re.fullmatch(r"(.*?)(?: \[([^\]]*)\])?", head)
            self.columns[match[1]] = values[:, i]
            self.units[match[1]] = match[2] or ""

    def __contains__(self, name: str) -> bool:
        return name in self.columns and len(self.columns[name]) > 0

    def __getitem__(self, name: str) -> np.ndarray:
        return self.columns[name]

    def last(self, name: str) -> float | None:
        """Returns the last value of a column, None if there is none."""
        return float(self.columns[name][-1]) if name in self else None
