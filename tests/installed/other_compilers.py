# SPDX-License-Identifier: BSD-3-Clause
"""The program built in Debian 13 with its compilers, GCC and Clang, whose warnings are errors: tests pass there that this one's compiler
passes, and a small impact has the history of this program but for round-off.

As root, with mmdebstrap (scripts/install_deps.sh --roots) and a mirror of Debian, therefore only if WHIPPLE_DEBIAN_MIRROR is set (to a
mirror, or to "default"); otherwise the exit code is 77. Half an hour of two cores for each compiler.

Usage: other_compilers.py WHIPPLE ROOT FOLDER [gcc] [clang]
"""
import os
import pathlib
import sys

WHIPPLE, ROOT, FOLDER = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
sys.path[:0] = [str(ROOT / path) for path in ("tests/unit", "tests/installed", "scripts")]
from debian_root import ENVIRONMENT, build_packages, inside, make_root  # noqa: E402
from roots import MPI_ALONE, call, mirror_or_skip, same_impact, verdict  # noqa: E402

COMPILERS = {"gcc": ("gcc", "g++"), "clang": ("clang", "clang++")}
TESTS = ("base_test", "eos_test", "test_material", "test_transfer", "test_fem", "test_exact")


def main():
    wanted = sys.argv[4:] or list(COMPILERS)
    mirror = mirror_or_skip("compilers of Debian 13")
    root = FOLDER / "debian"
    if not (root / "usr/bin/cmake").exists():
        make_root(root, "trixie", [*build_packages(), "clang", "libomp-dev"], mirror)
    within = inside(root, ROOT)
    for name in wanted:
        c, cxx = COMPILERS[name]
        build = f"/build/{name}"
        call(*within, "cmake", "-G", "Ninja", "-S", "/source", "-B", build, "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_C_COMPILER={c}",
             f"-DCMAKE_CXX_COMPILER={cxx}", env=ENVIRONMENT)
        call(*within, "cmake", "--build", build, "--parallel", len(os.sched_getaffinity(0)), "--target", "whipple", "whipple-md",
             "whipple-fit", *TESTS, env=ENVIRONMENT)
        print(call(*within, cxx, "--version", env=ENVIRONMENT).splitlines()[0])
        settings = ENVIRONMENT | MPI_ALONE
        for test in TESTS:
            told = call(*within, f"{build}/tests/bin/{test}", "--gtest_filter=*-*Fine*", "--gtest_brief=1", env=settings)
            print(f"  {test}: {verdict(told)}", flush=True)
        same_impact(ROOT, (WHIPPLE,), (*within, f"{build}/bin/whipple"), FOLDER, "/source", root)


main()
