#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that kernels for AVX-512 are complete: no function on 64-byte registers is left as a call.

usage: check_wide_kernels.py LIBRARY.a...

The compiler inlines such a function into the entry of a kernel (`Wide::run`, src/core/base/registers.hpp) only if every
function between them is inlined by force; otherwise it calls it, without a warning, and the kernel becomes slow.
Exit code 1 if an object holds such a function.
"""
import pathlib
import re
import subprocess
import sys

FUNCTION = re.compile(r" [tTwW] ")
REGISTER = "double __vector(8)"


def left_over(library):
    """Functions on wide registers of a library that are not entries."""
    listing = subprocess.run(["nm", "-C", library], check=True, capture_output=True, text=True).stdout
    return sorted({line.split(maxsplit=2)[-1] for line in listing.splitlines()
                   if FUNCTION.search(line) and REGISTER in line and "Wide::run<" not in line})


def main():
    if sys.argv[1:] in (["--help"], ["-h"]):
        print(__doc__)
        return 0
    if len(sys.argv) < 2 or not all(pathlib.Path(name).is_file() for name in sys.argv[1:]):
        print(__doc__, file=sys.stderr)
        return 2
    functions = [(library, name) for library in sys.argv[1:] for name in left_over(library)]
    for library, name in functions:
        print(f"{library}: called, not inlined: {name[:160]}")
    return 1 if functions else 0


if __name__ == "__main__":
    sys.exit(main())
