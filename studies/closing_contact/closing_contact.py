#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""How fast may the jet be that leaves the closing contact between a sphere and a plate, and how fast is it?

usage: closing_contact.py [--cells 56 112 224] [--case cases/lead_sphere_on_plate_gray/case.toml] [--end '1 us']
                          [--threads N] [--whipple EXE]

Sphere and plate are of one material. At the time t after first contact the surfaces meet at the radius where the sphere has the
slope phi,

    cos(phi) = 1 - V t/R,

and this place moves outwards with V cot(phi). Seen from it the plate arrives with q_2 = V cot(phi) and the sphere with
q_1 = V/sin(phi). While oblique shocks of one pressure turn both streams by phi together the contact closes without a jet; from
the angle phi_c on, where none do, material leaves it (Walsh, Shreffler & Willig, J. Appl. Phys. 24 (1953) 349). Material that leaves
along a stream line keeps its speed q_1 at most, so that no jet is faster than

    v(t) = V cot(phi) + V/sin(phi) = V cot(phi/2),   v_max = v(phi_c).

Shocks are those of the line U_s = c + s u_p through the Hugoniot of the case's material up to the particle velocity V/2. The runs
are sections of the case. A jet begins when the largest speed of a run exceeds 1.02 V; its fastest particle is compared with v at
that time. Tables go to standard output; exit code 1 if a run failed.
"""
import argparse
import csv
import math
import os
import pathlib
import subprocess
import sys
import tomllib

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
BEGINS = 1.02  # of the impact speed


def hugoniot(whipple, material, *options):
    """Rows of a Hugoniot, by the names of its columns."""
    text = subprocess.run([whipple, "eos", "hugoniot", material, *options, "--csv", "-"], check=True, capture_output=True,
                          text=True).stdout
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))


def shock_line(whipple, material, to):
    """Constants c (km/s) and s of the straight line through the Hugoniot up to the particle velocity `to` (km/s)."""
    end = hugoniot(whipple, material, "--particle-velocity", f"{to} km/s")[0]["P_GPa"]
    rows = hugoniot(whipple, material, "--from", "1 GPa", "--to", f"{end} GPa")
    s, c = np.polyfit([float(row["up_km_s"]) for row in rows], [float(row["us_km_s"]) for row in rows], 1)
    return c, s


def polar(q, c, s):
    """Deflections and pressures (over density) behind oblique shocks in a stream of the speed q (km/s)."""
    angle = np.linspace(math.asin(min(1.0, c / q)), 0.5 * math.pi, 4000)
    shock = q * np.sin(angle)
    particle = (shock - c) / s
    return angle - np.arctan2(shock - particle, q * np.cos(angle)), shock * particle


def closes_without_jet(phi, speed, c, s):
    """Do oblique shocks of one pressure turn both streams by phi together?"""
    if speed / math.tan(phi) <= c:
        return False
    (turn_1, p_1), (turn_2, p_2) = polar(speed / math.sin(phi), c, s), polar(speed / math.tan(phi), c, s)
    pressure = np.linspace(0.0, min(p_1.max(), p_2.max()), 4000)
    # Beyond the largest deflection pressures still rise: they are ascending along each polar.
    return (np.interp(pressure, p_1, turn_1) + np.interp(pressure, p_2, turn_2)).max() >= phi


def critical_angle(speed, c, s):
    """The slope phi_c (radians) from which on the contact sends out a jet."""
    low, high = 0.01, 0.5 * math.pi
    while high - low > 1e-5:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if closes_without_jet(middle, speed, c, s) else (low, middle)
    return low


def bound(speed, radius, time):
    """V cot(phi/2) (km/s) at a time (us) after contact of a sphere of a radius (mm); once the equator has passed no contact
    closes, and phi stays 90 degrees."""
    return speed / math.tan(0.5 * math.acos(max(0.0, 1.0 - speed * time / radius)))


def jet_of(folder, speed):
    """Time (us) at which the jet of a run begins and its largest speed (km/s); None without a jet."""
    with open(folder / "history.csv", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    column = {name.split(" ")[0]: name for name in rows[0]}
    times = [1e6 * float(row[column["time"]]) for row in rows]
    speeds = [1e-3 * float(row[column["maximum_speed"]]) for row in rows]
    begin = next((t for t, v in zip(times, speeds) if v > BEGINS * speed), None)
    return None if begin is None else (begin, max(speeds))


def quantity(text, units):
    """A number of the first unit from text with one of the units."""
    value, unit = text.split()
    return float(value) * units[unit]


def main():
    parser = argparse.ArgumentParser(prog="closing_contact.py",
                                     description="Compares the jet of a closing contact with its theoretical bound.")
    parser.add_argument("--cells", type=int, nargs="+", default=[56, 112, 224], help="across the sphere")
    parser.add_argument("--case", type=pathlib.Path, default=ROOT / "cases/lead_sphere_on_plate_gray/case.toml")
    parser.add_argument("--end", default="1 us")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--whipple", default=str(ROOT / "build/release/bin/whipple"), help="the executable")
    options = parser.parse_args()
    case = tomllib.loads(options.case.read_text(encoding="utf-8"))
    sphere = next(body for body in case["body"] if "sphere" in body["shape"])
    speed = quantity(sphere["velocity"][0], {"km/s": 1.0, "m/s": 1e-3})
    radius = quantity(sphere["shape"]["sphere"]["radius"], {"mm": 1.0, "cm": 10.0})
    c, s = shock_line(options.whipple, options.case.parent / sphere["material"], 0.5 * speed)
    phi = critical_angle(speed, c, s)
    print(f"U_s = {c:.3f} km/s + {s:.3f} u_p: jets from phi = {math.degrees(phi):.1f} degrees on, "
          f"{radius * (1.0 - math.cos(phi)) / speed:.3f} us after contact; none is faster than "
          f"{speed / math.tan(0.5 * phi):.2f} km/s\n")
    print("| cells across the sphere | jet begins, us | bound there, km/s | fastest, km/s |\n| --- | --- | --- | --- |")
    failed = False
    for cells in options.cells:
        folder = ROOT / "run" / "closing_contact" / f"{options.case.parent.name}.{cells}"
        command = [options.whipple, "run", str(options.case), "-o", str(folder), "--force", "--quiet", "--threads",
                   str(options.threads), "--set", "domain.dimension=axisymmetric",
                   "--set", f"domain.cell_size={2.0 * radius / cells} mm", "--set", f"time.end={options.end}"]
        if subprocess.run(command, check=False).returncode != 0:
            print(f"failed: {' '.join(command)}", file=sys.stderr)
            failed = True
            continue
        jet = jet_of(folder, speed)
        print(f"| {cells} | " + ("– | – | – |" if jet is None else
                                 f"{jet[0]:.3f} | {bound(speed, radius, jet[0]):.2f} | {jet[1]:.2f} |"), flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
