#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Load steps without inertia on exact problems: order of convergence, and limit loads.

usage: quasi_static.py column|beam|cook|cut|footing|tangent [--cells N]... [--shape NAME]... [--border X]... [--table] [--folder run/studies/quasi_static]
                       [--threads N] [--whipple EXE]

column   50 m under its own weight, E = 1 MPa, Poisson's ratio 0, 20 load steps (shortens by 2 %), and under a hundred times the weight,
         40 steps (loses half of its height): mean error of the vertical stress over that at the foot. Exact: the weight above.
beam     10 m by 1 m by a dead load of 100 kN across its end, 50 steps, E = 12 MPa, Poisson's ratio 0.2, plane strain (the problem of AMPLE
         and of Molstad): deflection and shortening of the loaded end.
         Beside it the elastica, which is inextensible and without shear (1 to 2 % less).
cook     cases/cook_membrane (rubber, Poisson's ratio 0.499) in 10 load steps: deflection of the upper corner, own finite elements
         0.2764 +- 0.0003 m; user time beside that of the case with inertia and the same pressure at every particle (coarse grid).
cut      vertical cut of 8 m in clay of the strength c: gamma H/c at which no state of rest is found. Known: 3.776.
footing  rough rigid strip on weightless clay, pushed down by 2 cm, half width 1 m: force over (2 + pi) c times the half width, when
         its limit is reached or at the end.
tangent  what the tangents cost: the footing under four laws (sinks by 0.3 m, 4 mm under those that yield), in the plane and
         with fewer than 8 cells as the quarter of a square one in space, 10 steps, quadratic B-splines: iterations, user time, fractions of it (profile.json).
--cells: number over the height (column), the depth (beam), the held edge of 44 m (cook), the height (cut) or the half width (footing, tangent). Runs of the same program are
kept; --table runs nothing. A run that ends at its limit load is one that worked.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import subprocess
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[0] = str(ROOT)
from report.particles import particles_of  # noqa: E402
from studies.validation.bands import grid_study  # noqa: E402

SHAPES = ("linear", "convected_gimp", "quadratic_bspline", "cubic_bspline")
AT_LIMIT = 3  # exit code of whipple: the physics left its range

MATERIAL = """name = "{name}"
group = "verification"
source = "studies/quasi_static"
note = "{name}"
[eos]
model = "mie_gruneisen"
source = "K = rho c0^2"
reference_density = "{density} kg/m^3"
hugoniot_intercept = "{speed:.17g} m/s"
hugoniot_slope = 1.0
gruneisen = 1e-6
heat_capacity = "1000 J/(kg K)"
[strength]
model = "{model}"
source = "as above"
shear_modulus = "{shear:.17g} Pa"
{more}"""
HEAD = """[domain]
dimension = "plane_strain"
lower = ["0 m", "{low:.17g} m"]
upper = ["{wide:.17g} m", "{high:.17g} m"]
cell_size = "{cell:.17g} m"
boundary = {{ {faces} }}
[time]
end = "1 s"
scheme = "quasi_static"
[quasi_static]
steps = {steps}
{control}
[contact]
method = "none"
[transfer]
shape_function = "{shape}"
[output]
fields = ["stress"]
snapshot_every = "1 s"
"""
BODY = """[[body]]
name = "{name}"
material = "{name}.toml"
shape = {{ box = {{ lower = ["{x0:.17g} m", "{y0:.17g} m", "-1 m"], upper = ["{x1:.17g} m", "{y1:.17g} m", "1 m"] }} }}
"""


def material(name, density, young, poisson, model="elastic", more=""):
    bulk, shear = young / (3 * (1 - 2 * poisson)), young / (2 * (1 + poisson))
    return MATERIAL.format(name=name, density=density, speed=math.sqrt(bulk / density), model=model, shear=shear, more=more)


CLAY = material("clay", 2000, 1e8, 0.3, "von_mises", 'yield_stress = "20 kPa"\nhardening_modulus = "0 Pa"\n')
COHESION = 20e3 / math.sqrt(3)  # Pa, of the plane: von Mises


def compute(arguments, name, text, materials):
    """Folder of the run of a case, computed unless it has been by the same program."""
    folder = arguments.folder / name
    case = folder / "case.toml"
    done = folder / "run/status.json"
    program = arguments.whipple.stat().st_mtime_ns
    stamp = folder / "program"
    if arguments.table or (done.exists() and stamp.exists() and stamp.read_text() == str(program) and case.read_text() == text):
        return folder / "run"
    folder.mkdir(parents=True, exist_ok=True)
    for of_body, content in materials.items():
        (folder / f"{of_body}.toml").write_text(content, encoding="utf-8")
    case.write_text(text, encoding="utf-8")
    process = subprocess.Popen([arguments.whipple, "run", case, "-o", folder / "run", "--force", "--quiet", "--threads", str(arguments.threads)],
                               stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = code = os.waitstatus_to_exitcode(status)
    if code not in (0, AT_LIMIT):
        raise SystemExit(f"{case}: whipple run ended with {code}")
    (folder / "seconds").write_text(f"{usage.ru_utime:.1f}", encoding="utf-8")
    stamp.write_text(str(program))
    return folder / "run"


def last_row(run, table, column):
    with open(run / table, encoding="utf-8") as file:
        rows = list(csv.reader(file))
    names = [name.split(" ")[0] for name in rows[0]]
    return float(rows[-1][names.index(column)])


def print_bands(found):
    """What the grids of each function say (docs/theory/uncertainty.md); found: cell size and value by name."""
    print("\n| shape function | finest grid | order | limit |\n" + "| --- " * 4 + "|")
    for name, points in found.items():
        study = grid_study(points)
        order, limit = (f"{x:.3g}" if math.isfinite(x) else "–" for x in (study.order, study.limit))
        print(f"| {name} | {study.value:.4g} +- {study.band:.2g}{'' if study.converged else f' ({study.state})'} | {order} | {limit} |")


def control_of(border, kept=False):
    return f"border_stiffness = {border}\n" + ('grid = "kept"' if kept else "")


def column(arguments):
    height, density = 50.0, 80.0
    print("| gravity, m/s2 | shape function | grid | " + " | ".join(f"{n} cells" for n in arguments.cells) + " |\n" +
          "| --- " * (3 + len(arguments.cells)) + "|")
    for gravity, steps in ((10.0, 20), (1000.0, 40)):
        for shape, kept in [(shape, False) for shape in arguments.shape] + [("linear", True)]:
            errors = []
            for n in arguments.cells:
                h = height / n
                text = HEAD.format(low=0, wide=h, high=height + 2 * h, cell=h, steps=steps, shape=shape, control=control_of(arguments.border[0], kept),
                                   faces='x_lower = "symmetry", x_upper = "symmetry", y_lower = "symmetry"')
                text += f'[gravity]\nacceleration = ["0 m/s^2", "-{gravity} m/s^2"]\nrise_time = "1 s"\n'
                text += BODY.format(name="soft", x0=0, y0=0, x1=h, y1=height)
                run = compute(arguments, f"column_{gravity:g}_{shape}_{kept}_{n}", text, {"soft": material("soft", density, 1e6, 0.0)})
                now = particles_of(run, "soft")
                order = np.argsort(now["position"][:, 1])
                began = np.empty(len(order))
                began[order] = (np.arange(len(order)) // 2 + 0.5) * h / 2
                error = np.abs(now["stress"][:, 1] + density * gravity * (height - began)).mean() / (density * gravity * height)
                errors.append(f"{error:.2e}")
            print(f"| {gravity:g} | {shape} | {'kept' if kept else 'reset'} | " + " | ".join(errors) + " |", flush=True)


def elastica(a, n=4000):
    """Depth and shortening of the tip of an inextensible cantilever of length 1, a = P L^2/EI, by shooting."""
    def tip(curvature):
        angle = x = y = 0.0
        for _ in range(n):
            middle = angle + curvature / (2 * n)
            half = curvature - a * math.cos(angle) / (2 * n)
            x, y = x + math.cos(middle) / n, y + math.sin(middle) / n
            angle, curvature = angle + half / n, curvature - a * math.cos(middle) / n
        return curvature, y, 1 - x
    low, high = 0.0, 3 * a
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if tip(middle)[0] > 0 else (middle, high)
    return tip(low)[1:]


def beam(arguments):
    end = 9.875  # m, of the beam with the middle of the loaded part
    down, short = elastica(1e5 * end**2 / (12e6 / 0.96 / 12))
    print(f"elastica: {down * end:.3f} m down, {short * end:.3f} m shorter\n")
    print("| shape function | border stiffness | cells over the depth | load steps | down, m | shorter, m |\n" + "| --- " * 6 + "|")
    found = {}
    for shape in arguments.shape:
        for border in arguments.border:
            for n in arguments.cells:
                text = HEAD.format(low=-11, wide=11, high=2, cell=1 / n, steps=50, shape=shape, control=control_of(border), faces='x_lower = "no_slip"')
                text += BODY.format(name="beam", x0=0, y0=-0.5, x1=9.75, y1=0.5) + BODY.format(name="tip", x0=9.75, y0=-0.5, x1=10, y1=0.5)
                text += '[[load]]\nbody = "tip"\nforce = ["0 N", "-100 kN"]\ntimes = ["0 s", "1 s"]\nfactors = [0.0, 1.0]\n'
                run = compute(arguments, f"beam_{shape}_{border:g}_{n}", text,
                              {name: material(name, 1000, 12e6, 0.2) for name in ("beam", "tip")})
                now = particles_of(run, "tip")["position"].mean(axis=0)
                print(f"| {shape} | {border:g} | {n} | {last_row(run, 'history.csv', 'step'):.0f} | {-now[1]:.3f} | {end - now[0]:.3f} |", flush=True)
                found.setdefault(f"{shape}, {border:g}, down, m", []).append((1 / n, -now[1]))
                found.setdefault(f"{shape}, {border:g}, shorter, m", []).append((1 / n, end - now[0]))
    print_bands(found)


def cut(arguments):
    height, gravity = 8.0, 4.0
    print("| shape function | cells over the height | gamma H/c |\n" + "| --- " * 3 + "|")
    found = {}
    for shape in arguments.shape:
        for n in arguments.cells:
            h = height / n
            text = HEAD.format(low=0, wide=20, high=10, cell=h, steps=40, shape=shape, control=control_of(arguments.border[0]),
                               faces='x_lower = "symmetry", y_lower = "no_slip"')
            text += f'[gravity]\nacceleration = ["0 m/s^2", "-{gravity} m/s^2"]\nrise_time = "1 s"\n' + BODY.format(name="clay", x0=0, y0=0, x1=16, y1=height)
            run = compute(arguments, f"cut_{shape}_{n}", text, {"clay": CLAY})
            time = last_row(run, "history.csv", "time")
            held = " (held)" if time >= 1.0 else ""
            if not held:
                found.setdefault(shape, []).append((h, time * gravity * 2000 * height / COHESION))
            print(f"| {shape} | {n} | {time * gravity * 2000 * height / COHESION:.3f}{held} |", flush=True)
    print_bands(found)


def footing(arguments):
    print("| shape function | cells over the half width | force over (2 + pi) c B/2 | at, cm |\n" + "| --- " * 4 + "|")
    found = {}
    for shape in arguments.shape:
        for n in arguments.cells:
            h = 1.0 / n
            text = HEAD.format(low=0, wide=5, high=6, cell=h, steps=50, shape=shape, control=control_of(arguments.border[0]),
                               faces='x_lower = "symmetry", x_upper = "symmetry", y_lower = "no_slip"')
            text += BODY.format(name="clay", x0=0, y0=0, x1=5, y1=5)
            text += BODY.format(name="footing", x0=0, y0=5, x1=1, y1=5 + h) + 'driven = true\nvelocity = ["0 m/s", "-2 cm/s"]\n'
            text += '[[force_gauge]]\nname = "load"\nbody = "footing"\n'
            run = compute(arguments, f"footing_{shape}_{n}", text, {"clay": CLAY, "footing": CLAY.replace('name = "clay"', 'name = "footing"')})
            force, time = last_row(run, "gauges.csv", "load.force_y"), last_row(run, "gauges.csv", "time")
            print(f"| {shape} | {n} | {force / ((2 + math.pi) * COHESION):.3f} | {2 * time:.2f} |", flush=True)
            found.setdefault(shape, []).append((h, force / ((2 + math.pi) * COHESION)))
    print_bands(found)


def cook(arguments):
    case = ROOT / "cases/cook_membrane"
    rubber = (case / "rubber.toml").read_text(encoding="utf-8")
    inertia = (case / "case.toml").read_text(encoding="utf-8").replace('volumetric = "cell"', 'volumetric = "point"')
    rest = inertia.replace('[[load]]\ndamping = "0.2 1/s"\n', "").replace("[artificial_viscosity]", "[contact]\nmethod = \"none\"\n[artificial_viscosity]")
    print("| scheme | shape function | cells, m | steps | user s | deflection, m |\n" + "| --- " * 6 + "|")
    found = {}
    for scheme, shapes, text in (("quasi_static", arguments.shape, rest), ("symplectic", ("quadratic_bspline",), inertia)):
        for shape in shapes:
            for cell in [44 / n for n in arguments.cells] if scheme == "quasi_static" else [44 / arguments.cells[0]]:
                now = text.replace('cell_size = "1 m"', f'cell_size = "{cell:.12g} m"')
                now = now.replace('end = "100 s"', 'end = "100 s"' if scheme == "symplectic" else
                                  'end = "20 s"\nscheme = "quasi_static"\n[quasi_static]\nsteps = 10')
                now += f'[transfer]\nshape_function = "{shape}"\n'
                run = compute(arguments, f"cook_{scheme}_{shape}_{cell:.3g}", now, {"rubber": rubber})
                with open(run / "gauges.csv", encoding="utf-8") as file:
                    rows = list(csv.reader(file))
                column = [name.split(" ")[0] for name in rows[0]].index("corner.y")
                seconds = (run.parent / "seconds").read_text(encoding="utf-8")
                deflection = float(rows[-1][column]) - float(rows[1][column])
                print(f"| {scheme} | {shape} | {cell:.3g} | {last_row(run, 'history.csv', 'step'):.0f} | {seconds} | {deflection:.4f} |", flush=True)
                if scheme == "quasi_static":
                    found.setdefault(shape, []).append((cell, deflection))
    print_bands(found)


LAWS = {"elastic": ("[strength]\nmodel = \"elastic\"\n", 0.3), "neo-Hookean": ("[constitutive]\nmodel = \"neo_hookean\"\n", 0.3),
        "von Mises": ("[strength]\nmodel = \"von_mises\"\nyield_stress = \"20 kPa\"\nhardening_modulus = \"0 Pa\"\n", 4e-3),
        "Drucker-Prager": ("[strength]\nmodel = \"drucker_prager\"\nfriction_angle = \"20 deg\"\ncohesion = \"10 kPa\"\nmatch = \"plane_strain\"\n", 4e-3)}
SQUARE = BODY.replace('"-1 m"', '"0 m"').replace('"1 m"', '"{z1:.17g} m"')


def ground(name, law):
    """Ground of E = 100 MPa and Poisson's ratio 0.3 under a law."""
    return material(name, 2000, 1e8, 0.3).replace('[strength]\nmodel = "elastic"\n', law)


def tangent(arguments):
    print("| law | dimensions | cells over the half width | particles | load steps | iterations | user s | tangents, % | linear equations, % |\n" + "| --- " * 9 + "|")
    for law, (text_of_law, depth) in LAWS.items():
        for n in arguments.cells:
            dimensions, h = 2 if n >= 8 else 3, 1.0 / n
            faces = 'x_lower = "symmetry", x_upper = "symmetry", y_lower = "no_slip"'
            text = HEAD.format(low=0, wide=3, high=4, cell=h, steps=10, shape="quadratic_bspline", control="", faces=faces)
            body = BODY
            if dimensions == 3:
                text = text.replace('dimension = "plane_strain"\n', "").replace('m"]\nupper', 'm", "0 m"]\nupper').replace('m"]\ncell', 'm", "3 m"]\ncell')
                text = text.replace(faces, faces + ', z_lower = "symmetry", z_upper = "symmetry"')
                body = SQUARE
            text += body.format(name="ground", x0=0, y0=0, x1=3, y1=3, z1=3)
            text += body.format(name="footing", x0=0, y0=3, x1=1, y1=3 + h, z1=1) + f'driven = true\nvelocity = ["0 m/s", "-{depth} m/s", "0 m/s"]\n'
            run = compute(arguments, f"tangent_{law.replace(' ', '_')}_{n}", text, {name: ground(name, text_of_law) for name in ("ground", "footing")})
            with open(run / "profile.json", encoding="utf-8") as file:
                profile = json.load(file)
            seconds = {stage["stage"]: stage["seconds"] for stage in profile["stages"]}
            of_step = sum(seconds[name] for name in ("load step", "tangents of the material", "linear equations"))
            shares = " | ".join(f"{100 * seconds[name] / of_step:.1f}" for name in ("tangents of the material", "linear equations"))
            counts = " | ".join(f"{last_row(run, 'history.csv', name):.0f}" for name in ("step", "newton_iterations"))
            print(f"| {law} | {dimensions} | {n} | {profile['particles']} | {counts} | {(run.parent / 'seconds').read_text(encoding='utf-8')} | {shares} |", flush=True)


PROBLEMS = {"column": (column, (8, 16, 32, 64, 128)), "beam": (beam, (2, 4, 8)), "cook": (cook, (22, 44, 88)), "cut": (cut, (8, 16, 32)), "footing": (footing, (4, 8, 16)),
            "tangent": (tangent, (2, 3, 8, 16))}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("problem", choices=PROBLEMS)
    parser.add_argument("--cells", type=int, action="append")
    parser.add_argument("--shape", choices=SHAPES, action="append")
    parser.add_argument("--border", type=float, action="append")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--folder", type=pathlib.Path, default=ROOT / "run/studies/quasi_static")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--whipple", type=pathlib.Path, default=ROOT / "build/release/bin/whipple")
    arguments = parser.parse_args()
    solve, cells = PROBLEMS[arguments.problem]
    arguments.cells = arguments.cells or list(cells)
    arguments.shape = arguments.shape or list(SHAPES)
    arguments.border = arguments.border or [1e-3]
    solve(arguments)


if __name__ == "__main__":
    main()
