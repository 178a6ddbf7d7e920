#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""whipple-device-check on states of a few steps: it passes, finds a wrong number, and refuses files that are no states; and
it is made of nothing but the project, the standard library and CUDA.

Usage: device_check.py WHIPPLE CHECK COMPILER SOURCE FOLDER
"""
import json
import pathlib
import re
import struct
import subprocess
import sys

whipple, check, compiler, source, folder = sys.argv[1:]
source, folder = pathlib.Path(source), pathlib.Path(folder)
folder.mkdir(parents=True, exist_ok=True)


def run(*command):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)


def expect(condition, text, result=None):
    if condition:
        return
    print(f"FAILED: {text}")
    if result is not None:
        print(result.returncode, result.stdout, result.stderr)
    sys.exit(1)


def check_state(file, *options):
    return run(check, file, "--device", "emulated", "--no-rates", *options)


written = run(whipple, "bench", "sphere_on_friction_wall", "--states", folder, "--quick")
expect(written.returncode == 0, "whipple bench --states", written)
state = folder / "sphere_on_friction_wall.state"
whole = state.read_bytes()

out = folder / "out.json"
passed = check_state(state, "--twice", "--json", out)
expect(passed.returncode == 0, "the emulated device agrees", passed)
found = json.loads(out.read_text())
of_state = found["states"][0]
expect(found["passes"] and of_state["same_bits_twice"] and of_state["steps"] == 20, "results", passed)
expect(of_state["differences_after_first"] and of_state["differences_after_last"],
       "other kernels in the last bits: equal results would be copies")

timed = check_state(state, "--steps", "1", "--sizes", "4e3", "--per-cell", "8,0.25", "--json", out)
expect(timed.returncode == 0, "times", timed)
times = json.loads(out.read_text())["times"]
expect(len(times) == 3 and all(t["step"]["ns_per_particle_step"] > 0.0 for t in times), "times", timed)
for time in times:
    expect(abs(time["estimated_memory_bytes"] / time["memory_bytes"] - 1.0) < 0.1, f"estimate of memory: {time}")

# The last numbers of the file are the totals after all steps; the last one is the unresolved energy.
totals = struct.unpack("<2d", whole[-16:])
for name, part in {"last sum": -8, "a particle": -20000}.items():
    place = len(whole) + part
    number = struct.unpack("<d", whole[place:place + 8])[0]
    changed = folder / "changed.state"
    changed.write_bytes(whole[:place] + struct.pack("<d", 1.001 * number + 1.0) + whole[place + 8:])
    wrong = check_state(changed)
    expect(wrong.returncode == 1 and "BEYOND" in wrong.stdout, f"a changed number is found: {name}", wrong)

for name, content in {"truncated": whole[:-100], "half": whole[:len(whole) // 2], "empty": b"",
                      "another file": b"[domain]\n" * 100, "longer": whole + b"x",
                      "version": whole[:8] + b"\x63" + whole[9:], "sizes": whole[:20] + b"\x01" + whole[21:]}.items():
    file = folder / "wrong.state"
    file.write_bytes(content)
    refused = check_state(file)
    expect(refused.returncode == 2 and str(file) in refused.stderr, f"refused: {name}", refused)
expect(run(check, folder / "none.state").returncode == 2, "a missing file")
expect(run(check, state, "--steps", "x").returncode == 2, "a wrong option")

# Without a card a run on one is refused before it writes anything.
case = source / "tests/data/small_impact.toml"
card = json.loads(run(whipple, "check", case, "--device", "gpu", "--json").stdout)["device"]["card"]
if card is None:
    refused = run(whipple, "run", case, "-o", folder / "run_without_card", "--device", "gpu")
    expect(refused.returncode == 2 and "--device gpu: this" in refused.stderr, "refused without a card", refused)
    expect(not (folder / "run_without_card").exists(), "nothing is written without a card")
    expect(run(whipple, "bench", "taylor_bar", "--device", "gpu").returncode == 2, "bench is refused without a card")

# What the program reads to be compiled.
sources = [source / "src/device/check/main.cpp", source / "src/device/check/states.cpp", source / "src/device/emulated.cpp"]
headers = run(compiler, "-std=c++20", "-fopenmp", "-march=x86-64-v3", f"-I{source}", "-M", *sources)
expect(headers.returncode == 0, "headers", headers)
others = ("fmt", "Eigen", "eigen3", "mpi", "hdf5", "H5", "p4est", "nlohmann", "CLI", "spdlog", "boost", "toml")
of_others = [h for h in re.split(r"[\s\\]+", headers.stdout)
             if h and not h.startswith(str(source)) and any(f"/{o}" in h for o in others)]
expect(not of_others, f"headers of others: {of_others[:5]}")
print(f"{len(whole)} bytes, passed, changed and wrong files found; {len(sources)} sources of the project alone")
