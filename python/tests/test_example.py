# SPDX-License-Identifier: BSD-3-Clause
"""Test that the example from an EAM file to a figure gives the figure, and the material that the full plan of this
potential gives within the errors of small crystals. Usage: test_example.py WHIPPLE"""
import pathlib
import subprocess
import sys
import tempfile

from whipple import eos

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "examples/eam_to_figure/eam_to_figure.py"


def main():
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, SCRIPT, "--cells", "3", "--steps", "400", "--whipple", sys.argv[1],
                   "--folder", folder]
        text = subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
        figure = (pathlib.Path(folder) / "hugoniot.png").read_bytes()
        material = eos.material(pathlib.Path(folder) / "fitted.toml")
    assert figure.startswith(b"\x89PNG") and len(figure) > 10000, len(figure)
    assert "cu_hugoniot_marsh1980: 144 points, rms deviation of Us 4." in text, text
    # docs/generated/results.md, universal potential u3 of Foiles, Baskes and Daw: C, S, gamma of the plan
    # cases/md/copper_u3_short.toml.
    velocity = material.hugoniot(particle_velocity=1500.0).shock_velocity
    assert abs(velocity / (3902 + 1.317 * 1500) - 1) < 0.015, velocity
    gruneisen = material.reference.gruneisen
    assert abs(gruneisen / 1.857 - 1) < 0.05, gruneisen
    print(f"Us at 1.5 km/s: {velocity:.1f} m/s, Grueneisen parameter {gruneisen:.4f}")


if __name__ == "__main__":
    main()
