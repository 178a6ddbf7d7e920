#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Print registers, stack and spills of the kernels of the graphics processor, as the build has kept them beside gpu.o.

Usage: device_registers.py [LOG...] [--markdown] [--least N] [--check]
  LOG         default: build/release/src/device/gpu.log and gpu_section.log
  --markdown  a table for docs/manual/devices.md
  --least     only kernels with so many registers at least
  --check     exit code 1 if a kernel spills, takes more registers than the bound, or has a stack
"""
import argparse
import pathlib
import re
import subprocess
import sys

# 168: three blocks of 128 threads on a multiprocessor of 65536 registers.
MOST_REGISTERS = 168

ENTRY = re.compile(r"Compiling entry function '(\w+)' for 'sm_(\w+)'")
FRAME = re.compile(r"(\d+) bytes stack frame, (\d+) bytes spill stores, (\d+) bytes spill loads")
USED = re.compile(r"Used (\d+) registers")


def plain(name):
    """Return the functor that a kernel calls, without namespaces."""
    name = re.sub(r"\(anonymous namespace\)::", "", name)
    name = name.replace("whipple::device::", "").replace("whipple::", "")
    name = re.sub(r"BasicLattice<(false|true)>", lambda m: "section" if m.group(1) == "true" else "space", name)
    name = name.replace(" >", ">")
    name = re.sub(r"\((EosKind|StrengthKind)\)(\d+)",
                  lambda m: {"EosKind": ["gruneisen", "table"],
                             "StrengthKind": ["none", "von_mises", "johnson_cook", "steinberg_guinan"]}
                  [m.group(1)][int(m.group(2))], name)
    found = re.match(r"void gpu::(for_each|reduce)<(.*)>\(unsigned long", name)
    if found:
        return f"{found.group(2).strip()}{' (sum)' if found.group(1) == 'reduce' else ''}"
    found = re.search(r"cub::.*?::(Device\w+Kernel)", name) or re.search(r"(Device\w+?Kernel)", name)
    return f"cub {found.group(1)}" if found else name.split("(")[0]


def kernels(log):
    """Return [(name, registers, stack, spilled bytes)] of a log of ptxas -v, the most registers first."""
    found, mangled, frame = [], None, (0, 0)
    for line in log.splitlines():
        if match := ENTRY.search(line):
            mangled, frame = match.group(1), (0, 0)
        elif match := FRAME.search(line):
            frame = (int(match.group(1)), int(match.group(2)) + int(match.group(3)))
        elif (match := USED.search(line)) and mangled:
            found.append((mangled, int(match.group(1)), *frame))
            mangled = None
    names = subprocess.run(["c++filt"], input="\n".join(k[0] for k in found), capture_output=True, text=True,
                           check=True).stdout.splitlines()
    return sorted([(plain(name), *k[1:]) for name, k in zip(names, found)], key=lambda k: (-k[1], k[0]))


def faults(of_kernels):
    texts = []
    for name, registers, stack, spilled in of_kernels:
        if spilled:
            texts.append(f"{name}: spills {spilled} bytes")
        if stack:  # none is needed where all indices are known to the compiler
            texts.append(f"{name}: {stack} bytes of stack")
        if registers > MOST_REGISTERS:
            texts.append(f"{name}: {registers} registers, at most {MOST_REGISTERS}")
    return texts


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("logs", nargs="*", type=pathlib.Path, metavar="LOG",
                        default=[pathlib.Path(f"build/release/src/device/{part}.log") for part in ("gpu", "gpu_section")])
    parser.add_argument("--markdown", action="store_true")
    parser.add_argument("--least", type=int, default=0)
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    of_kernels = []
    for log in options.logs:
        of_log = kernels(log.read_text(errors="replace"))
        if not of_log:
            sys.exit(f"{log}: no kernels: not a log of nvcc -Xptxas -v")
        of_kernels += [kernel for kernel in of_log if kernel not in of_kernels]
    of_kernels.sort(key=lambda kernel: (-kernel[1], kernel[0]))
    wrong, count = faults(of_kernels), len(of_kernels)
    spilling = sum(k[3] > 0 for k in of_kernels)
    of_kernels = [k for k in of_kernels if k[1] >= options.least]
    if options.markdown:
        print("| kernel | registers | stack (bytes) | spills (bytes) |\n| --- | --- | --- | --- |")
        for name, *numbers in of_kernels:
            print(f"| `{name}` | {' | '.join(str(n) for n in numbers)} |")
    else:
        width = max(len(k[0]) for k in of_kernels)
        print(f"{'kernel':<{width}}  registers  stack  spills")
        for name, registers, stack, spilled in of_kernels:
            print(f"{name:<{width}}  {registers:9}  {stack:5}  {spilled:6}")
    for text in wrong:
        print(text, file=sys.stderr)
    print(f"{count} kernels, {spilling} of which spill", file=sys.stderr)
    sys.exit(1 if options.check and wrong else 0)


if __name__ == "__main__":
    main()
