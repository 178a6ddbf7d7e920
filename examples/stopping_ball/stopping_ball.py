#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A copper ball in an aluminium block: check a case, run it, watch it, end it once the ball has stopped, and draw a
figure for a paper. Usage: stopping_ball.py FOLDER"""
# %%
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import whipple

folder = pathlib.Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)

# %% A case of two dimensions, a few thousand particles. Its faults are data.
(folder / "case.toml").write_text("""title = "Ball in a block"
[domain]
dimension = "axisymmetric"
lower = ["-5 mm", "0 mm"]
upper = ["8 mm", "8 mm"]
cell_size = "0.5 mm"
[time]
end = "20 us"
[output]
snapshot_every = "2 us"
[[body]]
name = "ball"
material = "copper_ofhc_mie_gruneisen"
velocity = ["1 km/s", "0 m/s"]
shape = { sphere = { center = ["-1.5 mm", "0 mm"], radius = "1.5 mm" } }
[[body]]
name = "block"
material = "aluminium_6061_t6"
shape = { cylinder = { center = ["3 mm", "0 mm", "0 mm"], axis = "x", height = "6 mm", radius = "7 mm" } }
[[stop]]
when = "speed_below"
body = "ball"
speed = "100 m/s"
""", encoding="utf-8")
case = whipple.Case(folder / "case.toml")
case["body.0.material"] = "no_such_copper"
print("a wrong case:", case.faults()[0].key)
case["body.0.material"] = "copper_ofhc_mie_gruneisen"
print("particles:", case.check()["particles"])

# %% The run is a child process; its rows come as they are written.
run = case.start(folder / "run", threads=1)
rows = sum(1 for row in run.rows())
results = run.wait()
print(rows, "rows; ended because", run.status["ended_by"])

# %% Results are numpy arrays with units.
history = results.history
speed = []
for number in range(len(results.times)):
    ball = results.body(0, number)
    mass, velocity = np.asarray(ball["mass"], dtype=float), np.asarray(ball["velocity"], dtype=float)
    speed.append((mass[:, None] * velocity).sum(axis=0)[0] / mass.sum())
depth = results.quantities()["penetration_depth.ball"]
print(f"depth {1e3 * depth.value:.2f} m{depth.unit}, last speed {speed[-1]:.0f} m/s")

# %% A figure.
figure, axes = plt.subplots(1, 2, figsize=(7.0, 2.8), layout="constrained")
axes[0].plot(1e6 * results.times, speed, "o-", ms=3)
axes[0].set(xlabel="time (µs)", ylabel="speed of the ball (m/s)")
for name in ("kinetic_energy", "plastic_work"):
    axes[1].plot(1e6 * history["time"], history[name], label=name.replace("_", " "))
axes[1].set(xlabel="time (µs)", ylabel=f"energy ({history.units['kinetic_energy']})")
axes[1].legend(frameon=False)
figure.savefig(folder / "stopping_ball.pdf")
