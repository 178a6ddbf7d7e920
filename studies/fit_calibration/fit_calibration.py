#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Do the error bands of the fit hold the measurements? Fits the potentials named in README.md, draws samples of the
central one of each metal by tier of the errors, and compares their scatter with the measurements (`whipple compare
--samples`): tables of README.md and the figure of nominal over observed coverage.

Usage: studies/fit_calibration/fit_calibration.py [--bin build/release/bin] [--stores run/md] [--samples N] [--metal NAME ...]
                                               [--no-md]

Models of OpenKIM need scripts/install_deps.sh --kim. With --metal only the rows of these metals are written again, and no
figure.
"""
import argparse
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))
from studies.commands import call  # noqa: E402

PAGE = pathlib.Path(__file__).resolve().parent / "README.md"
FIGURE = PAGE.parent / "calibration.png"
BEGIN, END = "<!-- tables: begin -->", "<!-- tables: end -->"

# Metal: central potential (README.md says why), further ones of the second tier, measurements.
METALS = {
    "copper": ("copper_mishin", ["copper_u3", "copper_u6", "copper_zhou"],
               ["cu_hugoniot_marsh1980", "cu_isotherm_298K_dewaele2004"]),
    "aluminium": ("aluminium_zhakhovsky", ["aluminium_winey", "aluminium_voter", "aluminium_zhou"],
                  ["al_hugoniot_mitchell_nellis1981", "al_isotherm_298K_dewaele2004"]),
    "nickel": ("nickel_u3", ["nickel_zhou"], ["ni_hugoniot_marsh1980"]),
    "tantalum": ("tantalum_ravelo", ["tantalum_zhou"], ["ta_isotherm_298K_dewaele2004"]),
}
# Named later, and counted by themselves (README.md, "More potentials").
FURTHER = {"nickel": ["nickel_mishin"], "tantalum": ["tantalum_derlet"]}
TIERS = {"fit": "the fit", "potentials": "the potentials", "all": "both"}
WIDER = {"potentials": "the potentials and the further ones", "all": "the fit and all potentials"}
LEVELS = [50, 68, 80, 90, 95, 99]
ROW = re.compile(r"^(?P<experiment>\S+)\s+\S+\s+(?P<points>\d+)\s+(?P<width>[\d.]+) %\s+(?P<error>[\d.]+) %\s+"
                 r"(?P<band>[\d.]+) %\s+(?P<levels>[\d. ]+)$", re.MULTILINE)


def calibration_rows(report):
    """Reads the calibration table of `whipple compare --samples`: experiment -> numbers in percent."""
    rows = {}
    for found in ROW.finditer(report):
        levels = [float(word) for word in found["levels"].split()]
        rows[found["experiment"]] = {"points": int(found["points"]), "width": float(found["width"]),
                                     "error": float(found["error"]), "band": float(found["band"]),
                                     "levels": dict(zip(LEVELS, levels, strict=True))}
    return rows


def table(headings, rows):
    return "\n".join(["| " + " | ".join(headings) + " |", "|" + " --- |" * len(headings)]
                     + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def usable(binaries, stores, name):
    """The store of a potential if it can be fitted, and else the reason."""
    store = stores / f"{name}.md.h5"
    if not store.exists():
        return None, "its plan was not run"
    result = call([binaries / "whipple-fit", store, "-q"], allowed=(0, 2, 3))
    if result.returncode == 0:
        return store, ""
    return None, result.stderr.strip().splitlines()[-1].removeprefix("whipple fit: ").replace(str(store), store.name)


def calibrate(metal, options, binaries, stores):
    """Rows of one metal by title of their errors, the potentials that made no fit, and the deviation of the central one."""
    central, others, experiments = METALS[metal]
    refused, good = {}, {}
    for name in [central, *others, *FURTHER.get(metal, [])]:
        store, reason = usable(binaries, stores, name)
        if store:
            good[name] = store
        else:
            refused[name] = reason
    if central in refused:
        return {}, refused, ""
    rows, text = {}, ""
    for tiers, names, folder in ((TIERS, [central, *others], "calibration"),
                                 (WIDER, [central, *others, *FURTHER.get(metal, [])], "calibration_wider")):
        found = [good[name] for name in names if name in good]
        if tiers is WIDER and not any(name in good for name in FURTHER.get(metal, [])):
            continue
        (stores / folder).mkdir(exist_ok=True)
        material = stores / folder / f"{central}.toml"
        call([binaries / "whipple-fit", *found, "-q", "-o", f"{stores / folder}/", "--force"])
        for tier, title in tiers.items():
            if tier != "fit" and len(found) < 2:
                continue
            text = call([binaries / "whipple", "compare", material, "--with", *experiments, "--samples", options.samples,
                         "--tier", tier, "--force", "--calibration", stores / folder / f"{central}_{tier}.csv"]).stdout
            rows[title] = calibration_rows(text)
    return rows, refused, deviations(text, experiments)


def deviations(report, experiments):
    """rms and mean deviation of the central material, as `whipple compare` prints them."""
    found = {}
    for line in report.splitlines():
        for experiment in experiments:
            words = line.split()
            unit = next((i for i, word in enumerate(words) if word in ("%", "GPa") and i > 5), None)
            if words and words[0] == experiment and unit and experiment not in found:
                found[experiment] = f"{words[unit - 3]} ({words[unit - 2]}) {' '.join(words[unit:])}"
    return found


def draw(results):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(1, len(TIERS), figsize=(10, 3.8), sharey=True, layout="constrained")
    for panel, title in zip(axes, TIERS.values()):
        panel.plot([0, 100], [0, 100], color="0.6", linewidth=1)
        for metal, (rows, _, _) in results.items():
            for experiment, row in rows.get(title, {}).items():
                panel.plot(LEVELS, [row["levels"][level] for level in LEVELS], marker="o", markersize=3, label=experiment)
        panel.set(title=f"errors of {title}", xlabel="nominal coverage, %", xlim=(45, 101), ylim=(-2, 102))
    axes[0].set_ylabel("points inside, %")
    axes[0].legend(fontsize=6, loc="upper left")
    figure.savefig(FIGURE, dpi=100)


def former_rows(text, results):
    """Rows of the table that stand for other metals than those of the results."""
    lines = [[cell.strip() for cell in line.strip().strip("|").split(" | ")] for line in text.splitlines() if line.startswith("|")]
    return [cells for cells in lines if cells[0] in METALS and cells[0] not in results]


def sections(results, kept=()):
    rows = list(kept)
    for metal, (by_tier, _, rms) in results.items():
        for experiment in METALS[metal][2]:
            for title in (*TIERS.values(), *WIDER.values()):
                row = by_tier.get(title, {}).get(experiment)
                if row:
                    rows.append([metal, experiment, title, f"{row['points']}", f"{row['width']:.2f} %",
                                 f"{row['error']:.2f} %", f"{row['levels'][95]:.1f} %", f"{row['band']:.1f} %",
                                 rms.get(experiment, "") if title == TIERS["fit"] else ""])
    text = table(["metal", "measurement", "errors of", "points", "median half-width", "measurement error",
                  "inside 95 %", "inside the band alone", "rms (mean) deviation"], rows)
    for metal, (_, refused, _) in results.items():
        for name, reason in refused.items():
            text += f"\n{metal.capitalize()}, {name}: no fit, {reason}.\n"
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", type=pathlib.Path, default=ROOT / "build/release/bin")
    parser.add_argument("--stores", type=pathlib.Path, default=ROOT / "run/md")
    parser.add_argument("--samples", type=int, default=400)
    parser.add_argument("--metal", nargs="+", choices=METALS, default=list(METALS))
    parser.add_argument("--no-md", action="store_true", help="take the stores as they are")
    options = parser.parse_args()
    binaries, stores = options.bin.resolve(), options.stores.resolve()
    stores.mkdir(parents=True, exist_ok=True)
    results = {}
    for metal in options.metal:
        central, others, _ = METALS[metal]
        for name in () if options.no_md else [central, *others, *FURTHER.get(metal, [])]:
            call([binaries / "whipple", "md", ROOT / f"cases/md/{name}_short.toml", "-o", stores / f"{name}.md.h5"],
                 allowed=(0, 3))
        results[metal] = calibrate(metal, options, binaries, stores)
        print(f"{metal}: done", flush=True)
    if set(results) == set(METALS):
        draw(results)
    head, rest = PAGE.read_text(encoding="utf-8").split(BEGIN)
    former, tail = rest.split(END)
    text = sections(results, former_rows(former, results))
    PAGE.write_text(f"{head}{BEGIN}\n\n{text}\n{END}{tail}", encoding="utf-8")
    print(text)


if __name__ == "__main__":
    main()
