#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Opens the particle series of a run in ParaView and compares what it shows with the files.

usage: io_paraview.py RUN_DIR [--picture FILE.png]

Needs paraview, python3-paraview, xvfb, xauth (scripts/install_deps.sh --paraview) and python3-h5py. h5py reads the
expected values in this process; ParaView runs in another (pvbatch under xvfb-run), since both bring an HDF5 library.
Checked at every time of the index: the physical time, the number of points and of cells, the range of every field,
and that a threshold on the phase keeps as many cells as there are particles of that phase.
Exit code 0: all agree; 1: a difference; 2: not a run, or ParaView is missing.
"""
import argparse
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

LIQUID = 2  # number of the phase whose cells the threshold keeps


def expected_values(series):
    """What the files hold, by time."""
    import h5py
    import numpy as np
    steps = []
    for entry in json.loads(series.read_text())["files"]:
        with h5py.File(series.parent / entry["name"], "r") as file:
            vtk = file["VTKHDF"]
            fields = {}
            for name, array in vtk["PointData"].items():
                values = np.asarray(array[:], dtype=float).reshape(len(array), -1)
                if len(values):
                    fields[name] = [[float(column.min()), float(column.max())] for column in values.T]
            phase = vtk["PointData"]["phase"][:] if "phase" in vtk["PointData"] else None
            steps.append({"time": entry["time"], "points": int(vtk["NumberOfPoints"][:].sum()), "fields": fields,
                          "liquid": None if phase is None else int((phase == LIQUID).sum())})
    return {"series": str(series), "steps": steps}


def inside_paraview(expected_file, picture):
    """Runs in pvbatch."""
    from paraview import simple
    expected = json.loads(pathlib.Path(expected_file).read_text())
    steps = expected["steps"]
    errors = []

    def compare(found, wanted, what, tolerance=0.0):
        if abs(found - wanted) > tolerance * max(abs(wanted), 1e-30):
            errors.append(f"{what}: {found}, expected {wanted}")

    print("ParaView", simple.GetParaViewVersion(), flush=True)
    reader = simple.OpenDataFile(expected["series"])
    if reader is None:
        raise SystemExit("no reader takes the series")
    times = list(reader.TimestepValues) if hasattr(reader.TimestepValues, "__len__") else [reader.TimestepValues]
    if times != [step["time"] for step in steps]:
        errors.append(f"times {times}, expected {[step['time'] for step in steps]}")
    threshold = simple.Threshold(Input=reader, Scalars=["POINTS", "phase"], LowerThreshold=LIQUID,
                                 UpperThreshold=LIQUID, ThresholdMethod="Between")
    for step in steps:
        reader.UpdatePipeline(step["time"])
        information = reader.GetDataInformation()
        at = f"t = {step['time']:g} s"
        compare(information.GetNumberOfPoints(), step["points"], f"{at}: points")
        compare(information.GetNumberOfCells(), step["points"], f"{at}: cells")
        arrays = reader.PointData
        for name, ranges in step["fields"].items():
            array = arrays.GetArray(name)
            if array is None:
                errors.append(f"{at}: the field {name} is missing")
                continue
            compare(array.GetNumberOfComponents(), len(ranges), f"{at}: components of {name}")
            for component, (lower, upper) in enumerate(ranges):
                found = array.GetRange(component)
                compare(found[0], lower, f"{at}: least {name}[{component}]", 1e-6)
                compare(found[1], upper, f"{at}: largest {name}[{component}]", 1e-6)
        if step["liquid"]:
            threshold.UpdatePipeline(step["time"])
            compare(threshold.GetDataInformation().GetNumberOfCells(), step["liquid"], f"{at}: liquid cells")
    if picture:
        draw(simple, reader, steps[-1], picture)
    # ParaView 5.11 would close the file after HDF5 has shut down, and HDF5 complains.
    simple.Delete(threshold)
    simple.Delete(reader)
    del threshold, reader
    for error in errors:
        print("DIFFERENCE:", error)
    if errors:
        raise SystemExit(1)
    print(f"{len(steps)} times, {steps[-1]['points']} particles, {len(steps[-1]['fields'])} fields: all agree")


def draw(simple, reader, step, picture):
    """Point Gaussian spheres coloured by temperature (or speed), from the side."""
    view = simple.CreateView("RenderView")
    view.ViewSize = [1200, 900]
    view.ViewTime = step["time"]
    view.OrientationAxesVisibility = 1
    display = simple.Show(reader, view)
    display.SetRepresentationType("Point Gaussian")
    display.ShaderPreset = "Sphere"
    bounds = reader.GetDataInformation().GetBounds()
    display.GaussianRadius = 0.003 * max(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4])
    name = "temperature" if "temperature" in step["fields"] else "velocity"
    simple.ColorBy(display, ("POINTS", name))
    display.RescaleTransferFunctionToDataRange(True)
    display.SetScalarBarVisibility(view, True)
    middle = [(bounds[2 * i] + bounds[2 * i + 1]) / 2 for i in range(3)]
    view.CameraFocalPoint = middle
    view.CameraPosition = [middle[0] - 1.0, middle[1] - 0.6, middle[2] - 0.3]
    view.CameraViewUp = [0, 1, 0]
    simple.ResetCamera(view)
    simple.SaveScreenshot(picture, view)
    simple.Delete(view)  # before the virtual screen goes


def main():
    parser = argparse.ArgumentParser(prog="paraview_check", description="Compares ParaView's view of a run with it.")
    parser.add_argument("run", metavar="RUN_DIR", nargs="?")
    parser.add_argument("--picture", metavar="FILE.png")
    parser.add_argument("--inside", metavar="EXPECTED.json", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.inside:
        inside_paraview(arguments.inside, arguments.picture)
        return 0
    programs = {name: shutil.which(name) for name in ("pvbatch", "xvfb-run")}
    missing = [name for name, path in programs.items() if path is None]
    if missing:
        print(f"paraview_check: error: {' and '.join(missing)} not found", file=sys.stderr)
        return 2
    series = sorted(pathlib.Path(arguments.run or ".").glob("*.particles.hdf.series"))
    if not series:
        print(f"paraview_check: error: {arguments.run}: holds no *.particles.hdf.series", file=sys.stderr)
        return 2
    with tempfile.TemporaryDirectory() as folder:
        expected = pathlib.Path(folder) / "expected.json"
        expected.write_text(json.dumps(expected_values(series[0].resolve())))
        command = [programs["xvfb-run"], "-a", "-s", "-screen 0 1280x1024x24", programs["pvbatch"], __file__,
                   "--inside", str(expected)]
        if arguments.picture:
            command += ["--picture", arguments.picture]
        result = subprocess.run(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    print(result.stdout, end="")
    complaints = [word for word in ("HDF5-DIAG", "ERR|", "vtkHDFReader") if word in result.stdout]
    if complaints:
        print(f"paraview_check: ParaView complained: {', '.join(complaints)}", file=sys.stderr)
        return 1
    return 1 if result.returncode != 0 else 0


if __name__ == "__main__":
    sys.exit(main())
