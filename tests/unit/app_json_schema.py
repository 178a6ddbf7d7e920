#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""JSON schemas of inputs (`whipple describe --json-schema`): every file that the program accepts passes, every planted
error is refused by the schema and by the program alike.

Usage: app_json_schema.py WHIPPLE SOURCE_FOLDER SMALL_CASE.toml
"""
import copy
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import tomllib

from checks import require

WHIPPLE, SOURCE, SMALL = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "integer": int, "number": (int, float)}
REMARKS = {"$schema", "title", "description", "default", "$defs", "then", "else"}


def is_type(value, name):
    return isinstance(value, TYPES[name]) and (name == "boolean" or not isinstance(value, bool))


class Checker:
    """The keywords of JSON Schema that the program writes; any other is an error of this test."""

    def __init__(self, root):
        self.root = root

    def faults(self, value, schema=None, path=""):
        schema = self.root if schema is None else schema
        found = []
        for keyword, content in schema.items():
            if keyword not in REMARKS:
                found += [f"{path}: {fault}" if ": " not in fault else fault
                          for fault in getattr(self, "of_" + keyword.replace("$", ""))(content, value, schema, path)]
        return found

    def of_ref(self, content, value, schema, path):
        require(content.startswith("#/$defs/"), f"reference {content}")
        return self.faults(value, self.root["$defs"][content.removeprefix("#/$defs/")], path)

    def of_type(self, content, value, schema, path):
        return [] if is_type(value, content) else [f"{value!r} is no {content}"]

    def of_properties(self, content, value, schema, path):
        if not isinstance(value, dict):
            return []
        return [fault for key, entry in content.items() if key in value
                for fault in self.faults(value[key], entry, f"{path}.{key}")]

    def of_additionalProperties(self, content, value, schema, path):
        require(content is False, "additionalProperties")
        unknown = set(value) - set(schema["properties"]) if isinstance(value, dict) else []
        return [f"unknown key {key}" for key in unknown]

    def of_required(self, content, value, schema, path):
        return [f"{key} is missing" for key in content if isinstance(value, dict) and key not in value]

    def of_minProperties(self, content, value, schema, path):
        return [] if len(value) >= content else ["too few keys"]

    def of_maxProperties(self, content, value, schema, path):
        return [] if len(value) <= content else ["too many keys"]

    def of_items(self, content, value, schema, path):
        entries = value if isinstance(value, list) else []
        return [fault for i, entry in enumerate(entries) for fault in self.faults(entry, content, f"{path}[{i}]")]

    def of_minItems(self, content, value, schema, path):
        return [] if not isinstance(value, list) or len(value) >= content else ["too few entries"]

    def of_maxItems(self, content, value, schema, path):
        return [] if not isinstance(value, list) or len(value) <= content else ["too many entries"]

    def of_enum(self, content, value, schema, path):
        return [] if value in content else [f"{value!r} is none of {content}"]

    def of_const(self, content, value, schema, path):
        return [] if value == content and isinstance(value, bool) == isinstance(content, bool) else [f"{value!r} is not {content}"]

    def of_pattern(self, content, value, schema, path):
        return [] if not isinstance(value, str) or re.search(content, value) else [f"{value!r} is not as {content}"]

    def limit(self, holds, value, what):
        number = isinstance(value, (int, float)) and not isinstance(value, bool)
        return [] if not number or math.isfinite(value) and holds(value) else [f"{value} is not {what}"]

    def of_minimum(self, content, value, schema, path):
        return self.limit(lambda v: v >= content, value, f">= {content}")

    def of_maximum(self, content, value, schema, path):
        return self.limit(lambda v: v <= content, value, f"<= {content}")

    def of_exclusiveMinimum(self, content, value, schema, path):
        return self.limit(lambda v: v > content, value, f"> {content}")

    def of_exclusiveMaximum(self, content, value, schema, path):
        return self.limit(lambda v: v < content, value, f"< {content}")

    def of_if(self, content, value, schema, path):
        return self.faults(value, schema["else" if self.faults(value, content, path) else "then"], path)

    def of_anyOf(self, content, value, schema, path):
        tried = [self.faults(value, entry, path) for entry in content]
        return [] if any(not faults for faults in tried) else min(tried, key=len)

    def of_oneOf(self, content, value, schema, path):
        tried = [self.faults(value, entry, path) for entry in content]
        passed = sum(not faults for faults in tried)
        return [] if passed == 1 else min(tried, key=len) or [f"{passed} alternatives fit"]


def schema(topic):
    text = subprocess.run([WHIPPLE, "describe", topic, "--json-schema"], check=True, capture_output=True, text=True).stdout
    root = json.loads(text)
    require(root["$schema"] == "https://json-schema.org/draft/2020-12/schema", root["$schema"])
    return root


def with_value(document, key, value):
    """The document with one key set, as --set does."""
    changed = copy.deepcopy(document)
    *parents, last = [int(part) if part.isdigit() else part for part in key.split(".")]
    node = changed
    for part in parents:
        node = node[part] if isinstance(part, int) else node.setdefault(part, {})
    node[last] = value
    return changed


def every_accepted_file(checkers):
    numbers = dict.fromkeys(checkers, 0)
    files = [*SOURCE.glob("cases/**/*.toml"), *SOURCE.glob("eos/materials/*.toml"), *SOURCE.glob("examples/**/*.toml"),
             *SOURCE.glob("tests/**/*.toml")]
    for file in files:
        document = tomllib.loads(file.read_text())
        topic = ("case" if {"domain", "body"} <= set(document) else "material" if "name" in document and {"eos", "base"} & set(document) else
                 "md" if {"element", "potential"} <= set(document) else None)
        if topic is None:
            continue
        numbers[topic] += 1
        faults = checkers[topic].faults(document)
        require(not faults, f"{file}: {faults}")
    print(numbers)
    require(numbers["case"] >= 35 and numbers["material"] >= 45 and numbers["md"] >= 3, f"files found: {numbers}")


def written_by_the_program(checker, folder):
    """A run writes its case with every default."""
    subprocess.run([WHIPPLE, "run", SMALL, "-o", folder / "run", "--set", "time.end=1 ns"], check=True, capture_output=True)
    faults = checker.faults(tomllib.loads((folder / "run" / "run.toml").read_text()))
    require(not faults, f"run.toml: {faults}")


# Key and value, as TOML, of a case that is right otherwise.
PLANTED = [
    ("domain.cell_size", "5"), ("domain.cell_size", '"-1 mm"'), ("domain.cell_size", '"wide"'), ("domain.cell_size", "true"),
    ("domain.cell_sice", '"1 mm"'), ("domain.lower", '["1 mm"]'), ("domain.boundary.x_lower", '"wall"'),
    ("time.scheme", '"leapfrog"'), ("time.courant", "-0.1"), ("time.end", '"5"'), ("transfers.kappa", "1"), ("title", "3"),
    ("output.fields", '["nonsense"]'), ("output.fields", '"velocity"'), ("output.history_every", "0"),
    ("output.history_every", "1.5"), ("body.0.discretization.per_cell", "0"), ("body.0.velocity", '["1 km/s", 3, 0]'),
    ("body.0.material", "7"), ("body.0.shape", '{ sphere = { center = [0, 0, 0], radius = "1 mm" }, box = {} }'),
    ("body.0.shape", '{ ball = { radius = "1 mm" } }'), ("body.0.shape", '{ sphere = { center = [0, 0, 0] } }'),
    ("body.0.shape", '{ difference = { from = { sphere = { center = [0, 0, 0], radius = "1 mm" } } } }'),
    ("body.0.partial_volumes", "true"), ("contact.method", '["multi_field"]'), ("body", "[]")]
RIGHT = [("domain.cell_size", '"0.5 mm"'), ("domain.cell_size", '"1.e-3m"'), ("time.courant", '"0.3"'),
         ("artificial_viscosity.linear", '"20 %"'), ("body.0.velocity", '[0, "-1.5e+0 km/s", 0.0]'),
         ("body.0.initial.temperature", '"-10 degC"'), ("output.snapshot_every", "0"), ("provenance", "{ by = { whom = 1 } }")]


def planted(checker):
    document = tomllib.loads(SMALL.read_text())
    for assignments, right in ((PLANTED, False), (RIGHT, True)):
        for key, value in assignments:
            faults = checker.faults(with_value(document, key, tomllib.loads("v = " + value)["v"]))
            require((not faults) == right, f"schema, {key} = {value}: {faults}")
            done = subprocess.run([WHIPPLE, "edit", "--dry-run", SMALL, f"{key}={value}"], capture_output=True, text=True)
            require((done.returncode == 0) == right, f"whipple edit {key}={value}: {done.returncode} {done.stderr}")


def planted_in_materials(checker):
    copper = tomllib.loads((SOURCE / "eos/materials/copper.toml").read_text())
    for key, value in (("eos.model", "grey"), ("eos.density", 3), ("strength.yield_strength", "90 MPa"), ("group", "cheese"),
                       ("failure", {"model": "tensile_pressure"}), ("thermal.taylor_quinney", 1.5), ("name", 3), ("eos", {})):
        require(checker.faults(with_value(copper, key, value)), f"material, {key} = {value}: not refused")
    child = {"base": "pbx_9502", "name": "n", "source": "s"}
    for table, right in (({"eos": {"unreacted": {"heat_capacity": "1.2 kJ/(kg K)"}}}, True), ({"thermal": {"taylor_quinney": 0.9}}, False),
                         ({"thermal": {"taylor_quinney": 0.9, "source": "s"}}, True),
                         ({"failure": [{"model": "plastic_strain", "failure_strain": 0.3}]}, True),
                         ({"failure": [{"model": "plastic_strain"}]}, False), ({"failure": [{"failure_strain": 0.3}]}, False),
                         ({"eos": {"modifier": [{"value": 1}]}}, False)):
        faults = checker.faults(child | table)
        require((not faults) == right, f"a material with a base and {table}: {faults}")
    without = {key: value for key, value in copper.items() if key != "source"}
    require(checker.faults(without), "a material without its source")


def main():
    checkers = {topic: Checker(schema(topic)) for topic in ("case", "material", "md")}
    every_accepted_file(checkers)
    planted(checkers["case"])
    planted_in_materials(checkers["material"])
    with tempfile.TemporaryDirectory() as folder:
        written_by_the_program(checkers["case"], pathlib.Path(folder))
    refused = subprocess.run([WHIPPLE, "describe", "eos", "--json-schema"], capture_output=True, text=True)
    require(refused.returncode == 2 and "one of: case, material, md" in refused.stderr, refused.stderr)


if __name__ == "__main__":
    main()
