#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compile all kernels of the graphics processor with clang, to PTX, warnings as errors: a second opinion on their text.

Usage: device_clang.py CLANG CUDA_FOLDER WORK_FOLDER

CUDA 13 has no texture_fetch_functions.h, which the headers of clang include: an empty one takes its place. Its library
CUB lies in include/cccl.
"""
import pathlib
import re
import subprocess
import sys

if len(sys.argv) != 4:
    asked = sys.argv[1:] in (["--help"], ["-h"])
    print(__doc__, file=sys.stdout if asked else sys.stderr)
    sys.exit(0 if asked else 2)
clang, cuda, work = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
root = pathlib.Path(__file__).resolve().parent.parent
(work / "include").mkdir(parents=True, exist_ok=True)
if not any(cuda.glob("**/texture_fetch_functions.h")):
    (work / "include/texture_fetch_functions.h").write_text("")
ptx = work / "gpu.ptx"
command = [clang, "-x", "cuda", "--cuda-device-only", "-S", "--cuda-gpu-arch=sm_90", f"--cuda-path={cuda}",
           "-std=c++20", "-O2", "-Wall", "-Wextra", "-Werror", "-Wno-unknown-cuda-version",
           # the optimiser's own remarks, also on loops of CUB
           "-Wno-pass-failed", "-isystem", str(work / "include")]
for cccl in (cuda / "include/cccl", cuda / "targets/x86_64-linux/include/cccl"):
    if cccl.is_dir():
        command += ["-isystem", str(cccl)]
kernels = set()
for part in ("gpu", "gpu_section"):
    result = subprocess.run([*command, f"-I{root}", str(root / f"src/device/{part}.cu"), "-o", str(ptx)], check=False)
    if result.returncode != 0:
        sys.exit(result.returncode)
    kernels |= set(re.findall(r"\.entry (\w+)", ptx.read_text()))
own = [k for k in kernels if "whipple" in k]
print(f"{len(kernels)} kernels, {len(own)} of the project")
sys.exit(0 if any("MoveParticles" in k for k in own) and any("StrainParticles" in k for k in own) else 1)
