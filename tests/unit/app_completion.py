# SPDX-License-Identifier: BSD-3-Clause
"""Completion, manual page and version come from the program's own parser: each shell that is installed completes
subcommands, options, the words of an option, names of models and materials, and leaves files to itself; the manual page has
every option without a complaint of man; the version names the libraries that are linked, with their licences. Exit code 77 if all else holds, but a
shell or man is missing.

Usage: app_completion.py WHIPPLE FOLDER
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

from checks import require

WHIPPLE, FOLDER = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
LINES = (  # (line, candidates among others, no candidates)
    (["ru"], {"run"}, {"report", "complete"}),
    (["export", "--fo"], {"--format"}, {"--fields"}),
    (["export", "--format", ""], {"vtu", "csv"}, {"--format"}),
    (["-q", "eos", "h"], {"hugoniot"}, {"materials"}),
    (["completion", ""], {"bash", "zsh", "fish"}, set()),
    (["describe", "s"], {"shape", "strength", "study"}, {"case"}),
    (["describe", "eos", "gr"], {"gray"}, {"sphere"}),
    (["eos", "hugoniot", "copper", "tanta"], {"tantalum"}, {"copper"}),
)
ONE_WORD = ["export", "--format=v"], {"--format=vtu"}, {"vtu", "--format=csv"}
THREE_WORDS = ["export", "--format", "=", "v"], {"vtu"}, {"csv", "--format=vtu"}  # as bash parts it
# Libraries by the beginning of the file that the executable needs.
LINKED = {"libudunits2": "UDUNITS", "libz": "zlib", "libp4est": "p4est", "libsc": "libsc", "libhdf5": "HDF5", "libmpi": "MPI",
          "libspdlog": "spdlog", "libfmt": "fmt", "libgomp": "GCC", "libstdc++": "GCC", "libgcc_s": "GCC", "libasan": "GCC",
          "libubsan": "GCC", "libtsan": "GCC", "liblsan": "GCC", "libm": "glibc", "libmvec": "glibc", "libc": "glibc",
          "ld": "glibc"}
INCLUDED = {"Eigen", "CLI11", "json", "toml++", "Boost"}


def output(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)
    require(done.returncode == 0, f"{command}: {done.returncode}\n{done.stderr}")
    return done.stdout


def check_program():
    for words, among, not_among in (*LINES, ONE_WORD, THREE_WORDS):
        found = set(output(WHIPPLE, "complete", "--", *words).split("\n")) - {""}
        require(among <= found and not not_among & found, f"{words}: {sorted(found)}")
    require(output(WHIPPLE, "complete", "--", "run", "cas") == "", "a file is no word")
    done = subprocess.run([WHIPPLE, "completion", "ksh"], capture_output=True, text=True, check=False)
    require(done.returncode == 2 and "zsh" in done.stderr, f"an unknown shell: {done.returncode} {done.stderr}")
    require("complete " not in output(WHIPPLE, "--help"), "the help shows what is for shells only")


def check_shells():
    """Return the shells that are missing."""
    missing = []
    environment = os.environ | {"PATH": f"{WHIPPLE.parent}:{os.environ['PATH']}", "HOME": str(FOLDER)}
    asks = {
        "bash": lambda words: ["bash", "--norc", "-c", f"source whipple.bash; COMP_WORDS=(whipple {' '.join(w or chr(39) * 2 for w in words)});"
                               f" COMP_CWORD={len(words)}; _whipple; printf '%s\\n' \"${{COMPREPLY[@]}}\""],
        "zsh": lambda words: ["zsh", "-f", "-c", "compdef() { :; }; compadd() { print -l -- ${(P)2}; }; _files() { print FILES; };"
                              f" source ./whipple.zsh; words=(whipple {' '.join(w or chr(39) * 2 for w in words)}); CURRENT={len(words) + 1}; _whipple"],
        "fish": lambda words: ["fish", "--no-config", "-c", f"source whipple.fish; complete -C 'whipple {' '.join(words)}'"],
    }
    for shell, ask in asks.items():
        (FOLDER / f"whipple.{shell}").write_text(output(WHIPPLE, "completion", shell), encoding="utf-8")
        if shutil.which(shell) is None:
            missing.append(shell)
            continue
        for words, among, not_among in (*LINES, THREE_WORDS if shell == "bash" else ONE_WORD):
            found = {line.split("\t")[0] for line in output(*ask(words), cwd=FOLDER, env=environment).split("\n")}
            require(among <= found and not not_among & found, f"{shell}: {words}: {sorted(found)}")
        print(f"{shell}: {len(LINES) + 1} lines completed")
    return missing


def check_manual():
    """Return the programs that are missing."""
    text = output(WHIPPLE, "man")
    page = FOLDER / "whipple.1"
    page.write_text(text, encoding="utf-8")
    for name in re.findall(r"^  (\w+) ", output(WHIPPLE, "--help").partition("Subcommands:")[2].partition("Example:")[0], re.MULTILINE):
        require(f'.SS "{name}"' in text, f"no section of {name}")
    require("\\-\\-preview" in text and '.SS "eos hugoniot"' in text, "options and subcommands of subcommands")
    if shutil.which("man") is None:
        return ["man"]
    done = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", str(page)], capture_output=True, text=True, check=False)
    require(done.returncode == 0 and not done.stderr, f"man: {done.stderr[:500]}")
    require("--preview" in re.sub(".\b", "", done.stdout).replace("\x1b[0m", ""), "an option in the page as it is read")
    return []


def check_version():
    told = json.loads(output(WHIPPLE, "version", "--json"))
    licences = {library["name"]: library["licence"] for library in told["libraries"]}
    require(licences["p4est"] == "GPL-2.0-or-later" == told["licence_of_executable"], f"{told}")
    require(told["kernels"] in ("scalar", "portable", "AVX2", "AVX-512") and all(library["version"] for library in told["libraries"]), f"{told}")
    files = re.findall(r"\(NEEDED\).*\[(.+)\]", output("readelf", "-d", WHIPPLE))
    needed = {re.split(r"[.-]|_openmpi", file)[0] for file in files}
    require(needed and needed <= set(LINKED), f"libraries without a name here: {sorted(needed - set(LINKED))}")
    linked = {LINKED[file] for file in needed}
    require(linked | INCLUDED == set(licences), f"linked {sorted(linked)}, included {sorted(INCLUDED)}, named {sorted(licences)}")
    text = output(WHIPPLE, "version")
    require(all(name in text for name in licences) and told["revision"] in text, text)


FOLDER.mkdir(parents=True, exist_ok=True)
check_program()
absent = check_shells() + check_manual()
check_version()
if absent:
    print(f"SKIPPED: {', '.join(absent)}: not here")
    sys.exit(77)
