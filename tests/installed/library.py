#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The installed library: a program of its own finds it with find_package, is built and runs; the headers of
cmake/public_headers.txt compile together, and no installed header names a file of the source tree.

Usage: library.py BUILD_FOLDER EXAMPLE_FOLDER C++_COMPILER C_COMPILER
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

BUILD, EXAMPLE, CXX, C = sys.argv[1:]
PROJECT = """cmake_minimum_required(VERSION 3.25)
project(headers LANGUAGES C CXX)
add_subdirectory({example} example)
find_package(whipple REQUIRED)
add_library(headers OBJECT all.cpp)
target_link_libraries(headers PRIVATE whipple::whipple)
"""


def call(*command):
    environment = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    done = subprocess.run(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        raise SystemExit(f"FAILED: {' '.join(map(str, command))}\n{done.stdout}")
    return done.stdout


with tempfile.TemporaryDirectory() as temporary:
    installed = pathlib.Path(temporary) / "installed"
    call("cmake", "--install", BUILD, "--prefix", installed)
    headers = list((installed / "include/whipple").rglob("*.hpp"))
    for header in headers:
        if re.search(r'#include "', header.read_text()):
            raise SystemExit(f"FAILED: {header} includes a header that is not installed under <whipple/...>")
    public = [header for header in headers if "detail" not in header.relative_to(installed).parts]
    together = pathlib.Path(temporary) / "headers"
    together.mkdir()
    # One project of both: most of the time of a configuration goes to what the compiler is.
    (together / "CMakeLists.txt").write_text(PROJECT.format(example=EXAMPLE))
    (together / "all.cpp").write_text("".join(f"#include <{header.relative_to(installed / 'include')}>\n" for header in public))
    build = together / "build"
    call("cmake", "-S", together, "-B", build, f"-DCMAKE_PREFIX_PATH={installed}", f"-DCMAKE_CXX_COMPILER={CXX}",
         f"-DCMAKE_C_COMPILER={C}", "-DCMAKE_BUILD_TYPE=Debug")
    call("cmake", "--build", build)
    output = call(build / "example/plate_impact")
    print(f"{len(public)} public headers, {len(headers) - len(public)} others\n{output}")
    for line in ("GPa by the Hugoniot", "refused: time.end"):
        if line not in output:
            raise SystemExit(f"FAILED: no '{line}' in the output")
