# SPDX-License-Identifier: BSD-3-Clause
"""The program for another processor: cross-compiled for arm64 (preset aarch64) with the libraries of an unpacked Debian, run by QEMU.
Tests of registers, equations of state, transfers, elements and exact solutions pass there; the program finds the shock melting of
copper and its part for atoms starts; a small impact is that of this processor but for round-off, whose figure is printed.

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
from roots import MPI_ALONE, call, mirror_or_skip, same_impact, verdict  # noqa: E402

EMULATOR, COMPILER = "qemu-aarch64-static", "aarch64-linux-gnu-g++-12"
# Executables, and which of their tests: minutes under emulation, twenty times as long as here. None that starts other programs.
TESTS = {"base_test": "*", "eos_test": "EosPorousHugoniot.*:EosReflectedHugoniot.*:EosImpedance.*:EosColdCurve.*:EosMelting.*:EosGasLoci.*:"
                                       "EosCopper.*:EosMetals.*",
         "test_transfer": "*-Conduction.*", "test_fem": "Bars.*:FiniteElementPlanarImpact.*",
         "test_exact": "ExactSolutions.*:ExactGas.SodsShockTube:ExactSolid.ElasticPlasticPiston:Of/ExactImpact.HeatsAndReleases/AlAl3kms"}


def settings():
    return os.environ | MPI_ALONE


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
    told = call(*emulated, FOLDER / "build/bin/whipple", "eos", "hugoniot", "copper", "--to", "300 GPa", "--points", "4", env=settings())
    require("shock melting: onset 221.9" in told, told)
    call(*emulated, FOLDER / "build/bin/whipple-md", "--help", env=settings())
    for name, wanted in TESTS.items():
        told = call(*emulated, FOLDER / "build/tests/bin" / name, f"--gtest_filter={wanted}", "--gtest_brief=1", env=settings(), cwd=FOLDER)
        print(f"{name}: {verdict(told)}", flush=True)
    same_impact(ROOT, (WHIPPLE,), (*emulated, FOLDER / "build/bin/whipple"), FOLDER)


main()
