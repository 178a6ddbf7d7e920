#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Measure which wrong lines the tests would see: single-line mutants of the numerical code.

Each mutant changes one operator or one number of one line, the tests of its group are built and run, and the
line is put back. A mutant that no test notices is listed: it is either equivalent (the line makes no
difference to any result), or a test is missing. The choice of mutants is random with a fixed seed.

Works in a copy of the sources and a build folder of its own (default: build/mutation), never in the tree.

Usage: mutate.py [--group NAME]... [--count N] [--seed S] [--build DIR] [--output FILE] [--list]
"""
import argparse
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Group -> sources to change, test executables, what of them to run.
GROUPS = {
    "material": (["src/material/common.cpp", "src/material/gather.cpp", "src/material/neo_hookean.hpp",
                  "src/material/eos_strength/*.cpp", "src/material/kinematics.cpp", "src/material/strength/*.cpp", "src/material/failure/*.hpp"],
                 {"test_material": "*"}),
    "transfer": (["src/transfer/*.cpp", "src/transfer/kernels.inl"], {"test_transfer": "*"}),
    "contact": (["src/contact/*.cpp"], {"test_contact": "*", "test_solver": "Contact*:WallContact*"}),
    "fit": (["md_fitting/fit/solid_*.cpp", "md_fitting/fit/vapour_fit.cpp", "md_fitting/fit/least_squares.cpp",
             "md_fitting/fit/laws.cpp", "md_fitting/fit/observations.cpp", "md_fitting/fit/eos_fit.cpp"],
            {"fit_test": "*"}),
}

# (name, what is found, what stands there afterwards)
OPERATORS = [
    ("+ -> -", re.compile(r"(?<=[\w\])] )\+(?= [\w(])"), "-"),
    ("- -> +", re.compile(r"(?<=[\w\])] )-(?= [\w(])"), "+"),
    ("* -> /", re.compile(r"(?<=[\w\])] )\*(?= [\w(])"), "/"),
    ("/ -> *", re.compile(r"(?<=[\w\])] )/(?= [\w(])"), "*"),
    ("< -> >", re.compile(r"(?<=[\w\])] )<(?= [\w(-])"), ">"),
    ("> -> <", re.compile(r"(?<=[\w\])] )>(?= [\w(-])"), "<"),
    ("+= -> -=", re.compile(r" \+= "), " -= "),
    ("-= -> +=", re.compile(r" -= "), " += "),
    ("&& -> ||", re.compile(r" && "), " || "),
    ("|| -> &&", re.compile(r" \|\| "), " && "),
    ("max -> min", re.compile(r"std::max\("), "std::min("),
    ("min -> max", re.compile(r"std::min\("), "std::max("),
    ("number x 1.5", re.compile(r"(?<![\w.])\d+\.\d*(?:e-?\d+)?(?![\w.])"), lambda found: repr(1.5 * float(found.group()))
     if float(found.group()) != 0.0 else "0.5"),
    ("true -> false", re.compile(r"\btrue\b"), "false"),
    ("false -> true", re.compile(r"\bfalse\b"), "true"),
]
LOOP_ENDS = {"< -> >", "> -> <", "+= -> -="}  # every test sees a loop that does not run or does not end
SKIPPED = re.compile(r"^\s*(//|///|\*|#|template|static_assert|using |namespace|throw|ASSERT)|fmt::|log::|InputError|"
                     r"InternalError|real\(|\.optional|assert\(|\boperator\b|\"")


def candidates(root, patterns):
    """All mutants of the files: (path, line number, name of the change, new line)."""
    found = []
    for path in sorted({path for pattern in patterns for path in root.glob(pattern)}):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines()):
            code = line.partition("//")[0]
            if SKIPPED.search(line) or not code.strip():
                continue
            for name, pattern, replacement in OPERATORS:
                if "for (" in code and name in LOOP_ENDS:
                    continue
                for place in pattern.finditer(code):
                    text = replacement(place) if callable(replacement) else replacement
                    changed = code[:place.start()] + text + code[place.end():]
                    found.append((path.relative_to(root), number, name, changed))
    return found


def chosen(root, group, count, seed):
    """A random choice that spreads over the files: at most one mutant of a line."""
    mutants = candidates(root, GROUPS[group][0])
    random.Random(f"{seed} {group}").shuffle(mutants)
    lines, result = set(), []
    for mutant in mutants:
        if mutant[:2] not in lines and len(result) < count:
            lines.add(mutant[:2])
            result.append(mutant)
    return result


def run(command, folder, limit=None):
    environment = dict(os.environ, OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                       OMP_WAIT_POLICY="passive")
    try:
        return subprocess.run(command, cwd=folder, env=environment, timeout=limit, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False)
    except subprocess.TimeoutExpired as expired:
        return subprocess.CompletedProcess(command, 124, (expired.stdout or b"").decode(errors="replace")
                                           if isinstance(expired.stdout, bytes) else "", None)


def verdict(build, tests, limit):
    """Outcome of the built tests: 'survived', or the first test that failed."""
    for test, what in tests.items():
        result = run([str(build / "tests" / "bin" / test), f"--gtest_filter={what}", "--gtest_fail_fast", "--gtest_brief=1"],
                     build, limit)
        if result.returncode == 124:
            return f"{test}: no end within {limit:.0f} s"
        if result.returncode != 0:
            failed = re.search(r"\[  FAILED  \] ([\w./]+)", result.stdout)
            return f"{test}.{failed.group(1)}" if failed else f"{test}: exit {result.returncode}"
    return "survived"


def copy_sources(tree):
    """The tracked files of the repository."""
    tree.mkdir(parents=True, exist_ok=True)
    for name in run(["git", "ls-files"], ROOT).stdout.splitlines():
        source, target = ROOT / name, tree / name
        if source.is_file() and not (target.exists() and target.read_bytes() == source.read_bytes()):
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, target)


def folders(place):
    """The copy of the sources and its build folder: as in a clone, so that ccache knows the objects."""
    return place / "tree", place / "tree" / "build" / "release"


def measure(group, options, write):
    tree, build = folders(options.build)
    _, tests = GROUPS[group]
    command = ["ninja", "-C", str(build), *tests]
    if run(command, tree).returncode != 0:
        sys.exit(f"mutate.py: the tests of {group} do not build")
    begin = time.time()
    if (outcome := verdict(build, tests, None)) != "survived":
        sys.exit(f"mutate.py: without a mutant {outcome} fails")
    limit = 30.0 + 10.0 * (time.time() - begin)
    for path, number, name, changed in chosen(tree, group, options.count, options.seed):
        file = tree / path
        text = file.read_text(encoding="utf-8")
        lines = text.splitlines(keepends=True)
        before = lines[number].strip()
        lines[number] = changed.rstrip() + "\n"
        file.write_text("".join(lines), encoding="utf-8")
        try:
            built = run(command, tree, 1200.0)
            outcome = "does not compile" if built.returncode != 0 else verdict(build, tests, limit)
        finally:
            file.write_text(text, encoding="utf-8")
        write(f"{group},{path}:{number + 1},{name},\"{before}\",{outcome}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--group", action="append", choices=GROUPS, help="default: all")
    parser.add_argument("--count", type=int, default=15, help="mutants of a group (default: 15)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "mutation")
    parser.add_argument("--output", type=pathlib.Path, help="CSV to which a line per mutant is added (default: print)")
    parser.add_argument("--list", action="store_true", help="print the mutants and end")
    options = parser.parse_args()
    options.build = options.build.resolve()
    groups = options.group or list(GROUPS)
    if options.list:
        for group in groups:
            for path, number, name, changed in chosen(ROOT, group, options.count, options.seed):
                print(f"{group}: {path}:{number + 1}: {name}: {changed.strip()}")
        return 0
    tree, build = folders(options.build)
    copy_sources(tree)
    configured = run(["cmake", "-G", "Ninja", "-S", str(tree), "-B", str(build), "-DCMAKE_BUILD_TYPE=Release"], ROOT)
    if configured.returncode != 0:
        print(configured.stdout, file=sys.stderr)
        return 2

    def write(line):
        print(line, flush=True)
        if options.output:
            with options.output.open("a", encoding="utf-8") as file:
                file.write(line + "\n")

    for group in groups:
        measure(group, options, write)
    return 0


if __name__ == "__main__":
    sys.exit(main())
