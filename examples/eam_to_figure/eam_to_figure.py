#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""From an interatomic potential to a figure: molecular dynamics, fit of an equation of state, and its Hugoniot with the
band of the fit next to measurements. The marks "# %%" are cells for editors and for jupytext.

PYTHONPATH must name the folder of the module whipple (docs/manual/python.md), PATH that of the program.
"""
# %% What is asked for
import argparse
import pathlib
import subprocess

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from whipple import eos

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--potential", default="Cu_u3.eam",
                    help="EAM file: a path, or one of LAMMPS (default: %(default)s)")
parser.add_argument("--element", default="Cu", help="chemical symbol (default: %(default)s)")
parser.add_argument("--with", dest="measured", default="cu_hugoniot_marsh1980.csv",
                    help="measured Hugoniot, a table in eos/data (default: %(default)s)")
parser.add_argument("--cells", type=int, default=4, help="unit cells along an edge (default: %(default)s)")
parser.add_argument("--steps", type=int, default=4000, help="averaged steps of a point (default: %(default)s)")
parser.add_argument("--whipple", default="whipple", help="the program (default: %(default)s)")
parser.add_argument("--folder", type=pathlib.Path, default="eam_to_figure",
                    help="of the results (default: %(default)s)")
options = parser.parse_args()
options.folder.mkdir(parents=True, exist_ok=True)

# %% A plan: state ahead of the shock, Hugoniot, three isochores of solids that melt above 900 K
size = f"cells = {options.cells}\nequilibration_steps = {options.steps // 4}\nsteps = {options.steps}\n"
path = pathlib.Path(options.potential)
potential = path.resolve() if path.is_file() else path  # the plan lies in another folder
isochore = '[[isochore]]\nvolume_ratio = {}\ntemperature = {}\n' + size
plan = "\n".join([
    f'title = "{options.potential}"\nelement = "{options.element}"\npotential = "{potential}"\nseed = 1\n',
    f'[zero_pressure_volume]\ntemperature = ["293 K"]\n{size}',
    isochore.format(1.0, '["150 K", "400 K", "700 K"]'),
    isochore.format(0.85, '["150 K", "700 K", "1200 K"]'),
    isochore.format(0.7, '["150 K", "1000 K", "2000 K"]'),
    f"[hugoniot]\nvolume_ratio = [0.96, 0.92, 0.88, 0.84, 0.8, 0.76, 0.72]\n{size}"])
plan_file, store, fitted = (options.folder / name for name in ("plan.toml", "points.md.h5", "fitted.toml"))
plan_file.write_text(plan, encoding="utf-8")

# %% Atoms, then constants: points that the store holds already are kept
subprocess.run([options.whipple, "md", plan_file, "-o", store], check=True)
subprocess.run([options.whipple, "fit", store, "-o", fitted, "--model", "mie_gruneisen", "--force"], check=True)

# %% The fitted material, and the scatter of its constants
material = eos.material(fitted)
print(material.constants)
particle_velocity = np.linspace(50.0, 2500.0, 50)
hugoniot = material.hugoniot(particle_velocity=particle_velocity)
drawn = np.array([sample.hugoniot(particle_velocity=particle_velocity).shock_velocity
                  for sample in eos.samples(fitted, 100)])
deviation = drawn.std(axis=0)

# %% Measurements: Us over up, or P over V/V0, from which both follow by the jump conditions
data = pathlib.Path(__file__).resolve().parents[2] / "eos/data" / options.measured
[measured] = eos.measurements(data)
if measured.kind == eos.ExperimentKind.shock_velocity:
    up, us = measured.abscissa, measured.measured
else:
    strain, stress = 1 - measured.abscissa, measured.measured / material.reference.density
    up, us = np.sqrt(stress * strain), np.sqrt(stress / strain)
deviations = material.hugoniot(particle_velocity=up, skip_invalid=True).shock_velocity / us - 1
print(f"{measured.name}: {up.size} points, rms deviation of Us {100 * np.sqrt(np.nanmean(deviations**2)):.2f} %")

# %% The figure
figure, axes = plt.subplots(figsize=(6, 4), layout="constrained")
axes.fill_between(particle_velocity / 1e3, (hugoniot.shock_velocity - 2 * deviation) / 1e3,
                  (hugoniot.shock_velocity + 2 * deviation) / 1e3, alpha=0.3,
                  label="two standard deviations of the fit")
axes.plot(particle_velocity / 1e3, hugoniot.shock_velocity / 1e3, label=f"{options.potential}, fitted")
shown = up <= particle_velocity[-1]
axes.plot(up[shown] / 1e3, us[shown] / 1e3, "k.", ms=4, label=measured.name)
axes.set(xlabel="particle velocity (km/s)", ylabel="shock velocity (km/s)")
axes.legend(frameon=False)
target = options.folder / "hugoniot.png"
figure.savefig(target, dpi=150)
print(f"wrote {target}")
