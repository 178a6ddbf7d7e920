#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draw a tube of cases/tube_folding at three times: the half behind a cut along its axis.

usage: picture.py RUN [FILE]   (docs/images/tube_folding.png): plastic strain, 0 to 1
"""
import argparse
import pathlib
import sys

import matplotlib
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

from report.particles import particles_of  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", type=pathlib.Path)
    parser.add_argument("file", type=pathlib.Path, nargs="?", default=ROOT / "docs/images/tube_folding.png")
    arguments = parser.parse_args()
    figure, axes = plt.subplots(1, 3, figsize=(11, 4))
    for axis, time in zip(axes, (0.2e-3, 0.4e-3, np.inf)):
        tube = particles_of(arguments.run, "tube", time)
        place = 1e3 * tube["position"]
        behind = place[:, 2] > 0  # the cut tube
        order = np.argsort(place[behind, 2])[::-1]
        axis.scatter(place[behind, 0][order], place[behind, 1][order], c=tube["plastic_strain"][behind][order], s=3, vmin=0, vmax=1)
        axis.set(aspect="equal", xlabel="x, mm", ylabel="y, mm", xlim=(0, 37), ylim=(-20, 20), title="at the end" if np.isinf(time) else f"{1e3 * time:g} ms")
    figure.tight_layout()
    figure.savefig(arguments.file, dpi=70)


if __name__ == "__main__":
    main()
