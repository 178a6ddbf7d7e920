# SPDX-License-Identifier: BSD-3-Clause
"""expected.toml of a case: its runs and what they must show (docs/manual/expected_results.md)."""
import math
import re
import tomllib

# Factors to SI of the units that expectations are written in.
UNITS = {"": 1.0, "%": 0.01, "1": 1.0,
         "m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6,
         "s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9,
         "m/s": 1.0, "km/s": 1e3,
         "kg": 1.0, "g": 1e-3, "mg": 1e-6,
         "J": 1.0, "kJ": 1e3, "N": 1.0, "kN": 1e3, "MN": 1e6, "Pa": 1.0, "MPa": 1e6, "GPa": 1e9, "K": 1.0, "degree": math.pi / 180}
# The kinds of these units: a length is no time.
LENGTH, TIME, SPEED, NUMBER = "a length", "a time", "a speed", "a number"
KIND_OF_UNIT = {"": NUMBER, "%": NUMBER, "1": NUMBER,
                **dict.fromkeys(("m", "cm", "mm", "um"), LENGTH), **dict.fromkeys(("s", "ms", "us", "ns"), TIME),
                **dict.fromkeys(("m/s", "km/s"), SPEED), **dict.fromkeys(("kg", "g", "mg"), "a mass"),
                **dict.fromkeys(("J", "kJ"), "an energy"), **dict.fromkeys(("N", "kN", "MN"), "a force"), **dict.fromkeys(("Pa", "MPa", "GPa"), "a pressure"),
                "K": "a temperature", "degree": "an angle"}
KINDS = ("within", "at_most", "at_least", "record")
# What an expected value comes from. Identities are true by construction and counted apart from physics.
CLASSES = ("experiment", "exact", "other code", "record", "identity")
RESOLUTIONS = ("coarse", "normal", "fine")


class BadExpectation(Exception):
    """An expected.toml, or the files of a run, cannot be understood."""


def quantity(text, where, kind=None):
    """Value in SI and the unit as written: "14 mm" -> (0.014, "mm"). With a kind, units of others are refused but for 0."""
    value, unit = parsed(text, where)
    if not math.isfinite(value):
        raise BadExpectation(f"{where}: {text!r} is not finite")
    if kind is not None and value != 0.0 and KIND_OF_UNIT[unit] != kind:
        units = ", ".join(name or "none" for name, of in KIND_OF_UNIT.items() if of == kind)
        raise BadExpectation(f"{where}: {text!r} is {KIND_OF_UNIT[unit]}, expected {kind} (units: {units})")
    return value, unit


def parsed(text, where):
    """Value in SI and the unit as written, whatever its kind."""
    if isinstance(text, (int, float)) and not isinstance(text, bool):
        return float(text), ""
    match = re.fullmatch(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\S*)\s*", str(text))
    if not match or match[2] not in UNITS:
        raise BadExpectation(f"{where}: {text!r} is no number with one of the units {', '.join(filter(None, UNITS))}")
    return float(match[1]) * UNITS[match[2]], match[2]


def value_of(text):
    """What VALUE of KEY=VALUE stands for: TOML, else a text."""
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        return text


def apply(table, assignment):
    """Sets KEY=VALUE in the table of a case, as `whipple run --set` does; numbers in the key count bodies."""
    key, separator, text = assignment.partition("=")
    if not separator:
        raise BadExpectation(f"{assignment!r} is no KEY=VALUE")
    *way, last = key.split(".")
    for part in way:
        try:
            table = table[int(part)] if isinstance(table, list) else table.setdefault(part, {})
        except (IndexError, ValueError):
            raise BadExpectation(f"{assignment!r}: there is no {part!r}") from None
    table[last] = value_of(text)


class Expectation:
    """One quantity: what is measured, when, and what is expected of it."""

    # Keys that belong to the measures of one kind, and to these always.
    OF_KIND = {"place": ("wall_speed.", "run_distance.", "peak_stress.", "shear_strength.", "height."),
               "travel": ("wall_speed.", "shear_strength.", "shear_stroke."), "table": ("profile_error.", "history_error.", "change_error."),
               "fraction": ("jet_speed.", "jet_gap.", "reach."), "speed": ("jet_fraction.",)}
    KEYS = {"name", "measure", "time", *OF_KIND, "value", "tolerance", "kind", "source", "known", "unit", "class"}

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
        self.origin = table.get("class", "record" if self.kind == "record" else "")
        if self.origin not in CLASSES or (self.origin == "record") != (self.kind == "record"):
            raise BadExpectation(f"{where}: {self.name}: class {self.origin!r} with kind {self.kind!r}, "
                                 f"expected one of {', '.join(CLASSES)}")
        self.time, self.place, self.travel, self.speed, self.fraction = (
            quantity(table[key], f"{where}: {self.name}: {key}", kind)[0] if key in table else None
            for key, kind in (("time", TIME), ("place", LENGTH), ("travel", LENGTH), ("speed", SPEED), ("fraction", NUMBER)))
        self.table = table.get("table")  # file beside expected.toml
        for key, kinds in self.OF_KIND.items():
            if (key in table) != self.measure.startswith(kinds):
                names = " and ".join(f"{kind}NAME" for kind in kinds)
                raise BadExpectation(f"{where}: {self.name}: measures {names}, and no others, take {key!r}")
        if self.speed is not None and self.time is None:
            raise BadExpectation(f"{where}: {self.name}: time is missing, from which on mass of the jet is counted")
        if self.kind == "record":
            self.value, self.unit, self.tolerance = math.nan, table.get("unit", ""), 0.0
            if self.unit not in UNITS:
                raise BadExpectation(f"{where}: {self.name}: unit {self.unit!r}")
            return
        if "value" not in table:
            raise BadExpectation(f"{where}: {self.name}: value is missing")
        self.value, self.unit = quantity(table["value"], f"{where}: {self.name}: value")
        self.tolerance = 0.0
        if self.kind == "within":
            if "tolerance" not in table:
                raise BadExpectation(f"{where}: {self.name}: tolerance is missing")
            place = f"{where}: {self.name}: tolerance"
            size, unit = quantity(table["tolerance"], place)
            relative = unit == "%" and self.unit != "%"
            if size < 0.0:
                raise BadExpectation(f"{place}: {table['tolerance']!r} is negative")
            if not relative and (self.unit or self.value != 0.0):
                quantity(table["tolerance"], place, KIND_OF_UNIT[self.unit])
            self.tolerance = size * abs(self.value) if relative else size

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
    """One run of a case: changes of the input, options of the analysis, expectations.

    headline: three grids, not two. sensitivity: shows what another choice does; counts in no summary and may change the
    numerical parameters. input: runs that bracket what is not known of the input, for U_input. decided_by: the run of the
    same experiment with finer cells, whose line stands in the summary instead. band: its own [band]
    in place of the case's. like: an earlier run whose changes,
    options, cell sizes and expectations this one begins with (`begun_like`).
    """

    KEYS = {"name", "title", "set", "set_at", "analyse", "quantity", "cell_size", "headline", "sensitivity", "input",
            "decided_by", "like", "band"}

    def __init__(self, table, case, where):
        unknown = set(table) - self.KEYS
        if unknown or "name" not in table:
            raise BadExpectation(f"{where}: a run with the unknown keys {sorted(unknown)} or without a name")
        self.case = case
        self.name, self.title = table["name"], table.get("title", "")
        self.set, self.analyse = table.get("set", []), table.get("analyse", [])
        self.set_at = {**case.set_at, **table.get("set_at", {})}
        self.cell_size = table.get("cell_size", case.cell_size)
        for key, given in (("cell_size", self.cell_size), ("set_at", self.set_at)):
            if others := sorted(set(given) - set(RESOLUTIONS)):
                raise BadExpectation(f"{where}: run {self.name}: {key} of {others}, expected {', '.join(RESOLUTIONS)}")
        self.headline, self.sensitivity = table.get("headline", False), table.get("sensitivity", False)
        self.band = Band(table["band"], where) if "band" in table else case.band
        self.input, self.decided_by = table.get("input", []), table.get("decided_by", "")
        self.expectations = [Expectation(q, f"{where}, run {self.name}") for q in table.get("quantity", [])]
        self.expectations += case.common
        for expectation in self.expectations:
            if expectation.table is not None:
                expectation.table = case.path.parent / expectation.table

    def cells(self, resolution):
        """Cell size in metres."""
        if resolution not in self.cell_size:
            raise BadExpectation(f"run {self.name}: no cell size for {resolution!r}: {', '.join(self.cell_size)}")
        return quantity(self.cell_size[resolution], f"run {self.name}: cell_size", LENGTH)[0]

    def grids(self):
        """The resolutions of the grid study, coarse first: three of a headline, two of others; each cell size once."""
        found = {}
        for resolution in RESOLUTIONS if self.headline else RESOLUTIONS[:2]:
            if resolution in self.cell_size:
                found[self.cells(resolution)] = resolution
        return [resolution for _, resolution in sorted(found.items(), reverse=True)]

    def assignments(self, resolution):
        self.cells(resolution)
        return [f"domain.cell_size={self.cell_size[resolution]}", *self.set, *self.set_at.get(resolution, [])]

    def resolved(self, resolution="normal"):
        """The table of the case with the assignments of the run."""
        table = tomllib.loads(self.case.file.read_text(encoding="utf-8"))
        for assignment in self.assignments(resolution):
            apply(table, assignment)
        return table


def begun_like(table, earlier, where):
    """The table of a run with what its `like` has: the changes before its own, and whatever else it does not state.

    earlier: tables by name. Its name, title, place in summaries and brackets of the input are each run's own.
    """
    if "like" not in table:
        return table
    if table["like"] not in earlier:
        raise BadExpectation(f"{where}: run {table.get('name')}: like {table['like']!r} names no earlier run: {', '.join(earlier)}")
    other = earlier[table["like"]]
    shared = {key: other[key] for key in ("set_at", "analyse", "quantity", "cell_size", "band") if key in other}
    return {**shared, **table, "set": other.get("set", []) + table.get("set", [])}


class Band:
    """[band] of a case: three positions of the lattice, the velocity of a moving frame, or why there are none."""

    def __init__(self, table, where):
        unknown = set(table) - {"offsets", "frame", "no_offsets", "no_frame"}
        if unknown:
            raise BadExpectation(f"{where}: band with the unknown keys {sorted(unknown)}")
        self.offsets, self.frame = table.get("offsets", []), table.get("frame")
        self.no_offsets, self.no_frame = table.get("no_offsets", ""), table.get("no_frame", "")
        if bool(self.offsets) == bool(self.no_offsets) or bool(self.frame) == bool(self.no_frame):
            raise BadExpectation(f"{where}: band needs offsets or no_offsets, and frame or no_frame")
        if self.offsets and len(self.offsets) != 3:
            raise BadExpectation(f"{where}: band has {len(self.offsets)} offsets, expected 3")


class Case:
    """A folder of cases/ with its expected.toml."""

    KEYS = {"title", "cell_size", "set_at", "run", "quantity", "band", "overrides"}

    def __init__(self, path):
        self.name, self.file, self.path = path.parent.name, path.parent / "case.toml", path
        try:
            table = tomllib.loads(path.read_text(encoding="utf-8"))
        except tomllib.TOMLDecodeError as error:
            raise BadExpectation(f"{path}: {error}") from None
        unknown = set(table) - self.KEYS
        if unknown or "cell_size" not in table or "run" not in table:
            raise BadExpectation(f"{path}: unknown keys {sorted(unknown)}; cell_size and [[run]] are needed")
        self.title = table.get("title", self.name)
        self.cell_size, self.set_at = table["cell_size"], table.get("set_at", {})
        self.resolutions = list(self.cell_size)
        self.overrides = table.get("overrides", {})  # numerical parameter -> reason
        self.band = Band(table["band"], str(path)) if "band" in table else None
        self.common = [Expectation(q, str(path)) for q in table.get("quantity", [])]
        tables = {}
        for run in table["run"]:
            if run.get("name") in tables:
                raise BadExpectation(f"{path}: two runs are named {run['name']!r}")
            tables[run.get("name", "")] = begun_like(run, tables, str(path))
        self.runs = [RunOfCase(run, self, str(path)) for run in tables.values()]
        for run in self.runs:
            for key, named in (("input", set(run.input)), ("decided_by", {run.decided_by} - {""})):
                if named - set(tables):
                    raise BadExpectation(f"{path}: run {run.name}: {key} names {sorted(named - set(tables))}, no runs")

    def run_of(self, name):
        return next(run for run in self.runs if run.name == name)
