#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Exact profiles behind planar detonations: the tables of cases/detonation_slab and cases/gamma_law_detonation.

Usage: studies/detonation_profiles/detonation_profiles.py [--whipple build/release/bin/whipple]

Taylor wave of JWL products: along the isentrope of the Chapman-Jouguet state, from `whipple eos products`, u = u_CJ -
int c dv/v and x/t = u + c; at rest for x/t below the sound speed of rest. Products of exponent 3: the solution in closed form
of Mader (wall at x = 0) and of Fickett and Rivard (the charge of length X ends in vacuum). Places in metres at the end of
the run, pressure in Pa, velocity in m/s, density in kg/m^3.
"""
import argparse
import csv
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
LENGTH, PART = 0.1, 0.9  # m of explosive, and the part of it that has been detonated at the end
COLUMNS = {"x": "m", "pressure": "Pa", "velocity": "m/s", "density": "kg/m^3"}


def write(path, comment, rows):
    heads = [f"{name} [{unit}]" for name, unit in COLUMNS.items()]
    lines = [f"# {comment}", ",".join(heads), *(",".join(f"{value:.8g}" for value in row) for row in rows)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(f"wrote {path.relative_to(ROOT)}")


def isentrope(whipple, material):
    """Rows (v, p, rho, c, u - u_CJ) of the products of an explosive, from the Chapman-Jouguet state on, SI."""
    done = subprocess.run([whipple, "eos", "products", material, "--points", "20001", "--to", "0.1 GPa", "--csv", "-"],
                          capture_output=True, text=True, check=True)
    rows = csv.DictReader(line for line in done.stdout.splitlines() if not line.startswith("#"))
    return [(float(r["V_over_V0"]), 1e9 * float(r["P_GPa"]), float(r["rho_kg_m3"]), 1e3 * float(r["c_km_s"]),
             1e3 * float(r["u_km_s"])) for r in rows]


def taylor_wave(rows):
    """Detonation velocity and points (xi, p, u, rho) from the state of rest to the front: D - u = c = v D at the front."""
    v, _, _, c, _ = rows[0]
    D = c / v
    points = []
    for _, p, rho, c, change in rows:
        u = D * (1.0 - v) + change
        if u < 0.0:
            break
        points.append(((u + c) / D, p, u, rho))
    return D, points[::-1]


def interpolated(points, xi):
    """Values at xi of the polygon through points (xi, ...), ascending; of rest below the first one."""
    if xi <= points[0][0]:
        return (points[0][1], 0.0, points[0][3])
    after = next(i for i, point in enumerate(points) if point[0] >= xi)
    (x0, *a), (x1, *b) = points[after - 1], points[after]
    part = (xi - x0) / (x1 - x0)
    return tuple(s + part * (t - s) for s, t in zip(a, b))


def slab(whipple):
    for material in ("tnt", "composition_b", "lx_14"):
        D, points = taylor_wave(isentrope(whipple, material))
        places = [0.05 + 0.005 * i for i in range(181)]
        rows = [(PART * LENGTH * xi, *interpolated(points, xi)) for xi in places]
        write(ROOT / "cases" / "detonation_slab" / f"taylor_wave_{material}.csv",
              f"Taylor wave of {material}, 0.05 < x/(D t) < 0.95, D = {D:.2f} m/s, t = {1e6 * PART * LENGTH / D:.4f} us, "
              f"pressure of rest {1e-9 * points[0][1]:.4f} GPa", rows)


def gamma_law():
    """Exponent 3, rho0 = 1875 kg/m^3, D = 8 km/s: p = (16/27) rho0 D^2 (c/D)^3, rho = (16/9) rho0 c/D."""
    D, rho0, X = 8e3, 1875.0, 0.05
    T = X / D

    def row(x, c, u):
        return x, 16 / 27 * rho0 * D**2 * (c / D) ** 3, u, 16 / 9 * rho0 * c / D

    def behind_front(x, t):
        return (0.5 * (x / t + 0.5 * D), 0.5 * (x / t - 0.5 * D)) if x > 0.5 * D * t else (0.5 * D, 0.0)

    t = PART * T
    wave = [row(D * t * xi, *behind_front(D * t * xi, t)) for xi in (0.05 + 0.005 * i for i in range(181))]
    folder = ROOT / "cases" / "gamma_law_detonation"
    write(folder / "wall.csv", f"Mader's problem at {1e6 * t:.4f} us, 0.05 < x/(D t) < 0.95", wave)
    t = 1.4 * T
    rows = []
    for i in range(401):
        x = D * t * i / 400
        c, u = behind_front(x, t)
        if x > X - 0.5 * D * (t - T):  # the rarefaction from the end of the charge has arrived
            c, u = (0.5 * (x / t + sign * (x - X) / (t - T)) for sign in (-1, 1))
        rows.append(row(x, max(c, 0.0), u))
    write(folder / "escape.csv", f"escape into vacuum at {1e6 * t:.4f} us, to the front at D t", rows)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--whipple", default=str(ROOT / "build" / "release" / "bin" / "whipple"))
    slab(parser.parse_args().whipple)
    gamma_law()
