#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""What whipple-md costs beyond LAMMPS: runs a plan of isotherm points, then the very commands that the store keeps of each point
with the plain `lmp`, and compares processor times (a busy machine hardly changes them).

Usage: studies/md_speed/md_speed.py [--bin build/release/bin] [--points 6] [--cells 6] [--steps 3000] [--repeat 3]
"""
import argparse
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

import h5py

ROOT = pathlib.Path(__file__).resolve().parents[2]
POTENTIALS = pathlib.Path("/usr/share/lammps/potentials")
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1", "LAMMPS_POTENTIALS": str(POTENTIALS), "OMPI_ALLOW_RUN_AS_ROOT": "1",
               "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def processor_seconds(command, folder):
    """User and system time of a program and of what it starts."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, cwd=folder, env=ENVIRONMENT, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def plan(options):
    ratios = ", ".join(f"{1.0 - 0.02 * i:.2f}" for i in range(options.points))
    return (f'title = "speed"\nelement = "Cu"\npotential = "copper_universal_3"\nseed = 1\n[[isotherm]]\n'
            f'temperature = "293 K"\nvolume_ratio = [{ratios}]\ncells = {options.cells}\n'
            f"equilibration_steps = {options.steps // 4}\nsteps = {options.steps}\n")


def commands_of_points(store):
    with h5py.File(store) as file:
        return [point["provenance"].attrs["lammps_commands"].decode() for point in file["points"].values()]


def steps_of(commands):
    return sum(int(steps) for steps in re.findall(r"^run (\d+)", commands, flags=re.MULTILINE))


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    parser.add_argument("--points", type=int, default=6)
    parser.add_argument("--cells", type=int, default=6, help="unit cells along each edge")
    parser.add_argument("--steps", type=int, default=3000)
    parser.add_argument("--repeat", type=int, default=3, help="the least time counts")
    options = parser.parse_args(arguments)
    program = (options.bin / "whipple-md").resolve()
    ours, plain = [], []
    for _ in range(options.repeat):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "plan.toml").write_text(plan(options))
            ours.append(processor_seconds([program, "plan.toml", "-o", "store.h5", "--quiet"], folder))
            commands = commands_of_points(folder / "store.h5")
            seconds = 0.0
            for index, text in enumerate(commands):
                (folder / f"{index}.in").write_text(text)
                seconds += processor_seconds(["lmp", "-in", f"{index}.in", "-log", "none", "-screen", "none"], folder)
            plain.append(seconds)
    atom_steps = 4 * options.cells**3 * sum(steps_of(text) for text in commands)
    print(f"{len(commands)} points, {4 * options.cells**3} atoms, {atom_steps:.3g} atom steps")
    print(f"whipple-md {min(ours):.2f} s, {atom_steps / min(ours):.3g} atom steps per second")
    print(f"lmp        {min(plain):.2f} s, {atom_steps / min(plain):.3g} atom steps per second")
    print(f"ratio of processor times, least of {options.repeat}: {min(ours) / min(plain):.3f}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
