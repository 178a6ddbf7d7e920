# SPDX-License-Identifier: BSD-3-Clause
"""Folder of a run (docs/manual/output.md): its text, history, index of snapshots and analysis."""
import json
import os
import pathlib
import tomllib

from report.analysis import Analysis
from report.errors import NotARun
from report.history import History


class Run:
    """Holds what the folder of a run says. `output`: folder of the report, which holds analysis.h5.

    Raises NotARun if the folder is not that of a run.
    """

    def __init__(self, folder: str | pathlib.Path, output: str | pathlib.Path | None = None):
        self.folder = pathlib.Path(folder)
        if not self.folder.is_dir():
            raise NotARun(f"{folder}: there is no such folder")
        path = self.folder / "run.toml"
        if not path.is_file():
            raise NotARun(f"{folder}: is not the folder of a run: it contains no run.toml")
        self.output = pathlib.Path(output) if output else self.folder / "report"
        self.input_text = path.read_text(encoding="utf-8", errors="replace")
        try:
            self.input = tomllib.loads(self.input_text)  # to be shown
        except tomllib.TOMLDecodeError as error:
            raise NotARun(f"{path}: {error}") from None
        self.history = History(self.folder / "history.csv")
        self.columns = self._read_columns()
        self.entries = self._read_index()
        if not self.entries and not self.history.columns:
            raise NotARun(f"{folder}: the run has neither snapshots nor a history.csv yet")
        # A run without snapshots was not measured.
        self.analysis = Analysis(self.output / "analysis.h5") if self.entries else None

    @property
    def goes_on(self) -> bool:
        """Tells whether a process on this machine writes the run: whether one holds the lock of the folder."""
        try:
            lock = (self.folder / ".lock").stat()
            held = pathlib.Path("/proc/locks").read_text(encoding="ascii")
        except OSError:
            return False
        file = f"{os.major(lock.st_dev):02x}:{os.minor(lock.st_dev):02x}:{lock.st_ino}"
        return any(line.split()[1:2] == ["FLOCK"] and file in line.split() for line in held.splitlines())

    @property
    def ended_by(self) -> str:
        """Returns the condition of the case that ended the run (status.json); empty if none did."""
        try:
            status = json.loads((self.folder / "status.json").read_text(encoding="utf-8"))
            return str(status.get("ended_by", ""))
        except (OSError, ValueError, AttributeError):
            return ""

    def _read_columns(self) -> list[dict[str, str]]:
        """Reads what the columns of history.csv mean (docs/manual/output.md); nothing of a run that does not say it."""
        path = self.folder / "columns.json"
        if not path.is_file():
            return []
        try:
            columns = json.loads(path.read_text(encoding="utf-8"))
            if not all(isinstance(column["name"], str) for column in columns):
                raise TypeError("names are no texts")
            return columns
        except (ValueError, KeyError, TypeError) as error:
            raise NotARun(f"{path}: does not describe the columns of history.csv: {error}") from None

    def _read_index(self):
        indices = sorted(self.folder.glob("*.particles.hdf.series"))
        if not indices:
            return []
        if len(indices) > 1:
            raise NotARun(f"{self.folder}: more than one series: {', '.join(p.name for p in indices)}")
        try:
            files = json.loads(indices[0].read_text())["files"]
            return [(self.folder / entry["name"], float(entry["time"])) for entry in files]
        except (ValueError, KeyError, TypeError) as error:
            raise NotARun(f"{indices[0]}: is not the index of a series: {error}") from None

    @property
    def title(self) -> str:
        """Title of the case, the name of the folder if it has none."""
        return (self.analysis.title if self.analysis else str(self.input.get("title", ""))) or self.folder.name

    def body_names(self, at_least: int) -> list[str]:
        """Returns the names of the bodies, of so many at least: those that occur without a name get one."""
        names = self.analysis.body_names if self.analysis else []
        return names + [f"body {i}" for i in range(len(names), max(at_least, len(names), 1))]

    @property
    def symmetry_planes(self) -> dict[int, float]:
        """Position (m) of the planes that cut the model out of the full problem, by the number of their axis."""
        return self.analysis.geometry.planes if self.analysis else {}

    @property
    def multiplicity(self) -> int:
        """Number of copies of the model that make the full problem: 4 for a quarter model."""
        return self.analysis.geometry.copies if self.analysis else 1
