# SPDX-License-Identifier: BSD-3-Clause
"""Record of a finished run: what it was computed with, and whether that is what the repository holds now.

A run folder gets finished.json when the run has ended well. Digests are the first 16 digits of SHA-256.
"""
import functools
import hashlib
import json
import pathlib
import platform
import re
import shutil
import subprocess
import tempfile
import tomllib

from studies.validation import frozen_parameters
from studies.validation.cases import ROOT, BadExpectation, quantity, value_of

CODE = (".cpp", ".hpp", ".inl", ".h")
# What a run of a case and its measures are computed by. Files, pages, imports and the command line are not: they write down
# and show what these compute.
SOURCES = ("src/core/base", "src/core/input", "src/core/parallel", "src/particles", "src/grid", "src/transfer", "src/material",
           "src/fem", "src/afemp", "src/contact", "src/case", "src/solver", "src/run/runner.cpp", "src/analysis", "eos")
NO_SOURCES = ("src/core/base/files.cpp", "src/core/base/files.hpp", "src/fem/abaqus.cpp", "src/fem/gmsh.cpp",
              "src/fem/vtk_mesh.cpp", "eos/curves", "eos/experiments", "eos/files", "eos/materials", "eos/data")
# A comment, or a literal in which none begins.
COMMENT = re.compile(r"""//[^\n]*|/\*.*?\*/|("(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])')""", re.DOTALL)
LIBRARY = ROOT / "eos" / "materials"

# Digests of sources whose programs gave the same digits in all runs of the drift gate: new -> old (scripts/drift.py --same-as).
SAME_RESULTS = ROOT / "docs" / "generated" / "same_results.json"

CURRENT, OLDER_SOURCE, STALE, MISSING = "current", "older source", "stale", "missing"


def digest_of(*texts):
    total = hashlib.sha256()
    for text in texts:
        total.update(text if isinstance(text, bytes) else text.encode())
    return total.hexdigest()[:16]


def code_of(text):
    """What a C++ file says: comments and layout do not count."""
    return re.sub(r"\s+", " ", COMMENT.sub(lambda match: match[1] or " ", text)).strip()


@functools.cache
def digest_of_sources(root=ROOT):
    """Of all C++ that computes runs and their measures, as it stands in the working tree."""
    left_out = [root / name for name in NO_SOURCES]
    places = [root / name for name in SOURCES]
    files = sorted(path for place in places for path in (place, *place.rglob("*"))
                   if path.suffix in CODE and path.is_file() and not any(path.is_relative_to(name) for name in left_out))
    return digest_of(*(part for path in files
                       for part in (str(path.relative_to(root)), code_of(path.read_text(encoding="utf-8")))))


@functools.cache
def digest_of_revision(revision, root=ROOT):
    """Of the same C++ in a revision of the repository."""
    with tempfile.TemporaryDirectory() as folder:
        archive = subprocess.run(["git", "archive", revision, "src", "eos"], cwd=root, capture_output=True, check=True).stdout
        subprocess.run(["tar", "-x", "-C", folder], input=archive, check=True)
        return digest_of_sources(pathlib.Path(folder))


def known_same():
    return json.loads(SAME_RESULTS.read_text()) if SAME_RESULTS.is_file() else {}


UNKNOWN_SOURCE = "built from "  # and a revision, where that was not known when the run was made


@functools.cache
def known_source(source):
    """The digest of a source; of one that is named by its revision, if the repository has it."""
    revision = source.removeprefix(UNKNOWN_SOURCE)
    return digest_of_revision(revision) if revision != source and has_revision(revision) else source


@functools.cache
def has_revision(revision):
    done = subprocess.run(["git", "cat-file", "-e", f"{revision}^{{commit}}"], cwd=ROOT, stderr=subprocess.DEVNULL)
    return done.returncode == 0


def is_same_program(one, other):
    """Whether two sources compute the same: they are one, or by the runs of the drift gate."""
    same = known_same()

    def first(source):
        source = known_source(source)
        while source in same:
            source = same[source]
        return source

    return first(one) == first(other)


# Programs that compute the same runs as later ones and define pieces and fragments otherwise (docs/theory/analysis.md, 3).
MEASURES_OF_PIECES = re.compile(r"piece_|loose_fraction|largest_fragment|mean_fragment|debris_fragments|fragment_exponent")
FORMER_PIECES = frozenset(("e2357f6d28298d43", "6996eb7450a9143c", "a07d45635fbe8742", "45845d99f5e2109f", "04d9fe0269858762",
                           "d4aa44ac62ed6019", "7916c7fe56677fe8", "60a53a71aa62845c", "d64a917a5377ca3e", "8b84966968a6a681"))


def is_current(source, program, run):
    """Whether a run that a source computed and measured is what a program gives for it."""
    measures_pieces = any(MEASURES_OF_PIECES.search(expectation.measure) for expectation in run.expectations)
    former = measures_pieces and known_source(source) in FORMER_PIECES and known_source(program) not in FORMER_PIECES
    return is_same_program(source, program) and not former


@functools.cache
def digest_of_file(path):
    return digest_of(pathlib.Path(path).read_bytes())


@functools.cache
def digest_of_toml(path):
    """Of what the file says: comments, layout, and the texts `source` and `note` do not count."""
    table = tomllib.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    return digest_of(json.dumps(without_notes(table), sort_keys=True, default=str))


def without_notes(value):
    """A table or list of a file without what says where its numbers are from."""
    if isinstance(value, dict):
        return {key: without_notes(entry) for key, entry in value.items() if key not in ("source", "note")}
    return [without_notes(entry) for entry in value] if isinstance(value, list) else value


def material_files(run):
    """Material files that a run reads, by the names in the case: beside it or from the library."""
    found = {}
    for body in run.resolved(next(iter(run.cell_size)))["body"]:
        name = body["material"]
        own = run.case.file.parent / name
        path = own if own.is_file() else LIBRARY / (name if name.endswith(".toml") else f"{name}.toml")
        found[name] = path.resolve()
        found.update(bases_of(path))
    return found


def bases_of(path):
    """Material files that a material file is based on, by their names in it."""
    found = {}
    while path.is_file() and (name := tomllib.loads(path.read_text(encoding="utf-8")).get("base")) and name not in found:
        own = path.parent / (name if name.endswith(".toml") else f"{name}.toml")
        path = own if own.is_file() else LIBRARY / own.name
        found[name] = path.resolve()
    return found


def changes_of(run):
    """Digest of what a run changes in its case and of the options of its analysis; cell sizes stand with the records."""
    in_si = {"set": meaning(run.set), "set_at": {name: meaning(words) for name, words in sorted(run.set_at.items())}}
    return digest_of(json.dumps(in_si | {"analyse": run.analyse}, default=str))


def asked_of(expectation):
    """Digest of how a quantity is measured beside its name: when, where, of what fraction, against which table; "" if by nothing."""
    asked = {key: getattr(expectation, key) for key in ("time", "place", "travel", "speed", "fraction")
             if getattr(expectation, key) is not None}
    if expectation.table is not None:
        asked["table"] = digest_of_file(expectation.table)
    return digest_of(json.dumps(asked)) if asked else ""


def inputs_of(run):
    """Digests of the case, of what the run changes in it, and of its materials."""
    return {"case": digest_of_toml(run.case.file), "changes": changes_of(run),
            "materials": {name: digest_of_toml(path) if path.is_file() else ""
                          for name, path in material_files(run).items()}}


def git(*words):
    done = subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True)
    return done.stdout.strip() if done.returncode == 0 else ""


@functools.cache
def processor():
    try:
        text = pathlib.Path("/proc/cpuinfo").read_text()
    except OSError:
        return platform.machine()
    match = re.search(r"model name\s*: (.*)", text)
    return match[1] if match else platform.machine()


@functools.cache
def program(whipple):
    """Lines of `whipple version`, digest of the executable, and that of the sources it was built from if that is known.

    The executable names its revision: with a "+" it is taken for that of the working tree, which was changed when it was built.
    """
    done = subprocess.run([whipple, "version"], capture_output=True, text=True)
    lines = [re.sub(r"\s+", " ", line) for line in done.stdout.splitlines()]
    match = re.search(r"revision ([0-9a-f]+)", lines[0] if lines else "")
    if match and "+" in lines[0]:
        source = digest_of_sources()
    else:
        source = known_source(UNKNOWN_SOURCE + (match[1] if match else "unknown"))
    return {"program": lines[0] if lines else "", "build": [line for line in lines[1:3]],
            "executable": digest_of_file(whipple),
            "source": source}


def source_of(whipple):
    """Digest of the sources that an executable was built from; of the working tree where there is no executable."""
    return program(whipple)["source"] if shutil.which(whipple) else digest_of_sources()


def numerical_parameters(folder):
    """Those that the run used, from the complete input in run.toml."""
    known = frozen_parameters.defaults()
    used = tomllib.loads((folder / "run.toml").read_text(encoding="utf-8"))
    return {key: value for key, value in frozen_parameters.flat(used) if frozen_parameters.general(key) in known}


def write(folder, run, variant, command, whipple, threads, wall_time):
    record = {"command": command, "variant": variant.name, "resolution": variant.resolution,
              "cell_size": run.cell_size[variant.resolution],
              "revision": git("rev-parse", "--short=12", "HEAD"),
              "dirty": bool(git("status", "--porcelain", "--", *SOURCES, "cases")),
              **program(whipple), **inputs_of(run),
              "parameters": frozen_parameters.digest(numerical_parameters(folder)),
              "frozen_set": frozen_parameters.digest(frozen_parameters.defaults()),
              "processor": processor(), "machine": platform.node(), "threads": threads,
              "wall_time": round(wall_time, 1)}
    partial = folder / "finished.json.partial"
    partial.write_text(json.dumps(record, indent=1) + "\n")
    partial.rename(folder / "finished.json")
    return record


def read(folder):
    """The record of a finished run, None if it has none."""
    path = folder / "finished.json"
    return json.loads(path.read_text()) if path.is_file() else None


def meaning(command):
    """A command with the quantities of its assignments in SI: written in another way it is no other run."""
    def in_si(value):
        if isinstance(value, list):
            return [in_si(entry) for entry in value]
        try:
            return quantity(value, "")[0]
        except BadExpectation:
            return value

    words = (word.partition("=") for word in command)
    return [(key, in_si(value_of(text))) if separator else key for key, separator, text in words]


def state(record, command, inputs, is_current):
    """Whether a record is that of this command, case, materials, and of a current source by is_current(source)."""
    if record is None:
        return MISSING
    if meaning(record["command"]) != meaning(command) or any(record[key] != inputs[key] for key in ("case", "materials")):
        return STALE
    return CURRENT if is_current(record["source"]) else OLDER_SOURCE
