#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How does a step scale with the cores of this machine, beside what studies/performance_model predicts from one core?

usage: studies/scaling/scaling.py [--cores 1,2,4,8] [--repeats 5] [--beyond 16,256,4096] [--quick] [--table]
                                  [--folder run/studies/scaling] [--whipple EXE]

Four series, each of one problem of `whipple bench`: of fixed size (strong) and with as many particles for each core (weak), by ranks
of one thread and by threads of one rank. Writes scaling.json, scaling.md and scaling.png into the folder. Columns: time per particle
and step; speed-up (work done in a second, over that of one core) and efficiency (speed-up over cores); the same of the reference
kernel, whose threads share nothing, which bounds what any program gains on these cores; the speed-up that the model predicts with
--latency and --bandwidth, and measured over predicted. Predictions are not adjusted to anything measured on more than one core.
Machines should do nothing else meanwhile. With --repeats the series are measured in turn so many times: medians, and from the least
to the greatest speed-up. --beyond: what the model predicts for more cores by ranks, in tables that say so. --table renews the tables
from what is in the folder.
"""
import argparse
import json
import os
import pathlib
import statistics
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from studies.commands import call  # noqa: E402
from studies.performance_model.performance_model import predicted_nanoseconds  # noqa: E402

STRONG, WEAK = "lead_impact_million", "lead_impact"  # a million particles; 138,278 for each core
SERIES = {f"{kind}_{way}": (kind, way) for kind in ("strong", "weak") for way in ("ranks", "threads")}
HEAD = ("cores", "particles", "ns per particle and step", "speed-up", "efficiency", "of the reference kernel", "predicted speed-up",
        "measured over predicted")


def default_cores():
    """Powers of two up to the number of cores that this process may use, and that number."""
    available = len(os.sched_getaffinity(0))
    return sorted({*(2**k for k in range(available.bit_length()) if 2**k <= available), available})


def measure(options, name, repeat):
    """Runs `whipple bench` for a series unless its file is there."""
    kind, way = SERIES[name]
    file = options.folder / f"{name}_{repeat}.json"
    if not options.table:
        cores = ",".join(map(str, options.cores))
        by = ["--ranks", cores, "--threads", "1"] if way == "ranks" else ["--threads", cores]
        more = [*(["--weak"] if kind == "weak" else []), *(["--quick"] if options.quick else [])]
        call([options.whipple, "bench", options.strong if kind == "strong" else options.weak, *by, *more, "--json", file, "--force"])
    return json.loads(file.read_text(encoding="utf-8"))["measurements"]


def rows_of(measurements, latency, bandwidth, imbalance):
    """One row per number of cores.

    Speed-up compares time per particle and step: of a problem of fixed size the time of a step, of a growing one the work done in a
    second.
    """
    one = next((m for m in measurements if m["ranks"] * m["threads"] == 1), None)
    if one is None:
        raise ValueError("no measurement on one core, with which the others are compared")
    rows = []
    for m in sorted(measurements, key=lambda each: each["ranks"] * each["threads"]):
        cores = m["ranks"] * m["threads"]
        gain = one["ns_per_particle_step"] / m["ns_per_particle_step"]
        kernel = one["reference_kernel_ns_per_particle_step"] / m["reference_kernel_ns_per_particle_step"]
        predicted = one["ns_per_particle_step"] / predicted_nanoseconds(m, one, latency, bandwidth, imbalance)
        rows.append({"cores": cores, "particles": m["particles"], "nanoseconds": m["ns_per_particle_step"], "speed_up": gain,
                     "efficiency": gain / cores, "kernel_speed_up": kernel, "predicted_speed_up": predicted,
                     "measured_over_predicted": gain / predicted})
    return rows


def combined(repeats):
    """The rows of several measurements as one: medians, and the least and the greatest speed-up."""
    result = []
    for same in zip(*repeats):
        row = {key: statistics.median(each[key] for each in same) for key in same[0]}
        result.append(row | {"speed_ups": [min(each["speed_up"] for each in same), max(each["speed_up"] for each in same)]})
    return result


def predicted_rows(one, kind, numbers_of_cores, latency, bandwidth, imbalance):
    """What the model predicts from one core for numbers of ranks that have not been measured: cores, particles, efficiency."""
    rows = []
    for cores in numbers_of_cores:
        particles = one["particles"] * (cores if kind == "weak" else 1)
        there = one | {"ranks": cores, "threads": 1, "particles": particles}
        gain = one["ns_per_particle_step"] / predicted_nanoseconds(there, one, latency, bandwidth, imbalance)
        rows.append({"cores": cores, "particles": particles, "speed_up": gain, "efficiency": gain / cores})
    return rows


def table_of(rows):
    """The rows as a table of Markdown."""
    lines = [f"| {' | '.join(HEAD)} |", f"|{' ---: |' * len(HEAD)}"]
    for row in rows:
        least, most = row.get("speed_ups", [row["speed_up"]] * 2)
        spread = f" ({least:.2f} to {most:.2f})" if least < most else ""
        lines.append(f"| {row['cores']:.0f} | {row['particles']:,.0f} | {row['nanoseconds']:.1f} | {row['speed_up']:.2f}{spread} | "
                     f"{row['efficiency']:.0%} | {row['kernel_speed_up']:.2f} | {row['predicted_speed_up']:.2f} | "
                     f"{row['measured_over_predicted']:.2f} |")
    return "\n".join(lines)


def prediction_table(rows):
    """Predictions as a table of Markdown that says what they are."""
    lines = ["| predicted, not measured: cores | particles | speed-up | efficiency |", "| ---: | ---: | ---: | ---: |"]
    return "\n".join(lines + [f"| {row['cores']} | {row['particles']:,} | {row['speed_up']:.1f} | {row['efficiency']:.0%} |" for row in rows])


def draw(all_rows, file):
    """Efficiency over cores, measured (solid) and predicted (dashed)."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(figsize=(6.4, 4.2), constrained_layout=True)
    for name, rows in all_rows.items():
        kind, way = SERIES[name]
        cores = [row["cores"] for row in rows]
        line, = axes.plot(cores, [row["efficiency"] for row in rows], "o-", label=f"{kind}, {way}")
        axes.plot(cores, [row["predicted_speed_up"] / row["cores"] for row in rows], "--", color=line.get_color())
    axes.plot([], [], "--", color="gray", label="predicted")
    axes.set(xscale="log", xlabel="cores", ylabel="efficiency", ylim=(0, 1.1))
    ticks = sorted({row["cores"] for rows in all_rows.values() for row in rows})
    axes.set_xticks(ticks, [str(n) for n in ticks])
    axes.minorticks_off()
    axes.legend()
    figure.savefig(file, dpi=150)


def whole_numbers(text):
    """Whole numbers separated by commas."""
    return sorted({int(word) for word in text.split(",")})


def numbers(text):
    """Whole numbers separated by commas, of which one is 1."""
    found = whole_numbers(text)
    if found[0] != 1:
        raise argparse.ArgumentTypeError("the first number of cores is 1, with which the others are compared")
    return found


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cores", type=numbers, default=default_cores())
    parser.add_argument("--strong", default=STRONG, help="problem of fixed size")
    parser.add_argument("--weak", default=WEAK, help="problem on one core that grows with the cores")
    parser.add_argument("--repeats", type=int, default=1, help="measurements of each series")
    parser.add_argument("--beyond", type=whole_numbers, default=[], help="more cores, predicted only")
    parser.add_argument("--quick", action="store_true", help="a fifth of the steps")
    parser.add_argument("--table", action="store_true", help="measure nothing")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "run/studies/scaling")
    parser.add_argument("--whipple", type=pathlib.Path, default=ROOT / "build/release/bin/whipple")
    parser.add_argument("--latency", type=float, default=5e-7, help="s, of a message between two ranks")
    parser.add_argument("--bandwidth", type=float, default=4e9, help="bytes/s, between two ranks")
    parser.add_argument("--imbalance", type=float, default=1.02, help="work of the busiest rank over the mean one")
    options = parser.parse_args(arguments)
    options.folder = options.folder.resolve()
    options.whipple = options.whipple.resolve()
    options.folder.mkdir(parents=True, exist_ok=True)
    network = (options.latency, options.bandwidth, options.imbalance)
    measured = [{name: measure(options, name, repeat) for name in SERIES} for repeat in range(1, options.repeats + 1)]
    all_rows = {name: combined([rows_of(each[name], *network) for each in measured]) for name in SERIES}
    (options.folder / "scaling.json").write_text(json.dumps(all_rows, indent=1) + "\n", encoding="utf-8")
    problem = {"strong": f"`{options.strong}` of fixed size", "weak": f"`{options.weak}`, as many particles for each core"}
    text = "\n\n".join(f"{problem[kind]}, by {way}:\n\n{table_of(all_rows[name])}" for name, (kind, way) in SERIES.items())
    for name, (kind, way) in SERIES.items() if options.beyond else ():
        if way == "ranks":
            one = next(m for m in measured[0][name] if m["ranks"] * m["threads"] == 1)
            text += f"\n\n{problem[kind]}:\n\n{prediction_table(predicted_rows(one, kind, options.beyond, *network))}"
    (options.folder / "scaling.md").write_text(text + "\n", encoding="utf-8")
    draw(all_rows, options.folder / "scaling.png")
    print(text)


if __name__ == "__main__":
    main(sys.argv[1:])
