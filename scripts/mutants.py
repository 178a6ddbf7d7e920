#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Damages inputs of every kind at random and gives them to the commands that read them. A command must end in time with a
documented exit code and a message, change none of its inputs, and leave nothing half written.

Usage: mutants.py WHIPPLE FOLDER [--count 1000] [--kinds case,material,...] [--seed 1] [--seconds 3600] [--jobs 1]
Every mutant follows from the seed and its number: FOLDER/outcomes.csv holds those that are done, and a later call goes on
behind them. What is wrong is kept as FOLDER/faults/NUMBER with its command. Exit code 1 if there are faults.
"""
import argparse
import collections
import concurrent.futures
import csv
import hashlib
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
DATA = ROOT / "tests" / "data"
DOCUMENTED = {0, 2, 3, 124}
# Mutants of each kind in a hundred; those that simulate molecules take seconds.
SHARES = {"case": 9, "material": 9, "plan": 2, "ls_dyna": 12, "mpm3d": 8, "abaqus": 8, "gmsh": 8, "vtk": 8, "table": 8,
          "potential": 2, "checkpoint": 5, "snapshot": 5, "run_text": 5, "store": 5, "points": 6}
CRASH = re.compile(r"internal error|Traceback|terminate called|Sanitizer|runtime error:|Assertion|Segmentation|"
                   r"signal \d+|ended with code 4")
LIMIT = 60.0  # s of processor time of a command
WALL = 600.0  # s; machines are shared
MEMORY = 8 << 30  # bytes of addresses
WORDS = [b"nan", b"inf", b"-inf", b"1e308", b"-1e308", b"1e-320", b"0", b"-1", b"1", b"4294967296", b"-2147483649",
         b"99999999999999999999", b"''", b'""', b"[]", b"{}", b"true", b"\x00", b"\xff", b"\xe4", b"0x7f", b"1e", b"*", b"/",
         b"..", b"1e400", b"1 km", b"1 K", b"-0.0", b"2147483647"]
NUMBER = re.compile(rb"[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?")

MESH_CASE = """
[domain]
lower = ["-40 mm", "-40 mm", "-40 mm"]
upper = ["40 mm", "40 mm", "40 mm"]
cell_size = "5 mm"
[time]
end = "0.05 us"
[[body]]
name = "box"
material = "copper_ofhc_mie_gruneisen.toml"
velocity = ["0 m/s", "0 m/s", "1 km/s"]
discretization = {{ method = "finite_elements", mesh = "{file}", mesh_unit = "10 mm"{group} }}
"""
POINTS = """particle velocity [m/s],shock velocity [m/s]
500,4685
1000,5430
1500,6175
2000,6920
"""


def plan_of(potential):
    return (DATA / "small_plan.toml").read_text().replace("copper_universal_3", potential)


def mesh_case(file, group):
    return MESH_CASE.format(file=file, group=f', group = "{group}"' if group else "")


class Kind:
    """One kind of inputs: files that are valid, of which one at a time is damaged, and the command that reads it.
    `prepare(folder)` writes the files of a mutant and returns the paths that may be damaged."""

    def __init__(self, prepare, command, output=None):
        self.prepare, self.command, self.output = prepare, command, output


def kinds(whipple, base):
    """All kinds. Files that only a program can make (tables, stores, runs) are made once in the folder `base`."""
    made = Base(whipple, base)
    library = sorted((ROOT / "eos" / "materials").glob("*.toml"))
    cases = [path for path in sorted((ROOT / "cases").glob("*/case.toml"))]

    def case(folder, chosen):
        if chosen.random() < 0.8:
            shutil.copy(DATA / "small_impact.toml", folder / "case.toml")
        else:
            shutil.copy(chosen.choice(cases), folder / "case.toml")
        return [folder / "case.toml"]

    def material(folder, chosen):
        shutil.copy(chosen.choice(library), folder / "m.toml")
        return [folder / "m.toml"]

    def mesh(files):
        def prepare(folder, chosen):
            source, group = chosen.choice(files)
            target = folder / ("mesh" + source.suffix)
            shutil.copy(source, target)
            (folder / "case.toml").write_text(mesh_case(target.name, group))
            return [target]
        return prepare

    def abaqus(folder, chosen):
        shutil.copy(DATA / "fem" / "two_bricks.inp", folder / "mesh.inp")
        (folder / "case.toml").write_text(mesh_case("mesh.inp", chosen.choice(["Lower Box", "upper", "both"])))
        return [folder / "mesh.inp"]

    def table(folder, chosen):
        name = chosen.choice(["copper.ses", "copper.eos.h5"])
        shutil.copy(made.folder / name, folder / name)
        shutil.copy(made.folder / (name + ".toml"), folder / "m.toml")
        return [folder / name]

    def plan(folder, chosen):
        shutil.copy(DATA / "small_plan.toml", folder / "plan.toml")
        return [folder / "plan.toml"]

    def potential(folder, chosen):
        source = chosen.choice(made.potentials)
        shutil.copy(source, folder / source.name)
        (folder / "plan.toml").write_text(plan_of(source.name))
        return [folder / source.name]

    def of_run(pattern):
        def prepare(folder, chosen):
            shutil.copytree(made.folder / "run", folder / "run")
            return [chosen.choice(sorted((folder / "run").glob(pattern)))]
        return prepare

    def store(folder, chosen):
        shutil.copy(made.folder / "s.md.h5", folder / "s.md.h5")
        return [folder / "s.md.h5"]

    def points(folder, chosen):
        (folder / "points.csv").write_text(POINTS)
        return [folder / "points.csv"]

    def deck(*sources):
        def prepare(folder, chosen):
            source = chosen.choice(sources)
            target = folder / ("input" + source.suffix)
            shutil.copy(source, target)
            return [target]
        return prepare

    run = ["run", "case.toml", "-o", "out", "--threads", "1", "--quiet", "--wall-time", "0.2 s"]
    state = ["eos", "state", "m.toml", "--density", "9 g/cm^3", "--temperature", "500 K"]
    imported = ["-o", "out", "--allow-missing", "--units", "mm g ms", "--cell-size", "0.5 mm"]
    return {
        "case": Kind(case, run, "out"),
        "material": Kind(material, ["eos", "audit", "m.toml"]),
        "plan": Kind(plan, ["md", "plan.toml", "-o", "s.md.h5", "--ranks", "1", "--quiet"]),
        "ls_dyna": Kind(deck(DATA / "decks" / "bar_on_plate.k"), ["import", "input.k", *imported], "out"),
        "mpm3d": Kind(deck(*sorted((DATA / "decks").glob("*.mpm"))), ["import", "input.mpm", "-o", "out", "--allow-missing", "--units", "m kg s"], "out"),
        "abaqus": Kind(abaqus, run, "out"),
        "gmsh": Kind(mesh([(path, "plate") for path in sorted((DATA / "fem").glob("*.msh"))]),
                     run, "out"),
        "vtk": Kind(mesh([(path, "body 0") for path in [*sorted((DATA / "fem").glob("*.vtu")), *sorted((DATA / "fem").glob("*.vtk"))]]),
                    run, "out"),
        "table": Kind(table, state),
        "potential": Kind(potential, ["md", "plan.toml", "-o", "s.md.h5", "--ranks", "1", "--quiet"]),
        "checkpoint": Kind(of_run("checkpoint/*.h5"), ["run", "--restart", "run", "--threads", "1", "--quiet"], "run"),
        "snapshot": Kind(of_run("*.hdf"), ["analyse", "run", "-o", "out"], "out"),
        "run_text": Kind(of_run("*.[tcjs]*"), ["run", "--restart", "run", "--threads", "1", "--quiet"], "run"),
        "store": Kind(store, ["fit", "s.md.h5", "--model", "mie_gruneisen", "-o", "out"], "out"),
        "points": Kind(points, ["compare", "copper", "--with", "points.csv"]),
    }


class Base:
    """What only the program makes: tables, a store, a run that can go on."""

    def __init__(self, whipple, folder):
        self.folder = folder
        self.potentials = [folder / "Cu_u3.eam", folder / "pair.fs"]
        ready = folder / "ready"
        if not ready.exists():
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir(parents=True)
            self.make(whipple)
            ready.touch()
        self.potentials = [path for path in self.potentials if path.exists()]

    def make(self, whipple):
        def call(*arguments):
            subprocess.run([whipple, *arguments], cwd=self.folder, check=True, stdout=subprocess.DEVNULL)
        call("eos", "table", "copper", "--error", "1e-2", "-o", "copper.eos.h5")
        call("eos", "table", "copper", "--sesame", "copper.ses")
        text = (ROOT / "eos" / "materials" / "copper_ofhc_mie_gruneisen.toml").read_text()
        for file, model in (("copper.ses", "sesame"), ("copper.eos.h5", "table")):
            body = re.sub(r"\[eos\].*?(?=\n\[)", f'[eos]\nmodel = "{model}"\nfile = "{file}"\n', text, flags=re.DOTALL)
            (self.folder / (file + ".toml")).write_text(body)
        subprocess.run([whipple, "run", DATA / "small_impact.toml", "-o", "run", "--threads", "1", "--quiet", "--set",
                        "time.end='0.06 us'", "--wall-time", "0.15 s"], cwd=self.folder, stdout=subprocess.DEVNULL)
        shutil.copy("/usr/share/lammps/potentials/Cu_u3.eam", self.folder)
        call("md", DATA / "small_plan.toml", "-o", "s.md.h5", "--ranks", "1", "--quiet")


def damaged(content, chosen):
    """Damages bytes: bits, runs, numbers, lines, the end."""
    content = bytearray(content)
    for _ in range(chosen.choice([1, 1, 1, 2, 3, 8])):
        if not content:
            break
        at = chosen.randrange(len(content))
        way = chosen.randrange(9)
        if way == 0:
            content[at] ^= 1 << chosen.randrange(8)
        elif way == 1:
            content[at:at + chosen.choice([1, 2, 4, 8, 64])] = b""
        elif way == 2:
            content[at:at] = content[at:at + chosen.choice([1, 8, 100, 1000])]
        elif way == 3:
            content[at:at] = chosen.choice(WORDS)
        elif way in (4, 5):
            found = list(NUMBER.finditer(content, max(0, at - 200), at + 200))
            if found:
                match = chosen.choice(found)
                content[match.start():match.end()] = chosen.choice(WORDS)
        elif way == 6:
            lines = bytes(content).split(b"\n")
            line = chosen.randrange(len(lines))
            if chosen.random() < 0.5:
                del lines[line]
            else:
                lines.insert(chosen.randrange(len(lines) + 1), lines[line])
            content = bytearray(b"\n".join(lines))
        elif way == 7:
            size = chosen.choice([1, 4, 8])
            content[at:at + size] = bytes(chosen.choice([0x00, 0xff, 0x7f, 0x80]) for _ in range(size))
        else:
            del content[at:]
    return bytes(content)


def damage_numbers(path, chosen):
    """Replaces numbers of a data set of HDF5, so that checksums and digests hold; returns whether it could."""
    import h5py
    import numpy
    try:
        with h5py.File(path, "r+") as file:
            sets = []
            file.visititems(lambda _, item: sets.append(item) if isinstance(item, h5py.Dataset) and item.size else None)
            if not sets:
                return False
            values = chosen.choice(sets)
            numbers = values[...]
            with numpy.errstate(all="ignore"):
                odd = numpy.array([numpy.nan, numpy.inf, -1e30, 1e300, 0, -1, 2**31, 255]).astype(numbers.dtype)
            flat = numbers.reshape(-1)
            where = slice(None) if chosen.random() < 0.3 else chosen.randrange(flat.size)
            flat[where] = odd[chosen.randrange(odd.size)]
            values[...] = numbers
    except (OSError, RuntimeError, KeyError, ValueError):
        return False
    return True


def digest(folder, but=""):
    """Digests of the files of a folder, but those below one name."""
    return {path: hashlib.sha256(path.read_bytes()).digest() for path in folder.rglob("*")
            if path.is_file() and not (but and path.is_relative_to(folder / but))}


def limited():
    resource.setrlimit(resource.RLIMIT_CPU, (int(LIMIT), int(LIMIT) + 5))
    resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 30, 1 << 30))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    if "ASAN_OPTIONS" not in os.environ:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def trial(number, kind_name, kind, options):
    """Makes and reads one mutant. Returns exit code, seconds, and what is wrong with it."""
    chosen = random.Random(f"{options.seed}/{number}")
    folder = options.folder / "work" / str(number)
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    victims = kind.prepare(folder, chosen)
    victim = chosen.choice(victims)
    if not (victim.suffix in (".h5", ".hdf") and chosen.random() < 0.5 and damage_numbers(victim, chosen)):
        victim.write_bytes(damaged(victim.read_bytes(), chosen))
    before = digest(folder, kind.output or "")
    command = [str(options.whipple), *kind.command]
    begin = time.monotonic()
    process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               start_new_session=True, preexec_fn=limited,
                               env=dict(os.environ, OMP_NUM_THREADS="1", MPLBACKEND="Agg"))
    try:
        output, code = process.communicate(timeout=WALL)[0], process.returncode
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        output, code = process.communicate()[0], None
    seconds = time.monotonic() - begin
    words = output.decode(errors="replace")
    faults = []
    if code is None or code in (-signal.SIGXCPU, -signal.SIGKILL, 128 + signal.SIGKILL, 128 + signal.SIGXCPU):
        faults.append("does not end")
    elif code not in DOCUMENTED:
        faults.append(f"exit code {code}")
    if CRASH.search(words):
        faults.append("crash or defect")
    if code not in (0, 124, None) and not words.strip():
        faults.append("no message")
    if len(output) > 1 << 20:
        faults.append("prints without end")
    after = digest(folder, kind.output or "")
    changed = [path.name for path, bytes_before in before.items() if after.get(path) != bytes_before]
    if changed:
        faults.append(f"changed {changed}")
    new = [path.name for path in after if path not in before and path.name not in ("s.md.h5",)]
    if new:
        faults.append(f"left {new}")
    if code and kind.output == "out" and (folder / "out").exists() and kind_name in ("ls_dyna", "mpm3d"):
        faults.append("wrote although it refused")
    if faults:
        kept = options.folder / "faults" / str(number)
        shutil.rmtree(kept, ignore_errors=True)
        shutil.copytree(folder, kept, symlinks=True)
        (kept / "WHAT.txt").write_text(f"{kind_name}: {'; '.join(faults)}\n{' '.join(command)}\n\n{words[-4000:]}")
    shutil.rmtree(folder, ignore_errors=True)
    return code, seconds, "; ".join(faults)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("whipple", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--count", type=int, default=1000, help="mutants in all, those done before included")
    parser.add_argument("--kinds", default="", help="some of the kinds, with commas (default: all)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=1e9, help="end after this time")
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    options.whipple, options.folder = options.whipple.resolve(), options.folder.resolve()
    options.folder.mkdir(parents=True, exist_ok=True)
    all_kinds = kinds(options.whipple, options.folder / "base")
    names = options.kinds.split(",") if options.kinds else list(all_kinds)
    if unknown := set(names) - set(all_kinds):
        parser.error(f"unknown kinds {sorted(unknown)}; known: {', '.join(all_kinds)}")
    table = options.folder / "outcomes.csv"
    done = collections.defaultdict(list)
    if table.exists():
        with table.open(newline="") as file:
            for row in csv.reader(file):
                done[int(row[0])] = row
    begin = time.monotonic()
    numbers = [n for n in range(options.count) if n not in done]

    def one(number):
        if time.monotonic() - begin > options.seconds:
            return None
        name = random.Random(f"{options.seed} {number}").choices(names, [SHARES[name] for name in names])[0]
        return [number, name, *trial(number, name, all_kinds[name], options)]

    with table.open("a", newline="") as file, concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for row in pool.map(one, numbers):
            if row is None:
                continue
            csv.writer(file).writerow(row)
            file.flush()
            done[row[0]] = list(map(str, row))
            if row[4]:
                print(f"{row[0]} {row[1]}: {row[4]}", flush=True)
    counts = collections.defaultdict(collections.Counter)
    for row in done.values():
        counts[row[1]]["fault" if row[4] else row[2]] += 1
    print(f"{'kind':<12}{'inputs':>8}{'0':>8}{'2':>8}{'3':>8}{'faults':>8}")
    for name, count in sorted(counts.items()):
        print(f"{name:<12}{sum(count.values()):>8}{count['0']:>8}{count['2']:>8}{count['3']:>8}{count['fault']:>8}")
    faults = sum(count["fault"] for count in counts.values())
    print(f"{len(done)} inputs, {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
