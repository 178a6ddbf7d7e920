# SPDX-License-Identifier: BSD-3-Clause
"""The one set of numerical parameters, and every case that departs from it (docs/manual/expected_results.md)."""
import hashlib
import json
import re
import tomllib

from studies.validation.cases import ROOT, BadExpectation, apply

# Sections of a case whose keys are numerical, less those that say what happens rather than how it is computed.
SECTIONS = ("time", "transfer", "splitting", "artificial_viscosity", "dissipation", "contact",
            "body.artificial_viscosity", "body.discretization", "body.conversion")
PHYSICAL = {"time.end", "body.discretization.mesh", "body.discretization.mesh_unit", "body.discretization.group",
            "body.discretization.bar_diameter", "body.discretization.bar_failure_strain"}
MORE = {"output.maximum_energy_error", "body.equation_of_state", "body.table_error"}


def defaults(reference=ROOT / "docs" / "manual" / "input_reference.md"):
    """Default of every numerical parameter by its key ("time.courant"), as the page writes it."""
    text = reference.read_text(encoding="utf-8")
    page = text[text.index("## Case files"):]
    page = page[:page.index("\n## ", 10)]
    found, section, columns = {}, "", []
    for line in page.split("\n"):
        if heading := re.match(r"\[\[?([a-z_.]+)\]?\]", line):
            section, columns = heading[1], []
        elif line.startswith("  key "):
            columns = [match.start() for match in re.finditer(r"\S+", line)]
            head = re.findall(r"\S+", line)
        elif columns and re.match(r"  [a-z_0-9]+ ", line):
            # Values hold single spaces only; two or more end a column.
            cells = [line[columns[i]:columns[i + 1] if i + 1 < len(columns) else None].strip() for i in range(len(columns))]
            key = f"{section}.{cells[0]}" if section else cells[0]
            if (section in SECTIONS and key not in PHYSICAL) or key in MORE:
                found[key] = cells[head.index("default")]
    if not all(f"{section}." in "".join(found) for section in SECTIONS):
        raise BadExpectation(f"{reference}: sections of the case are missing")
    return found


def digest(parameters):
    return hashlib.sha256(json.dumps(parameters, sort_keys=True).encode()).hexdigest()[:16]


# Keys that came in later than stored runs, by the digest of the set without them: the values of all others are the same.
ADDED = {}


def added_since(name, parameters):
    """Keys that the parameters have and the set of a digest had not, all others being equal; None if others differ, too."""
    for keys in ((), ADDED.get(name, ())):
        if digest({key: value for key, value in parameters.items() if key not in keys}) == name:
            return keys
    return None


def flat(table, prefix=""):
    """Keys with dots and values of a case; bodies as body.0, body.1."""
    for key, value in table.items():
        if isinstance(value, dict):
            yield from flat(value, f"{prefix}{key}.")
        elif isinstance(value, list) and value and all(isinstance(v, dict) for v in value):
            for i, entry in enumerate(value):
                yield from flat(entry, f"{prefix}{key}.{i}.")
        else:
            yield f"{prefix}{key}", value


def general(key):
    """body.0.conversion.failed -> body.conversion.failed"""
    return re.sub(r"^body\.\d+\.", "body.", key)


def overrides(table, parameters):
    """Numerical parameters that a case gives: key of the case -> value. Those that repeat the default count, too."""
    return {key: value for key, value in flat(table) if general(key) in parameters}


def is_allowed(key, reasons):
    return key in reasons or general(key) in reasons


def departures(case, parameters):
    """Rows (run or file, key, value, reason or None) of a case; runs for sensitivity are left out."""
    rows = []
    for path in sorted(case.file.parent.glob("*.toml")):
        table = tomllib.loads(path.read_text(encoding="utf-8"))
        if "domain" in table:
            rows += [(path.name, key, value) for key, value in overrides(table, parameters).items()]
    for run in case.runs:
        if run.sensitivity:
            continue
        for resolution in run.cell_size:
            changed = {}
            for assignment in run.assignments(resolution):
                scratch = {"body": [{} for _ in range(20)]}
                apply(scratch, assignment)
                changed |= overrides(scratch, parameters)
            rows += [(run.name, key, value) for key, value in changed.items()]
    rows = list({(where, key, str(value)): (where, key, value) for where, key, value in rows}.values())
    return [(where, key, value, case.overrides.get(key, case.overrides.get(general(key)))) for where, key, value in rows]


def check(cases, parameters):
    """What is wrong, one text each."""
    wrong = []
    for case in cases:
        rows = departures(case, parameters)
        wrong += [f"{case.name}, {where}: {key} = {value} without a reason in [overrides]"
                  for where, key, value, reason in rows if not reason]
        used = {key for _, key, _, _ in rows} | {general(key) for _, key, _, _ in rows}
        wrong += [f"{case.name}: [overrides] has a reason for {key}, which no run changes"
                  for key in case.overrides if key not in used]
        wrong += [f"{case.name}, {where}: {key} = {value} repeats the default"
                  for where, key, value, _ in rows
                  if where.endswith(".toml") and str(value).lower() == parameters[general(key)].strip('"').lower()]
    return wrong
