# SPDX-License-Identifier: BSD-3-Clause
"""expected.toml of a case: its runs and what they must show (docs/how_to/expected_results.md)."""
import csv
import math
import re
import tomllib

# Factors to SI of the units that expectations are written in.
UNITS = {"": 1.0, "%": 0.01, "1": 1.0,
         "m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6,
         "s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9,
         "m/s": 1.0, "km/s": 1e3,
         "kg": 1.0, "g": 1e-3, "mg": 1e-6,
         "J": 1.0, "kJ": 1e3, "Pa": 1.0, "MPa": 1e6, "GPa": 1e9, "K": 1.0, "degree": math.pi / 180}
KINDS = ("within", "at_most", "at_least", "record")


class BadExpectation(Exception):
    """An expected.toml, or the files of a run, cannot be understood."""


def quantity(text, where):
    """Value in SI and the unit as written: "14 mm" -> (0.014, "mm")."""
    if isinstance(text, (int, float)) and not isinstance(text, bool):
        return float(text), ""
    match = re.fullmatch(r"\s*([-+0-9.eE]+)\s*(\S*)\s*", str(text))
    if not match or match[2] not in UNITS:
        raise BadExpectation(f"{where}: {text!r} is no number with one of the units {', '.join(filter(None, UNITS))}")
    return float(match[1]) * UNITS[match[2]], match[2]


class Expectation:
    """One quantity: what is measured, when, and what is expected of it."""

    KEYS = {"name", "measure", "time", "value", "tolerance", "kind", "source", "known", "unit"}

    def __init__(self, table, where):
        unknown = set(table) - self.KEYS
        missing = {"name", "measure", "source"} - set(table)
        if unknown or missing:
            raise BadExpectation(f"{where}: unknown {sorted(unknown)}, missing {sorted(missing)}")
        self.name, self.measure, self.source = table["name"], table["measure"], table["source"]
        self.known = table.get("known", "")
        self.kind = table.get("kind", "within")
        if self.kind not in KINDS:
            raise BadExpectation(f"{where}: kind {self.kind!r}, expected one of {', '.join(KINDS)}")
        self.time = quantity(table["time"], where)[0] if "time" in table else None
        if self.kind == "record":
            self.value, self.unit, self.tolerance = math.nan, table.get("unit", ""), 0.0
            if self.unit not in UNITS:
                raise BadExpectation(f"{where}: {self.name}: unit {self.unit!r}")
            return
        if "value" not in table:
            raise BadExpectation(f"{where}: {self.name}: value is missing")
        self.value, self.unit = quantity(table["value"], where)
        self.tolerance = 0.0
        if self.kind == "within":
            if "tolerance" not in table:
                raise BadExpectation(f"{where}: {self.name}: tolerance is missing")
            size, unit = quantity(table["tolerance"], where)
            self.tolerance = size * abs(self.value) if unit == "%" and self.unit != "%" else size

    def holds(self, measured):
        """Whether a measured value meets the expectation; None if it is only recorded."""
        if self.kind == "record":
            return None
        if not math.isfinite(measured):
            return False
        if self.kind == "at_most":
            return measured <= self.value
        if self.kind == "at_least":
            return measured >= self.value
        return abs(measured - self.value) <= self.tolerance


class RunOfCase:
    """One run of a case: changes of the input, options of the analysis, expectations."""

    def __init__(self, table, case, where):
        unknown = set(table) - {"name", "title", "set", "analyse", "quantity", "cell_size"}
        if unknown or "name" not in table:
            raise BadExpectation(f"{where}: a run with the unknown keys {sorted(unknown)} or without a name")
        self.name, self.title = table["name"], table.get("title", "")
        self.set, self.analyse = table.get("set", []), table.get("analyse", [])
        self.cell_size = table.get("cell_size", case.cell_size)
        self.expectations = [Expectation(q, f"{where}, run {self.name}") for q in table.get("quantity", [])]
        self.expectations += case.common

    def assignments(self, resolution):
        if resolution not in self.cell_size:
            raise BadExpectation(f"run {self.name}: no cell size for {resolution!r}: {', '.join(self.cell_size)}")
        return [f"domain.cell_size={self.cell_size[resolution]}", *self.set]


class Case:
    """A folder of cases/ with its expected.toml."""

    def __init__(self, path):
        self.name, self.file = path.parent.name, path.parent / "case.toml"
        try:
            table = tomllib.loads(path.read_text(encoding="utf-8"))
        except tomllib.TOMLDecodeError as error:
            raise BadExpectation(f"{path}: {error}") from None
        unknown = set(table) - {"title", "cell_size", "run", "quantity"}
        if unknown or "cell_size" not in table or "run" not in table:
            raise BadExpectation(f"{path}: unknown keys {sorted(unknown)}; cell_size and [[run]] are needed")
        self.title = table.get("title", self.name)
        self.cell_size = table["cell_size"]
        self.resolutions = list(self.cell_size)
        self.common = [Expectation(q, str(path)) for q in table.get("quantity", [])]
        self.runs = [RunOfCase(run, self, str(path)) for run in table["run"]]


class Measures:
    """What `whipple analyse` wrote of a run: quantities.csv, and series.csv for values at a time."""

    def __init__(self, folder):
        self.folder = folder
        self.single = {row["quantity"]: float(row["value"]) for row in self._rows("quantities.csv")}
        for row in self._rows("bodies.csv"):
            body, part = row["body part"].rsplit(" ", 1)
            self.single[f"mass.{body}.{part}"] = float(row["mass [kg]"])
            if "failed_fraction [1]" in row:
                self.single[f"failed_fraction.{body}.{part}"] = float(row["failed_fraction [1]"])
        self.series = {}
        rows = self._rows("series.csv")
        for head in rows[0] if rows else []:
            self.series[head.split(" [")[0]] = [float(row[head]) for row in rows]

    def _rows(self, name):
        path = self.folder / "report" / name
        if not path.is_file():
            raise BadExpectation(f"{path} is missing: run `whipple analyse {self.folder}`")
        with path.open(newline="") as stream:
            return list(csv.DictReader(stream))

    def value(self, expectation):
        """At a time: linear between the snapshots. NaN if there is no such measure or time."""
        if expectation.time is None:
            return self.single.get(expectation.measure, math.nan)
        times, values = self.series.get("time", []), self.series.get(expectation.measure, [])
        for t0, t1, v0, v1 in zip(times, times[1:], values, values[1:]):
            if t0 <= expectation.time <= t1:
                return v0 + (v1 - v0) * (expectation.time - t0) / (t1 - t0)
        # The last snapshot may fall short of the end of the run by round-off.
        if times and abs(times[-1] - expectation.time) < 1e-6 * expectation.time:
            return values[-1]
        return math.nan
