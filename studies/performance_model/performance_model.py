#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Predicts time per step and efficiency on many cores from what `whipple bench --json` measured on one, and checks itself on
the rank counts that the file holds (README.md of this folder explains the terms).

Usage: studies/performance_model/performance_model.py BENCH.json [--problem lead_impact_million] [--latency 1.5e-6] [--bandwidth 1e9] ...
"""
import argparse
import json
import math
import sys

CELLS = 64            # of a block
NODE_BYTES = 64       # two registers of four doubles
EXCHANGES = 2         # sums to the owners behind the scatter, results back behind gather and material
NEIGHBOURS = 26
COLLECTIVES = 8       # reductions of a step: time step, blocks, errors, ledger, acceleration
POSTS_PER_BYTE = 4.0  # a node is read, packed, unpacked and written


def halo_blocks(blocks):
    """Blocks that a cube of so many blocks borrows: those that its particles reach, one layer on every side."""
    edge = max(blocks, 1.0) ** (1.0 / 3.0)
    return (edge + 2.0) ** 3 - edge ** 3


def interior_share(blocks):
    """Of a cube of so many blocks: those whose particles reach no borrowed block."""
    edge = max(blocks, 1.0) ** (1.0 / 3.0)
    return max(edge - 2.0, 0.0) ** 3 / edge ** 3


def seconds_per_step(particles, cores, kernels, per_block, latency, bandwidth, memory, imbalance):
    """Of `particles` per core on `cores` cores: computation, exchange that is waited for, reductions.

    kernels: seconds per particle and step on a full machine: of the whole step, of the scatter and of gather and material,
    whose interior goes on while messages are under way.
    """
    whole, *behind = kernels
    compute = imbalance * particles * whole
    if cores == 1:
        return compute, 0.0, 0.0
    blocks = particles / per_block
    # A core has no more neighbours, and borrows no more, than there are others.
    halo = min(halo_blocks(blocks), (cores - 1) * blocks)
    bytes_moved = halo * CELLS * NODE_BYTES
    transit = min(NEIGHBOURS, cores - 1) * latency + bytes_moved / bandwidth
    waiting = sum(max(0.0, transit - interior_share(blocks) * particles * kernel) for kernel in behind)
    packing = EXCHANGES * bytes_moved * POSTS_PER_BYTE / memory
    collectives = COLLECTIVES * 2.0 * math.ceil(math.log2(cores)) * latency
    return compute, packing + waiting, collectives


def kernels_of(measurement):
    """Whole step, scatter, gather and material, in seconds per particle and step."""
    stages = {stage["stage"]: 1e-9 * stage["ns_per_particle_step"] for stage in measurement["stages"]}
    return (1e-9 * measurement["ns_per_particle_step"], stages["particles to grid"],
            stages["grid to particles"] + stages["material"])


def measurements(record, problem):
    return {(m["ranks"], m["threads"]): m for m in record["measurements"] if m["problem"] == problem}


def predicted_nanoseconds(measurement, one, latency, bandwidth, imbalance):
    """Per particle and step of a measured configuration, from the measurement on one core; threads of a rank exchange nothing."""
    ranks, cores = measurement["ranks"], measurement["ranks"] * measurement["threads"]
    parts = seconds_per_step(measurement["particles"] / cores, ranks, kernels_of(one), one["particles_per_block"], latency, bandwidth,
                             one["bandwidth_bytes_per_s"], 1.0 if ranks == 1 else imbalance)
    return 1e9 * sum(parts) / measurement["particles"]


def print_table(rows):
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    for row in rows:
        print("| " + " | ".join(cell.rjust(width) for cell, width in zip(row, widths)) + " |")
        if row is rows[0]:
            print("|" + "|".join("-" * (width + 1) + ":" for width in widths) + "|")


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bench", help="file of whipple bench --json")
    parser.add_argument("--problem", default="lead_impact_million")
    parser.add_argument("--latency", type=float, default=1.5e-6, help="s, of a message between two cores")
    parser.add_argument("--bandwidth", type=float, default=4e8, help="bytes/s, of the network for each core")
    parser.add_argument("--machine-latency", type=float, default=5e-7, help="s, within the measured machine")
    parser.add_argument("--machine-bandwidth", type=float, default=4e9, help="bytes/s, between two ranks of it")
    parser.add_argument("--imbalance", type=float, default=1.02, help="work of the busiest core over the mean one")
    options = parser.parse_args(arguments)
    with open(options.bench, encoding="utf-8") as file:
        record = json.load(file)
    known = measurements(record, options.problem)
    if (1, 1) not in known:
        sys.exit(f"{options.bench}: no measurement of {options.problem} on one rank and one thread")
    one = known[(1, 1)]
    kernels = kernels_of(one)
    memory = one["bandwidth_bytes_per_s"]
    per_block = one["particles_per_block"]
    print(f"{options.problem}: {one['ns_per_particle_step']:.0f} ns per particle and step on one core, "
          f"{per_block:.0f} particles per block\n")

    rows = [["ranks", "threads", "ns/particle measured", "predicted", "measured / predicted"]]
    for (ranks, threads), m in sorted(known.items()):
        predicted = predicted_nanoseconds(m, one, options.machine_latency, options.machine_bandwidth, options.imbalance)
        rows.append([str(ranks), str(threads), f"{m['ns_per_particle_step']:.1f}", f"{predicted:.1f}",
                     f"{m['ns_per_particle_step'] / predicted:.2f}"])
    print_table(rows)

    full = max((m for m in known.values() if m["ranks"] == 1), key=lambda m: m["threads"])
    shared = full["ns_per_particle_step"] * full["threads"] / one["ns_per_particle_step"]
    print(f"\nOn a full machine a core takes {shared:.2f} of that ({full['threads']} threads measured); "
          f"network {1e6 * options.latency:.1f} us, {1e-9 * options.bandwidth:.1f} GB/s per core.\n")
    on_full_machine = [shared * kernel for kernel in kernels]
    rows = [["particles", "cores", "particles per core", "ms per step", "compute", "exchange", "collectives", "efficiency"]]
    for total, cores in [(1e8, 100), (1e8, 1000), (1e9, 1000), (1e9, 10000), (1e10, 10000)]:
        parts = seconds_per_step(total / cores, cores, on_full_machine, per_block, options.latency, options.bandwidth, memory,
                                 options.imbalance)
        step = sum(parts)
        rows.append([f"{total:.0e}", str(cores), f"{total / cores:.0e}", f"{1e3 * step:.1f}"] +
                    [f"{100 * part / step:.1f} %" for part in parts] +
                    [f"{100 * total / cores * on_full_machine[0] / step:.0f} %"])
    print_table(rows)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
