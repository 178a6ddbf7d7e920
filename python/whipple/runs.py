# SPDX-License-Identifier: BSD-3-Clause
"""Cases, runs and their results for Python (docs/manual/python.md). The program `whipple` computes, as child processes;
this module reads its files. All numbers are SI."""
from __future__ import annotations

import contextlib
import csv
import json
import os
import pathlib
import shutil
import subprocess
import time
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

Path = Union[str, os.PathLike]
Array = NDArray[np.float64]


def program() -> str:
    """Return the path of the program: $WHIPPLE_PROGRAM, else that beside this package, else `whipple` of the search path."""
    named = os.environ.get("WHIPPLE_PROGRAM")
    if named:
        return named
    above = pathlib.Path(__file__).resolve().parents
    for prefix in (above[2], above[min(4, len(above) - 1)]):  # build/release/python/whipple, PREFIX/lib/python3/...
        if (prefix / "bin" / "whipple").is_file():
            return str(prefix / "bin" / "whipple")
    found = shutil.which("whipple")
    if found is None:
        raise FileNotFoundError("the program whipple is neither beside this package nor in PATH: set WHIPPLE_PROGRAM")
    return found


class RunError(RuntimeError):
    """Report a program that failed: `code` is its exit code (2 input, 3 physics or resources, 4 defect; 1 if it is not known,
    because another process computed the run)."""

    def __init__(self, message: str, code: int):
        super().__init__(message)
        self.code = code


@dataclass(frozen=True)
class Fault:
    """Hold a fault of a case: where it is, and what is expected there."""
    file: str
    line: int
    column: int
    key: str
    text: str


class CaseError(ValueError):
    """Report a case that cannot run, with its `faults`."""

    def __init__(self, faults: list[Fault]):
        super().__init__("\n".join(f"{f.file}:{f.line}: {f.key}: {f.text}" for f in faults))
        self.faults = faults


def _call(*arguments: Any, accepted: tuple[int, ...] = (0,)) -> subprocess.CompletedProcess:
    done = subprocess.run([program(), *map(str, arguments)], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          check=False)
    if done.returncode not in accepted:
        raise RunError(done.stderr.strip() or done.stdout.strip(), done.returncode)
    return done


class Case:
    """A case file with changed keys. The file itself stays as it is; `write` makes a changed copy."""

    def __init__(self, file: Path, changes: Optional[Mapping[str, Any]] = None):
        """Read a case. Changes are keys and values as of `whipple run --set`: {"domain.cell_size": "0.5 mm"}."""
        self.file = pathlib.Path(file)
        with self.file.open("rb") as stream:
            self._keys = tomllib.load(stream)
        self.changes: dict[str, str] = {}
        for key, value in (changes or {}).items():
            self[key] = value

    def __getitem__(self, key: str) -> Any:
        """Return the value of a key as changed or as in the file; KeyError if it has none there (a default)."""
        if key in self.changes:
            return self.changes[key]
        node: Any = self._keys
        for part in key.split("."):
            try:
                node = node[int(part)] if isinstance(node, list) else node[part]
            except (LookupError, ValueError, TypeError):
                raise KeyError(key) from None
        return node

    def __setitem__(self, key: str, value: Any) -> None:
        """Change a key. Lists and texts are written as in a case file, numbers as they are."""
        self.changes[key] = value if isinstance(value, str) else json.dumps(value)

    def _set(self) -> list[str]:
        return [word for key, value in self.changes.items() for word in ("--set", f"{key}={value}")]

    def check(self, forecast: bool = False) -> dict[str, Any]:
        """Check the case and return what would run: cells, bodies, particles, memory (bytes), warnings; with `forecast`
        also steps and seconds as [least, most], from a measurement of a second. Raise CaseError with the faults."""
        brief = [] if forecast else ["--brief"]
        done = _call("check", self.file, "--json", *brief, *self._set(), accepted=(0, 2))
        try:
            found = json.loads(done.stdout)
        except json.JSONDecodeError:
            raise RunError(done.stderr.strip(), done.returncode) from None
        if found["faults"]:
            raise CaseError([Fault(**fault) for fault in found["faults"]])
        return found

    def faults(self) -> list[Fault]:
        """Return the faults of the case; empty if it can run."""
        try:
            self.check()
        except CaseError as error:
            return error.faults
        return []

    def write(self, file: Path) -> "Case":
        """Write the changed case into a new file, comments included, and return it. Materials named by a relative path are
        searched beside the new file. Raise FileExistsError if there is such a file."""
        with open(file, "x", encoding="utf-8") as stream:
            stream.write(self.file.read_text(encoding="utf-8"))
        try:
            if self.changes:
                _call("edit", file, *(f"{key}={value}" for key, value in self.changes.items()))
        except RunError:
            pathlib.Path(file).unlink()
            raise
        return Case(file)

    def start(self, folder: Path, threads: Optional[int] = None, ranks: Optional[int] = None) -> "Run":
        """Start the run in a new folder as a child process, and return it."""
        arguments = [program(), "run", str(self.file), "-o", str(folder), "--quiet", *self._set()]
        if threads is not None:
            arguments += ["--threads", str(threads)]
        if ranks is not None:
            arguments += ["--ranks", str(ranks)]
        return Run(folder, subprocess.Popen(arguments, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                            stderr=subprocess.PIPE, text=True))

    def run(self, folder: Path, threads: Optional[int] = None, ranks: Optional[int] = None) -> "Results":
        """Run the case to its end and return its results. Raise CaseError for a wrong case, RunError for a run that failed."""
        self.check()
        return self.start(folder, threads, ranks).wait()


class Run:
    """A run that is computed by a child process, or by any other process of this machine."""

    def __init__(self, folder: Path, process: Optional[subprocess.Popen] = None):
        """Watch the run of a folder."""
        self.folder = pathlib.Path(folder)
        self._process = process

    @property
    def status(self) -> Optional[dict[str, Any]]:
        """State, simulated time, step, end, seconds left and message; None before the first step."""
        if not (self.folder / "status.json").is_file():
            return None
        return json.loads(_call("status", self.folder, "--json", accepted=(0, 2)).stdout)[0]

    @property
    def is_running(self) -> bool:
        """Whether the process goes on."""
        if self._process is not None:
            return self._process.poll() is None
        status = self.status
        return status is not None and bool(status["goes_on"])

    def wait(self, timeout: Optional[float] = None) -> "Results":
        """Wait for the end and return the results. Raise TimeoutError, or RunError for a run that failed."""
        if self._process is None:
            deadline = None if timeout is None else time.monotonic() + timeout
            while self.is_running:
                if deadline is not None and time.monotonic() > deadline:
                    raise TimeoutError(f"{self.folder} still runs")
                time.sleep(0.1)
            status = self.status
            if status is not None and status["state"] != "done":
                code = 3 if status["state"] == "failed" else 1
                raise RunError(f"{self.folder} is {status['state']}: {status['message']}", code)
            return self.results
        try:
            message = self._process.communicate(timeout=timeout)[1]
        except subprocess.TimeoutExpired:
            raise TimeoutError(f"{self.folder} still runs") from None
        if self._process.returncode != 0:
            raise RunError(message.strip() or f"ended with code {self._process.returncode}", self._process.returncode)
        return self.results

    def rows(self, pause: float = 0.1) -> Iterator[dict[str, float]]:
        """Give the rows of history.csv as they are written, until the run ends."""
        file, seen = self.folder / "history.csv", 0
        while True:
            running = self.is_running
            if file.is_file():
                text = file.read_text(encoding="utf-8")
                lines = text[:text.rfind("\n") + 1].splitlines()  # the last one may be under way
                names = [name for name, _ in _heads(lines[0])] if lines else []
                for line in lines[1 + seen:]:
                    yield dict(zip(names, map(float, line.split(","))))
                seen = max(seen, len(lines) - 1)
            if not running:
                return
            time.sleep(pause)

    def steer(self, request: str, value: str = "") -> str:
        """Send a request (`whipple steer --help` lists them) and return the answer. Raise RunError if it is refused."""
        return _call("steer", self.folder, request, *([value] if value else [])).stdout.strip()

    def end(self) -> None:
        """Write a checkpoint and end the run after the step under way; `whipple run --restart` goes on."""
        if self._process is not None and self._process.poll() is None:
            self._process.terminate()
        elif self.is_running:
            self.steer("stop")
        with contextlib.suppress(RunError):  # the exit code of a run that was stopped
            self.wait()

    @property
    def results(self) -> "Results":
        """What the run has written so far."""
        return Results(self.folder)


def _heads(line: str) -> list[tuple[str, str]]:
    """Names and units of the columns of a table, "name [unit]"."""
    heads = []
    for cell in next(csv.reader([line])):
        name, _, unit = cell.partition(" [")
        heads.append((name, unit.removesuffix("]")))
    return heads


class Table(Mapping[str, Array]):
    """Columns by name, as numpy arrays; `units` holds their units, `meanings` their meanings where they are known."""

    def __init__(self, columns: dict[str, Any], units: dict[str, str], meanings: Optional[dict[str, str]] = None):
        """Hold columns of equal length."""
        self._columns, self.units, self.meanings = columns, units, meanings or {}

    def __getitem__(self, name: str) -> Array:
        """Return a column."""
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        """Go through the names."""
        return iter(self._columns)

    def __len__(self) -> int:
        """Return the number of columns."""
        return len(self._columns)

    def __repr__(self) -> str:
        """Return names and units."""
        return f"Table({', '.join(f'{name} [{self.units.get(name) or 1}]' for name in self)})"


def _read_csv(file: pathlib.Path) -> Table:
    lines = file.read_text(encoding="utf-8").splitlines()
    heads = _heads(lines[0])
    numbers = np.array([[float(cell) for cell in line.split(",")] for line in lines[1:]]).reshape(-1, len(heads))
    return Table({name: numbers[:, i] for i, (name, _) in enumerate(heads)}, dict(heads))


@dataclass(frozen=True)
class Quantity:
    """Hold a measured value (SI; NaN with the reason if nothing could be measured)."""
    value: float
    unit: str
    meaning: str
    reason: str = ""


class Results:
    """What a run has written, as numpy arrays with units."""

    def __init__(self, folder: Path):
        """Read the results of a run folder."""
        self.folder = pathlib.Path(folder)
        if not (self.folder / "run.toml").is_file():
            raise FileNotFoundError(f"{self.folder} is no folder of a run: it has no run.toml")

    @property
    def history(self) -> Table:
        """Energies, momentum, masses in the course of the run (history.csv)."""
        table = _read_csv(self.folder / "history.csv")
        described = json.loads((self.folder / "columns.json").read_text(encoding="utf-8"))
        table.meanings = {column["name"]: column["meaning"] for column in described}
        return table

    @property
    def gauges(self) -> Table:
        """Columns GAUGE.quantity in the course of the run (gauges.csv)."""
        return _read_csv(self.folder / "gauges.csv")

    def _snapshots(self) -> list[dict[str, Any]]:
        [index] = self.folder.glob("*.particles.hdf.series")
        return json.loads(index.read_text(encoding="utf-8"))["files"]

    @property
    def times(self) -> Array:
        """Times of the snapshots, s."""
        return np.array([entry["time"] for entry in self._snapshots()])

    def snapshot(self, number: int = -1) -> Table:
        """Return the particles of a snapshot, by default the last: `position` and all fields that were written."""
        import h5py
        with h5py.File(self.folder / self._snapshots()[number]["name"]) as file:
            root = file["VTKHDF"]
            columns = {"position": root["Points"][:]}
            units, meanings = {"position": "m"}, {"position": "position"}
            for name, data in root["PointData"].items():
                columns[name] = data[:]
                units[name], meanings[name] = data.attrs["unit"], data.attrs["meaning"]
        return Table(columns, units, meanings)

    def quantities(self, *options: str) -> dict[str, Quantity]:
        """Measure the run (`whipple analyse` with options such as "--witness", "200 mm") and return the final values."""
        found = json.loads(_call("analyse", self.folder, "--json", "--quiet", *options).stdout)
        return {name: Quantity(np.nan if q["value"] is None else q["value"], q["unit"], q["meaning"], q.get("reason", ""))
                for name, q in found.items()}

    def body(self, number: int, snapshot: int = -1) -> Table:
        """Return the particles of one body of a snapshot."""
        table = self.snapshot(snapshot)
        chosen = np.asarray(table["body"]) == number
        return Table({name: table[name][chosen] for name in table}, table.units, table.meanings)


class StudyResults:
    """Tables of a study: `points`, `bands`, `sensitivities`, `limits`, those that it has; numbers and words by column."""

    def __init__(self, study: Mapping[str, Any]):
        """Take the tables of study.json."""
        self.quantities: list[str] = study["quantities"]
        self.tables: dict[str, Table] = {}
        for name in ("points", "bands", "sensitivities", "limits"):
            if name not in study:
                continue
            rows, units = study[name]["rows"], study[name]["units"]
            columns: dict[str, Any] = {}
            for head in rows[0] if rows else []:
                cells = [row[head] for row in rows]
                columns[head] = (np.array([np.nan if cell is None else cell for cell in cells], dtype=float)
                                 if head in units else np.array(cells))
            self.tables[name] = Table(columns, units)

    def __getattr__(self, name: str) -> Table:
        """Return a table."""
        tables = self.__dict__.get("tables", {})
        if name not in tables:
            raise AttributeError(f"the study has no table {name!r}, but {', '.join(tables)}")
        return tables[name]


def sweep(study: Path, folder: Path, figures: bool = False) -> StudyResults:
    """Compute a study (`whipple sweep`) and return its tables. Interrupted, the same call goes on."""
    done = _call("sweep", study, "-o", folder, "--json", "--quiet", *([] if figures else ["--no-figures"]))
    return StudyResults(json.loads(done.stdout))


def materials() -> list[dict[str, str]]:
    """Return the material library: key, name, group, note and file of each material."""
    return json.loads(_call("materials", "--json").stdout)
