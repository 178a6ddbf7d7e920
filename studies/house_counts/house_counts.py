#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Counts of the structure of the source tree: how much does control by texts, coupling and length change by version?

Usage: studies/house_counts/house_counts.py [REVISION ...]   a table, one column per revision of git (default: the present
                                                             files)

Counted are comparisons with a string literal beyond the readers of case files and of other codes' decks, the foundation
and the catalogues of models; arrows between modules, those against the order of the table in scripts/check_layers.py,
and include cycles; include lines between the folders src (without the foundation), eos and md_fitting that go upward;
dates, times of day and commit hashes in manual and theory; lines and functions of the classes that once held everything;
files by length.
"""
import argparse
import importlib.util
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
CODE = (".hpp", ".cpp", ".inl")
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
COMPARISON = re.compile(r'[=!]=\s*"|"\s*[=!]=')
FOUNDATION = ("src/core/", "src/base/", "src/input/", "src/parallel/", "src/process/", "src/hdf5/")
READERS = ("src/case/", "src/setup/", "src/decks/", *FOUNDATION)


def load(path):
    """Loads a script as a module."""
    spec = importlib.util.spec_from_file_location(f"counted_{path.stem}_{id(path)}", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def without_comments(text):
    """Drops the comments of C++."""
    return re.sub(r"//[^\n]*", "", re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL))


class Tree:
    """Holds the sources and documents of a revision."""

    def __init__(self, root):
        self.root = root
        self.code = {path.relative_to(root).as_posix(): path.read_text(encoding="utf-8", errors="replace")
                     for folder in ("src", "eos", "md_fitting") for path in sorted((root / folder).rglob("*"))
                     if path.suffix in CODE}
        self.includes = {name: [target for target in INCLUDE.findall(text) if target in self.code]
                         for name, text in self.code.items()}

    def text_comparisons(self, folders):
        """Counts the lines that compare with a string literal beyond readers and catalogues."""
        return sum(bool(COMPARISON.search(line)) for name, text in self.code.items()
                   if name.startswith(folders) and not name.startswith(READERS) and "catalogue" not in name
                   for line in without_comments(text).split("\n"))

    def arrows(self):
        """Counts the arrows between modules, and those against the order of the tree's own table."""
        table = list(load(self.root / "scripts/check_layers.py").MAY_USE)

        def module(name):
            return max((folder for folder in table if name.startswith(folder + "/")), key=len, default=None)

        arrows = {(module(name), module(target)) for name, targets in self.includes.items() for target in targets}
        arrows = {(user, used) for user, used in arrows if user and used and user != used}
        return len(arrows), sum(table.index(used) > table.index(user) for user, used in arrows)

    def root_arrows_up(self):
        """Counts the include lines from a lower to a higher floor: foundation, eos, md_fitting, src."""
        def floor(name):
            if name.startswith(FOUNDATION):
                return 0
            return {"eos": 1, "md_fitting": 2, "src": 3}[name.split("/")[0]]
        return sum(floor(target) > floor(name) for name, targets in self.includes.items() for target in targets)

    def cycles(self):
        """Counts the include cycles, found depth first."""
        finished, found = set(), 0

        def visit(name, trail):
            nonlocal found
            for target in self.includes[name]:
                if target in trail:
                    found += 1
                elif target not in finished:
                    visit(target, trail | {target})
            finished.add(name)

        for name in self.includes:
            if name not in finished:
                visit(name, {name})
        return found

    def dated_lines(self):
        """Counts the lines of manual and theory, README and READMEs of cases with a date, time of day or commit hash."""
        rules = load(ROOT / "scripts/check_documents.py")
        pages = [path for pattern in ("README.md", "docs/**/*.md", "cases/**/README.md") for path in self.root.glob(pattern)
                 if not any(part in ("decisions", "generated") for part in path.relative_to(self.root).parts)
                 and not path.name.startswith(("results", "time_step_independence", "orders_of"))]
        found = 0
        for path in pages:
            lines = path.read_text(encoding="utf-8").split("\n")
            for kind, begin, end in rules.blocks(lines):
                for line in lines[begin:end] if kind != "code" else ():
                    plain = rules.ADDRESS.sub("", re.sub(r"`[^`]*`", "", line))
                    found += any(pattern.search(plain) for _, pattern in rules.DIARY)
        return found

    def lines(self, ending):
        """Counts the lines of the files whose name ends so."""
        return sum(text.count("\n") for name, text in self.code.items() if name.endswith(ending))

    def longer_than(self, most):
        """Counts the source files, tests included, of more lines."""
        tests = [path.read_text(encoding="utf-8", errors="replace") for path in (self.root / "tests").rglob("*")
                 if path.suffix in CODE]
        return sum(text.count("\n") > most for text in [*self.code.values(), *tests])


def counts(root):
    """Returns the rows of the table: what is counted, and its number."""
    tree = Tree(root)
    arrows, upward = tree.arrows()
    return {
        "comparisons with a string literal in src beyond the readers": tree.text_comparisons(("src/",)),
        "the same in solver, run, bench and analysis": tree.text_comparisons(
            ("src/solver/", "src/run/", "src/bench/", "src/analysis/")),
        "arrows between modules": arrows,
        "arrows against the order of the module table": upward,
        "include lines up between foundation, eos, md_fitting, src": tree.root_arrows_up(),
        "include cycles": tree.cycles(),
        "dated lines in manual, theory and READMEs": tree.dated_lines(),
        "lines of runner.cpp": tree.lines("/runner.cpp"),
        "lines of simulation.hpp": tree.lines("solver/simulation.hpp"),
        "files of more than 500 lines": tree.longer_than(500),
    }


def table_of(columns):
    """Writes the columns (heading, counts) as Markdown."""
    rows = [["", *[heading for heading, _ in columns]], ["---"] * (len(columns) + 1)]
    rows += [[name, *[str(column[name]) for _, column in columns]] for name in columns[0][1]]
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("revisions", metavar="REVISION", nargs="*")
    columns = []
    for revision in parser.parse_args().revisions:
        with tempfile.TemporaryDirectory() as folder:
            archive = subprocess.run(["git", "-C", ROOT, "archive", revision], capture_output=True, check=True).stdout
            subprocess.run(["tar", "-x", "-C", folder], input=archive, check=True)
            columns.append((revision, counts(pathlib.Path(folder))))
    print(table_of([*columns, ("present files", counts(ROOT))]))


if __name__ == "__main__":
    sys.exit(main())
