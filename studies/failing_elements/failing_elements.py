# SPDX-License-Identifier: BSD-3-Clause
"""What are the energies of elements whose material fails? A copper rod at 1 km/s on a plate of aluminium 6061.

Writes an LS-DYNA deck (hexahedra, *MAT_JOHNSON_COOK with damage and spall, contact with friction), imports it and runs
it as elements whatever happens to them become particles, are deleted or only the failed ones converted, and the same
bodies as particles. Prints energies at the end and the most that any step had.

    python3 -m studies.failing_elements.failing_elements [--whipple PROGRAM] [--folder FOLDER]
"""
import argparse
import csv
import pathlib
import subprocess

ROD = ((-1.5, -1.5, -6.1), (1.5, 1.5, -0.1), (6, 6, 12))  # mm, mm, elements
PLATE = ((-8, -8, 0), (8, 8, 2), (16, 16, 4))
MATERIALS = (  # mm, g, ms: MPa
    ((0.00896, 47700, 124000, 0.34), (90, 292, 0.31, 0.025, 1.09, 1356, 293, 0.001), 383,
     (0.54, 4.89, -3.03, 0.014, 1.12), (3940, 1.489, 2.02)),
    ((0.002703, 26000, 69000, 0.33), (324, 114, 0.42, 0.002, 1.34, 925, 293, 0.001), 885,
     (-0.77, 1.45, -0.47, 0, 1.6), (5350, 1.34, 2.0)))
RUNS = {"elements": {"discretization.method": "finite_elements"},
        "elements, deleted beyond their range": {"discretization.method": "finite_elements", "element_range.beyond": "remove"},
        "adaptive": {"discretization.method": "adaptive"}}


def card(*values):
    """Returns a line of ten-column fields."""
    return "".join(f"{value:>10}" for value in values) + "\n"


def mesh(lower, upper, count, first, part):
    """Returns lines of nodes and of elements of a block, both numbered from `first`."""
    def number(i, j, k):
        return first + i + (count[0] + 1) * (j + (count[1] + 1) * k)
    cells = [(i, j, k) for k in range(count[2]) for j in range(count[1]) for i in range(count[0])]
    corners = [(i, j, k) for k in range(count[2] + 1) for j in range(count[1] + 1) for i in range(count[0] + 1)]
    nodes = "".join(f"{number(*at):8}" + "".join(f"{lower[d] + (upper[d] - lower[d]) * at[d] / count[d]:16.6g}"
                                                 for d in range(3)) + "\n" for at in corners)
    around = ((0, 0), (1, 0), (1, 1), (0, 1))
    elements = "".join(f"{first + n:8}{part:8}" + "".join(f"{number(i + x, j + y, k + z):8}" for z in (0, 1)
                                                          for x, y in around) + "\n"
                       for n, (i, j, k) in enumerate(cells))
    return nodes, elements


def deck():
    """Returns the deck."""
    text = "*KEYWORD\n*TITLE\ncopper rod on a plate\n*CONTROL_TERMINATION\n" + card(0.012)
    text += "*PART\nrod\n" + card(1, 1, 1, 1) + "*PART\nplate\n" + card(2, 1, 2, 2) + "*SECTION_SOLID\n" + card(1, 1)
    for n, (elastic, strength, heat, damage, shock) in enumerate(MATERIALS, 1):
        text += "*MAT_JOHNSON_COOK\n" + card(n, *elastic) + card(*strength) + card(heat, -1200, 2, 0, *damage[:4])
        text += card(damage[4]) + "*EOS_GRUNEISEN\n" + card(n, shock[0], shock[1], 0, 0, shock[2], 0, 0) + card(1)
    text += "*CONTACT_AUTOMATIC_SURFACE_TO_SURFACE\n" + card(1, 2, 0, 0) + card(0.1, 0.1)
    text += "*INITIAL_VELOCITY_GENERATION\n" + card(1, 2, 0, 0, 0, 1000)
    blocks = [mesh(*ROD, 1, 1), mesh(*PLATE, 10001, 2)]
    return (text + "*NODE\n" + "".join(nodes for nodes, _ in blocks) + "*ELEMENT_SOLID\n" +
            "".join(elements for _, elements in blocks) + "*END\n")


def as_particles(case):
    """Returns the text of the case with boxes of particles in place of the meshes."""
    lines = []
    boxes = iter((ROD, PLATE))
    for line in case.splitlines():
        if line.startswith("discretization"):
            corners = [str([f"{x} mm" for x in corner]).replace("'", '"') for corner in next(boxes)[:2]]
            line = f"shape = {{ box = {{ lower = {corners[0]}, upper = {corners[1]} }} }}"
        lines.append(line)
    return "\n".join(lines) + "\n"


def show(name, run):
    """Prints a line about a run."""
    with open(run / "history.csv", encoding="utf-8") as file:
        rows = [{key.split(" ")[0]: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    last = rows[-1]

    def of(column, row=last):
        return row.get(column, 0.0)
    moving = [of("kinetic_energy", row) + of("affine_kinetic_energy", row) for row in rows]
    print(f"{name:38} {1e6 * of('time'):5.2f} us: kinetic {moving[-1]:7.2f} (most {max(moving):.2f}), internal "
          f"{of('internal_energy'):6.2f}, unresolved {of('unresolved_energy'):5.2f}, hourglass "
          f"{of('hourglass_energy'):5.2f} (least {min(of('hourglass_energy', row) for row in rows):.2f}, overdrawn "
          f"{of('hourglass_overdrawn'):.1e}), outflow {of('outflow_energy'):6.2f} J; energy error "
          f"{of('energy_error'):.0e}; at most {max(of('maximum_speed', row) for row in rows):.0f} m/s, "
          f"{max(of('maximum_temperature', row) for row in rows):.0f} K; {of('elements_beyond_range'):.0f} elements "
          f"beyond their range, {of('elements'):.0f} left")


def main():
    """Runs all and prints a line about each."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--whipple", default="build/release/bin/whipple")
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("run/failing_elements"))
    arguments = parser.parse_args()
    folder = arguments.folder
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "rod.k").write_text(deck(), encoding="utf-8")

    def call(*words):
        return subprocess.run([arguments.whipple, *map(str, words)], check=False).returncode
    if call("import", folder / "rod.k", "-o", folder / "case", "--units", "mm g ms", "--cell-size", "0.5 mm", "-q"):
        raise SystemExit(1)
    case = folder / "case" / "case.toml"
    particles = case.with_name("particles.toml")
    particles.write_text(as_particles(case.read_text(encoding="utf-8")), encoding="utf-8")
    variants = [(name, case, changes) for name, changes in RUNS.items()] + [("particles", particles, {})]
    for name, file, changes in variants:
        sets = [word for key, value in changes.items() for body in (0, 1)
                for word in ("--set", f"body.{body}.{key}={value}")]
        run = folder / name.replace(",", "").replace(" ", "_")
        call("run", file, "-o", run, "--force", "-q", "--threads", 1, "--set", "output.history_every=1", *sets)
        show(name, run)


if __name__ == "__main__":
    main()
