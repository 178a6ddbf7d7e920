# SPDX-License-Identifier: BSD-3-Clause
"""The program for another processor: cross-compiled for arm64 (preset aarch64) with the libraries of an unpacked Debian, run by QEMU.
Tests of registers, equations of state, materials, transfers and elements pass there, and those with exact solutions; a small impact
and the points of a small simulation of atoms are those of this processor but for round-off, whose figure is printed.

As root, with what `scripts/install_deps.sh --roots` installs and a mirror of Debian, therefore only if WHIPPLE_DEBIAN_MIRROR is set
(to a mirror, or to "default"); otherwise the exit code is 77. Half an hour of two cores for the first time, with ccache minutes.

Usage: other_processor.py WHIPPLE ROOT FOLDER
"""
import os
import pathlib
import sys

WHIPPLE, ROOT, FOLDER = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
sys.path[:0] = [str(ROOT / path) for path in ("tests/unit", "tests/installed", "scripts")]
from checks import require  # noqa: E402
from debian_root import library_packages, unpack_root  # noqa: E402
from roots import MPI_ALONE, call, mirror_or_skip, same_impact  # noqa: E402

EMULATOR, COMPILER = "qemu-aarch64-static", "aarch64-linux-gnu-g++-12"
# Executables, and which of their tests: seconds here, minutes under emulation. Left out: what starts other programs.
TESTS = {"base_test": "*-*Files*", "eos_test": "*-EosTableError*", "test_material": "*", "test_transfer": "*", "test_fem": "*",
         "test_exact": "*-*Fine*"}


def settings():
    return os.environ | MPI_ALONE | {"LAMMPS_POTENTIALS": str(FOLDER / "debian/usr/share/lammps/potentials")}


def build(mirror):
    root = FOLDER / "debian"
    if not (root / "usr/include/lammps").is_dir():
        unpack_root(root, "arm64", packages=library_packages(), mirror=mirror)
    call("cmake", "--preset", "aarch64", "-S", ROOT, "-B", FOLDER / "build", f"-DWHIPPLE_SYSROOT={root}", cwd=ROOT)
    call("cmake", "--build", FOLDER / "build", "--parallel", len(os.sched_getaffinity(0)), "--target", "whipple", "whipple-md", *TESTS)
    return (EMULATOR, "-L", root)


def main():
    emulated = build(mirror_or_skip("cross-compilation for arm64", EMULATOR, COMPILER))
    told = call(*emulated, FOLDER / "build/bin/whipple", "version", env=settings())
    require("kernels   portable" in told, told)
    for name, wanted in TESTS.items():
        told = call(*emulated, FOLDER / "build/tests/bin" / name, f"--gtest_filter={wanted}", "--gtest_brief=1", env=settings(), cwd=FOLDER)
        print(f"{name}: {told.strip().splitlines()[-1]}", flush=True)
    same_impact(ROOT, (WHIPPLE,), (*emulated, FOLDER / "build/bin/whipple"), FOLDER)


main()
