#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Check which module depends on which: the layers of docs/manual/architecture.md, from #include lines, CMake
dependencies and imports of Python; include cycles, comparisons with texts, and the size of source files.

Usage: check_layers.py [ROOT]      check the tree (default: the one that this script belongs to)
       check_layers.py --self-test  check that every rule finds its violation in a tree made for it
"""
import os
import pathlib
import re
import sys
import tempfile

# Module (folder) -> the modules that it may use. A module may always use itself. The order is that of the layers.
MAY_USE = {
    "src/core/base": [],
    "src/core/input": ["src/core/base"],
    "src/core/parallel": ["src/core/base"],
    "src/core/process": ["src/core/base"],
    "src/core/hdf5": ["src/core/base", "src/core/parallel"],
    "eos": ["src/core/base"],
    # Curves and comparisons with measurements, returned as data.
    "eos/curves": ["src/core/base", "eos"],
    "eos/experiments": ["src/core/base", "eos"],
    "eos/files": ["src/core/base", "src/core/hdf5", "eos"],
    "md_fitting/data_set": ["src/core/base", "src/core/hdf5"],
    # Reads the store and starts whipple-md as a process: no LAMMPS on the solver's side.
    "md_fitting/simulated_crystal": ["src/core/base", "src/core/process", "eos", "md_fitting/data_set"],
    # Constants of metals that no simulation determines: eos/data/elements.toml.
    "md_fitting/elements": ["src/core/base", "src/core/input", "src/core/process"],
    "src/particles": ["src/core/base", "src/core/parallel"],
    "src/grid": ["src/core/base", "src/core/parallel"],
    "src/material": ["src/core/base", "src/core/input", "eos", "eos/files", "src/particles"],
    # The update of one material point, for the host and for kernels of a graphics processor.
    "src/device/material": ["src/core/base", "eos", "src/particles", "src/material"],
    "src/transfer": ["src/core/base", "src/core/parallel", "src/particles", "src/grid"],
    # The step on a graphics processor: kernels of single points and nodes, and their engine.
    "src/device": ["src/core/base", "src/core/parallel", "eos", "src/particles", "src/material", "src/transfer",
                   "src/device/material"],
    # The program that compares a device with stored states, on machines that have nothing but a compiler.
    "src/device/check": ["src/core/base", "src/device", "src/device/material"],
    "src/fem": ["src/core/base", "src/core/parallel", "src/particles", "src/material"],
    "src/contact": ["src/core/base", "src/core/parallel", "src/particles", "src/grid", "src/transfer", "src/fem"],
    "src/afemp": ["src/core/base", "src/core/parallel", "src/particles", "src/grid", "src/material", "src/transfer", "src/fem"],
    # Implicit load steps without inertia: equilibrium on the grid.
    "src/quasi_static": ["src/core/base", "src/core/parallel", "src/particles", "src/grid", "src/material", "src/transfer"],
    "src/io": ["src/core/base", "src/core/parallel", "src/core/hdf5", "src/particles", "src/grid", "src/material", "src/fem"],
    # Solids from files of other programs, and generated ones.
    "src/solids": ["src/core/base", "src/core/parallel"],
    "src/case": ["src/core/base", "src/core/input", "src/core/parallel", "src/solids", "eos", "eos/files", "src/particles", "src/grid", "src/material",
                  "src/transfer", "src/fem", "src/contact", "src/io"],
    "src/solver": ["src/core/base", "src/core/parallel", "eos", "src/particles", "src/grid", "src/material", "src/transfer",
                   "src/device", "src/device/material", "src/fem", "src/contact", "src/afemp", "src/quasi_static", "src/io", "src/case"],
    # Reads what runs wrote, with the keys of a case; knows no solver.
    "src/analysis": ["src/core/base", "src/core/parallel", "src/core/hdf5", "src/grid", "src/material", "src/case"],
    # The loop around the solver: what a run writes, and what may be asked of it.
    "src/run": ["src/core/base", "src/core/input", "src/core/parallel", "eos", "src/particles", "src/grid", "src/material", "src/fem",
                "src/device", "src/io", "src/analysis", "src/case", "src/solver"],
    # Times the solver.
    "src/bench": ["src/core/base", "src/core/parallel", "src/core/process", "src/particles", "src/grid", "src/material", "src/transfer", "src/device",
                  "src/device/check", "src/io", "src/case", "src/solver"],
    # Many runs of a case as other processes, and the table of what they wrote.
    "src/sweep": ["src/core/base", "src/core/input", "src/core/process", "src/core/hdf5", "src/grid", "src/material", "src/io", "src/case",
                  "src/analysis", "src/run"],
    # Packs what runs wrote for the browser.
    "src/view": ["src/core/base", "src/grid", "src/io", "src/analysis"],
    # The page of running simulations and its server.
    "src/monitor": ["src/core/base", "src/core/process", "src/io", "src/analysis", "src/view", "src/run"],
    # The page that edits a case; checks are other processes.
    "src/editor": ["src/core/base", "src/core/input", "src/core/process", "src/monitor"],
    # Writes cases from the decks of other codes, as text, and cards for these codes; looks heat capacities up in the material
    # library.
    "src/decks": ["src/core/base", "src/core/input", "eos", "src/material"],
    # Ballistic limit equations, tables of shots, and the text of cases of shields.
    "src/shields": ["src/core/base", "src/core/input"],
    "md_fitting/plan": ["src/core/base", "src/core/input"],
    "md_fitting/lammps": ["src/core/base", "md_fitting/data_set"],
    "md_fitting/protocols": ["src/core/base", "eos", "md_fitting/data_set", "md_fitting/plan", "md_fitting/lammps"],
    # Copies strength and failure from materials of the library.
    "md_fitting/fit": ["src/core/base", "src/core/input", "src/core/process", "eos", "eos/experiments", "src/material", "md_fitting/data_set",
                       "md_fitting/elements", "md_fitting/plan"],
    # The program whipple-md.
    "md_fitting": ["src/core/base", "md_fitting/elements", "md_fitting/data_set", "md_fitting/plan", "md_fitting/lammps", "md_fitting/protocols"],
    # The program whipple: it starts the other two, so of their side it knows the plan's keys and the source that asks
    # whipple-md for states.
    "src/app": ["src/core/base", "src/core/input", "src/core/parallel", "src/core/process", "eos", "eos/curves", "eos/experiments", "eos/files",
                "src/particles", "src/grid", "src/material",
                "src/transfer", "src/io", "src/analysis", "src/view", "src/monitor", "src/editor", "src/decks", "src/shields", "src/case", "src/solver", "src/run", "src/sweep", "src/bench", "src/solids",
                "md_fitting/elements", "md_fitting/plan",
                "md_fitting/simulated_crystal"],
    # The Python module whipple.eos: no MPI, no grid.
    "python": ["src/core/base", "eos", "eos/curves", "eos/experiments", "eos/files", "src/material"],
}

# CMake library -> module, where the name is not the last part of the folder.
LIBRARY_OF = {"whipple_md_data_set": "md_fitting/data_set", "whipple_md_elements": "md_fitting/elements", "whipple_md_plan": "md_fitting/plan",
              "whipple_md_lammps": "md_fitting/lammps", "whipple_md_protocols": "md_fitting/protocols",
              "whipple_device_material": "src/device/material", "whipple_device_check": "src/device/check",
              "whipple_fit": "md_fitting/fit", "whipple_eos": "eos", "whipple_eos_curves": "eos/curves",
              "whipple_eos_experiments": "eos/experiments", "whipple_eos_files": "eos/files",
              "whipple_md_simulated_crystal": "md_fitting/simulated_crystal"}

VERSION_QUERY = "src/app/version_command.cpp"  # asks the libraries for their version, nothing else

# Folder of Python -> the others that it may import.
PYTHON_MAY_USE = {"report": [], "studies": ["report"], "scripts": ["report", "studies"]}

# What is allowed in a few places only: (name, pattern of the line, the places).
CONFINED = [
    ("an OpenMP pragma", re.compile(r"^\s*#\s*pragma\s+omp|\b_Pragma\s*\(\s*\"omp"), ["src/core/parallel"]),
    ("OpenMP's interface", re.compile(r"^\s*#\s*include\s*<omp\.h>"), ["src/core/parallel"]),
    ("an MPI call", re.compile(r"\bP?MPI_[A-Z][a-z]\w*\s*\("),
     ["src/core/parallel", "src/grid", "src/io", VERSION_QUERY, "md_fitting/lammps", "md_fitting/protocols",
      "md_fitting/md_worker.cpp"]),
    ("the world of all ranks", re.compile(r"\bparallel::world\s*\("), ["src/core/parallel", "src/app"]),
    ("toml++", re.compile(r"^\s*#\s*include\s*[<\"]toml\+\+"), ["src/core/input"]),
    ("GSL", re.compile(r"^\s*#\s*include\s*[<\"]gsl/"), ["md_fitting/fit"]),
    ("LAMMPS", re.compile(r"^\s*#\s*include\s*[<\"](lammps/|library\.h)"), ["md_fitting/lammps"]),
    ("HDF5", re.compile(r"^\s*#\s*include\s*[<\"](hdf5|H5\w+)\.h"), ["src/core/hdf5", VERSION_QUERY]),
    ("p4est", re.compile(r"^\s*#\s*include\s*[<\"](p[48]est\w*|sc(_\w+)?)\.h"), ["src/grid", VERSION_QUERY]),
    ("network", re.compile(r"^\s*#\s*include\s*[<\"]boost/(asio|beast)"), ["src/monitor"]),
    ("pybind11", re.compile(r"^\s*#\s*include\s*<pybind11/"), ["python"]),
    ("UDUNITS2", re.compile(r"^\s*#\s*include\s*[<\"]udunits2\.h"), ["src/core/base"]),
]

# Words end at the border: code decides by enumerations, whose words are declared with them (src/core/base/words.hpp), not
# by comparing with a text. Where texts of others are read or written, they are compared:
WORD_COMPARISON = re.compile(r'[=!]=\s*"|"\s*[=!]=')
WORDS_ALLOWED = {
    "python/eos/module.cpp": "keys of material files",
    "src/case": "keys and words of case files",
    "src/core": "reads and checks words",
    "src/device/check/options.cpp": "options, without a library for them",
    "src/decks": "grammars and cards of other codes' decks",
    "eos/experiments/measured_table.cpp": "heads and empty cells of tables of measurements",
    "md_fitting/fit/constant_list.cpp": "the unit 1",
    "md_fitting/fit/gray_fit.cpp": "names of fitted constants",
    "md_fitting/fit/material_writer.cpp": "writes and copies TOML",
    "md_fitting/lammps/potential.cpp": "pair styles of LAMMPS",
    "src/app/materials_table.cpp": "groups of the material library, which are folders",
    "src/fem/gmsh.cpp": "grammar of Gmsh",
    "src/fem/vtk_legacy.cpp": "grammar of VTK",
    "src/fem/vtk_xml.cpp": "grammar of VTK",
    "src/io/snapshot_table.cpp": "the unit 1",
    "src/material/material_file.cpp": "endings of file names",
    "src/monitor/site.cpp": "header fields of HTTP",
    "src/monitor/folder.cpp": "endings of file names",
    "src/run/directory_control.cpp": "endings of file names",
    "src/solids": "grammars of surfaces, images and tables",
    "src/sweep/quantities.cpp": "the unit 1",
    "src/app/shield_command.cpp": "endings of file names",
    "src/sweep/results.cpp": "the unit 1",
    "src/run/run.cpp": "the file name case.toml",
}

# A source file, and a header, has at most so many lines.
MOST_LINES, MOST_LINES_OF_HEADER = 500, 250
OWN_FOLDERS = ("src", "eos", "md_fitting", "python", "tests", "report", "scripts", "studies", "examples")
OWN_ENDINGS = {".hpp", ".cpp", ".h", ".py", ".sh", ".cmake"}

PYTHON_IMPORT = re.compile(rf"^\s*(?:from|import)\s+({'|'.join(PYTHON_MAY_USE)})\b")
INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"')
SOURCE_ENDINGS = {".hpp", ".cpp", ".h", ".in"}


def module_of(path):
    """Longest known folder that holds the path; None outside of the layers."""
    for folder in [path, *path.parents]:
        if str(folder) in MAY_USE:
            return str(folder)
    return None


def code_lines(text):
    """Lines without comments; line numbers stay."""
    text = re.sub(r"/\*.*?\*/", lambda found: "\n" * found.group(0).count("\n"), text, flags=re.DOTALL)
    for number, line in enumerate(text.splitlines(), start=1):
        yield number, re.sub(r"//.*", "", line)


def sources(root):
    for folder in ("src", "eos", "md_fitting", "python"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in SOURCE_ENDINGS and path.is_file():
                yield path.relative_to(root)


def confined_to(path, places):
    return any(str(path) == place or place in map(str, path.parents) for place in places)


def check_sources(root):
    faults = []
    includes = {}
    for path in sources(root):
        module = module_of(path)
        if module is None:
            faults.append(f"{path}: this folder is in no layer: add it to MAY_USE and to docs/manual/architecture.md")
            continue
        includes[path] = []
        for number, line in code_lines((root / path).read_text(encoding="utf-8")):
            for name, pattern, places in CONFINED:
                if pattern.search(line) and not confined_to(path, places):
                    faults.append(f"{path}:{number}: {name} outside of {', '.join(places)}")
            if WORD_COMPARISON.search(line) and path.stem != "catalogue" and not confined_to(path, WORDS_ALLOWED):
                faults.append(f"{path}:{number}: compares with a text; an enumeration decides (src/core/base/words.hpp)")
            found = INCLUDE.match(line)
            if not found:
                continue
            target = pathlib.PurePosixPath(found.group(1))
            used = module_of(target)
            if used is None or not (root / target).exists():
                faults.append(f"{path}:{number}: \"{target}\" is no file of a layer; include from the repository root")
                continue
            includes[path].append(target)
            if used != module and used not in MAY_USE[module]:
                faults.append(f"{path}:{number}: {module} may not use {used} (\"{target}\")")
    return faults + cycles(includes)


def cycles(includes):
    """Include cycles, each reported once."""
    graph = {str(path): [str(target) for target in targets] for path, targets in includes.items()}
    faults, finished = [], set()

    def visit(node, trail):
        if node in trail:
            faults.append("include cycle: " + " -> ".join(trail[trail.index(node):] + [node]))
            return
        if node in finished:
            return
        for target in graph.get(node, []):
            visit(target, trail + [node])
        finished.add(node)

    for node in graph:
        visit(node, [])
    return faults


def check_allowed_words(root):
    """Each file that may compare with texts does so: the list grows no stale entries."""
    faults = []
    for name in WORDS_ALLOWED:
        path = root / name
        if path.is_file() and not any(WORD_COMPARISON.search(line)
                                      for _, line in code_lines(path.read_text(encoding="utf-8"))):
            faults.append(f"WORDS_ALLOWED: {name} compares with no text any more")
    return faults


def check_cmake(root):
    """The DEPENDS of each whipple_library repeat the table."""
    faults = []
    for path in sorted(root.rglob("CMakeLists.txt")):
        relative = path.relative_to(root)
        module = module_of(relative.parent)
        if module is None or relative.parts[0] not in ("src", "eos", "md_fitting"):
            continue
        text = re.sub(r"#.*", "", path.read_text(encoding="utf-8"))
        for body in re.findall(r"whipple_library\s*\(([^)]*)\)", text):
            for library in re.findall(r"\bwhipple_\w+", body.partition("DEPENDS")[2]):
                name = library.removeprefix("whipple_")
                used = LIBRARY_OF.get(library, f"src/core/{name}" if f"src/core/{name}" in MAY_USE else f"src/{name}")
                if used not in MAY_USE:
                    faults.append(f"{relative}: {library} is in no layer")
                elif used != module and used not in MAY_USE[module]:
                    faults.append(f"{relative}: {module} may not link {library}")
    return faults


def check_python(root):
    """Each folder of Python imports those of PYTHON_MAY_USE alone."""
    faults = []
    for folder, uses in PYTHON_MAY_USE.items():
        for path in sorted((root / folder).rglob("*.py")):
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1):
                found = PYTHON_IMPORT.match(line)
                if found and found.group(1) not in (folder, *uses):
                    faults.append(f"{path.relative_to(root)}:{number}: {folder} may not import {found.group(1)}")
    return faults


def check_sizes(root):
    """No source file is longer than MOST_LINES, no header longer than MOST_LINES_OF_HEADER."""
    faults = []
    for folder in OWN_FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in OWN_ENDINGS or not path.is_file():
                continue
            name = path.relative_to(root).as_posix()
            lines = path.read_text(encoding="utf-8").count("\n")
            most = MOST_LINES_OF_HEADER if path.suffix == ".hpp" else MOST_LINES
            if lines > most:
                faults.append(f"{name}: {lines} lines, at most {most}: split it by subject")
    return faults


def check_executable(root):
    """A script that names its interpreter can be started by its name, as the documents do."""
    return [f"{path.relative_to(root).as_posix()}: begins with #! and is not executable: chmod +x"
            for folder in ("scripts", "studies", "report", "tests", "web") for ending in ("*.py", "*.sh")
            for path in sorted((root / folder).rglob(ending))
            if "node_modules" not in path.parts and path.read_bytes().startswith(b"#!") and not os.access(path, os.X_OK)]


def check_table():
    """The table has an order: a module uses none that stands behind it."""
    order = {module: place for place, module in enumerate(MAY_USE)}
    return [f"MAY_USE: {module} uses {used}, which stands behind it" for module, uses in MAY_USE.items()
            for used in uses if order[used] > order[module]]


def check(root):
    return check_table() + check_sources(root) + check_allowed_words(root) + check_cmake(root) + check_python(root) + \
        check_sizes(root) + check_executable(root)


def self_test():
    """Each bad file must be found, and for the expected reason."""
    bad = {
        "src/core/base/upward.hpp": ('#include "src/solver/simulation.hpp"\n', "src/core/base may not use src/solver"),
        "eos/reads_files.cpp": ('#include "src/core/input/document.hpp"\n', "eos may not use src/core/input"),
        "eos/models/starts_md.cpp": ('#include "md_fitting/simulated_crystal/worker_source.hpp"\n',
                                     "eos may not use md_fitting/simulated_crystal"),
        "src/material/reads_store.cpp": ('#include "md_fitting/data_set/data_set.hpp"\n',
                                         "src/material may not use md_fitting/data_set"),
        "eos/files/starts_programs.cpp": ('#include "src/core/process/mpirun.hpp"\n',
                                          "eos/files may not use src/core/process"),
        "eos/models/knows_particles.hpp": ('#include "src/particles/p.hpp"\n', "eos may not use src/particles"),
        "src/material/knows_grid.cpp": ('#include "src/grid/g.hpp"\n', "src/material may not use src/grid"),
        "src/solver/knows_run.cpp": ('#include "src/run/run.hpp"\n', "src/solver may not use src/run"),
        "src/solver/starts_md.cpp": ('#include "md_fitting/plan/plan.hpp"\n', "src/solver may not use md_fitting/plan"),
        "md_fitting/fit/knows_lammps.cpp": ('#include "md_fitting/lammps/l.hpp"\n',
                                            "md_fitting/fit may not use md_fitting/lammps"),
        "src/grid/pragma.cpp": ("#pragma omp parallel for\n", "an OpenMP pragma outside of"),
        "src/solver/communicates.cpp": ("void f() { MPI_Barrier(c); }\n", "an MPI call outside of"),
        "src/run/world.cpp": ("void f() { g(parallel::world()); }\n", "the world of all ranks outside of"),
        "src/case/toml.cpp": ("#include <toml++/toml.h>\n", "toml++ outside of"),
        "eos/gsl.cpp": ("#include <gsl/gsl_fit.h>\n", "GSL outside of"),
        "src/app/lammps.cpp": ("#include <lammps/library.h>\n", "LAMMPS outside of"),
        "src/solver/hdf5.cpp": ("#include <hdf5.h>\n", "HDF5 outside of"),
        "src/solver/forest.cpp": ("#include <p8est_bits.h>\n", "p4est outside of"),
        "src/material/binds.cpp": ("#include <pybind11/numpy.h>\n", "pybind11 outside of"),
        "src/core/base/relative.cpp": ('#include "upward.hpp"\n', '"upward.hpp" is no file of a layer'),
        "src/solver/words.cpp": ('bool f(S s) { return s == "musl"; }\n', "compares with a text"),
        "eos/models/words.cpp": ('bool f(S s) { return "band" != s; }\n', "compares with a text"),
        "src/run/run.cpp": ("", "src/run/run.cpp compares with no text any more"),
        "src/nowhere/file.cpp": ("", "this folder is in no layer"),
        "src/io/a.hpp": ('#include "src/io/b.hpp"\n', "include cycle: src/io/a.hpp -> src/io/b.hpp -> src/io/a.hpp"),
        "src/transfer/CMakeLists.txt": ("whipple_library(transfer SOURCES a.cpp DEPENDS whipple_material)\n",
                                        "src/transfer may not link whipple_material"),
        "src/solver/long.cpp": ("\n" * 501, "src/solver/long.cpp: 501 lines, at most 500"),
        "src/solver/long.hpp": ("\n" * 251, "src/solver/long.hpp: 251 lines, at most 250"),
        "studies/one/unstartable.py": ("#!/usr/bin/python3\n", "studies/one/unstartable.py: begins with #! and is not executable"),
        "report/knows_studies.py": ("from studies.validation import bands\n", "report may not import studies"),
    }
    good = {
        "src/solver/simulation.hpp": '#include "src/particles/p.hpp"\n// MPI_Barrier(c) in a comment\nMPI_Comm comm;\n',
        "src/case/case.cpp": 'bool f(S s) { return s == "musl"; }\n',
        "src/fem/gmsh.cpp": 'bool f(S s) { return s == "$Nodes"; }\n',
        "eos/catalogue.cpp": 'bool f(S s) { return s == "gray"; }\n',
        "src/solver/texts.cpp": 'S a = "b == c"; // s == "musl"\n',
        "src/run/run.hpp": '#include "src/solver/simulation.hpp"\n',
        "src/core/input/document.hpp": "/* #include <hdf5.h>\n*/\n",
        "src/particles/p.hpp": "", "src/grid/g.hpp": "", "md_fitting/plan/plan.hpp": "", "md_fitting/lammps/l.hpp": "",
        "md_fitting/simulated_crystal/worker_source.hpp": "", "md_fitting/data_set/data_set.hpp": "",
        "src/core/process/mpirun.hpp": "",
        "src/io/b.hpp": '#include "src/io/a.hpp"\n',
        "src/core/hdf5/hdf5.hpp": "#include <hdf5.h>\n",
        "studies/one/one.py": "from report.units import number\nimport reports\n",
    }
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, text in [*good.items(), *((name, text) for name, (text, _) in bad.items())]:
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text, encoding="utf-8")
        faults = check(root)
        missed = [f"{name}: not found: {expected}" for name, (_, expected) in bad.items()
                  if not any(expected in fault and (name in fault or "cycle" in fault) for fault in faults)]
        spurious = [fault for fault in faults if not any(expected in fault for _, expected in bad.values())]
    return missed + [f"spurious: {fault}" for fault in spurious]


def main():
    arguments = sys.argv[1:]
    if arguments in (["-h"], ["--help"]):
        print(__doc__.strip())
        return 0
    if arguments == ["--self-test"]:
        faults = self_test()
        subject = "self-test"
    elif len(arguments) <= 1 and not any(argument.startswith("-") for argument in arguments):
        root = pathlib.Path(arguments[0] if arguments else pathlib.Path(__file__).resolve().parent.parent)
        faults = check(root)
        subject = str(root)
    else:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    for fault in faults:
        print(fault)
    print(f"layers of {subject}: {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
