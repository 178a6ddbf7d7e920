#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Snapshots exported as VTU and CSV hold what the snapshots hold, with units; elements come back as a mesh. Where Python's
VTK is installed, it reads the same.

Usage: app_export.py WHIPPLE CASE.toml
"""
import csv
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml

import h5py
import numpy as np

from checks import require

WHIPPLE, CASE = sys.argv[1:]
TYPES = {"Float32": "<f4", "Float64": "<f8", "Int64": "<i8", "UInt8": "<u1", "UInt16": "<u2", "UInt64": "<u8"}


def whipple(*arguments, code=0):
    done = subprocess.run([WHIPPLE, *map(str, arguments)], capture_output=True, text=True, timeout=300)
    require(done.returncode == code, f"{arguments}: exit code {done.returncode}, {done.stdout} {done.stderr}")
    return done.stdout + done.stderr


def read_vtu(path):
    """Arrays of a VTU file by part and name, by the rules of VTK's file formats alone."""
    data = path.read_bytes()
    head, _, appended = data.partition(b"<AppendedData encoding=\"raw\">\n_")
    root = xml.fromstring(head + b"</VTKFile>")
    require(root.attrib["byte_order"] == "LittleEndian" and root.attrib["header_type"] == "UInt64", "header")
    arrays = {}
    for part in root.iter():
        for array in part.findall("DataArray"):
            at = int(array.attrib["offset"])
            size = int(np.frombuffer(appended, "<u8", 1, at)[0])
            values = np.frombuffer(appended[at + 8:at + 8 + size], TYPES[array.attrib["type"]])
            width = int(array.attrib["NumberOfComponents"])
            arrays[part.tag, array.attrib["Name"]] = values.reshape(-1, width) if width > 1 else values
    piece = root.find("UnstructuredGrid/Piece").attrib
    return int(piece["NumberOfPoints"]), int(piece["NumberOfCells"]), arrays


def plain(name):
    return re.sub(r" \[.*\]$", "", name)


def equals_the_snapshot(vtu, snapshot, time):
    points, cells, arrays = read_vtu(vtu)
    with h5py.File(snapshot) as file:
        vtk = file["VTKHDF"]
        require(points == len(vtk["Points"]) and cells == len(vtk["Types"]), "numbers of points and cells")
        require(np.array_equal(arrays["Points", "Points"].reshape(-1, 3), vtk["Points"][:]), "positions")
        require(np.array_equal(arrays["Cells", "types"], vtk["Types"][:]), "types")
        require(np.array_equal(arrays["Cells", "connectivity"], vtk["Connectivity"][:]), "connectivity")
        require(np.array_equal(arrays["Cells", "offsets"], vtk["Offsets"][1:]), "offsets")
        require(arrays["FieldData", "TimeValue"][0] == time, "time")
        for part in ("PointData", "CellData"):
            written = {plain(name): name for tag, name in arrays if tag == part}
            require(set(written) == set(vtk[part] if part in vtk else ()), f"{part}: {sorted(written)}")
            for name, full in written.items():
                require(np.array_equal(arrays[part, full], vtk[part][name][:], equal_nan=True), f"{part} {name}")
                unit = vtk[part][name].attrs.get("unit", "")
                unit = unit.decode() if isinstance(unit, bytes) else unit
                require(full == (name if unit in ("", "1") else f"{name} [{unit}]"), f"{full}: the unit is {unit!r}")
    return arrays


def read_by_vtk(path, arrays):
    try:
        from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
        from vtkmodules.util.numpy_support import vtk_to_numpy
    except ImportError:
        print("not installed: python3-vtk9; the files were read by this test alone")
        return
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    for (part, name), values in arrays.items():
        if part in ("PointData", "CellData"):
            data = grid.GetPointData() if part == "PointData" else grid.GetCellData()
            require(np.array_equal(vtk_to_numpy(data.GetArray(name)), values, equal_nan=True), f"VTK reads another {name}")
    require(grid.GetNumberOfCells() == len(arrays["Cells", "types"]), "VTK reads other cells")
    print("VTK reads the same")


def main():
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        run = folder / "run"
        whipple("run", CASE, "-o", run, "--quiet", "--set", "time.end=0.04 us", "--set", "body.1.discretization.method=finite_elements")
        whipple("export", run, "-o", folder / "vtu")
        index = xml.parse(folder / "vtu" / "case.particles.pvd" if (folder / "vtu" / "case.particles.pvd").exists()
                          else next((folder / "vtu").glob("*.particles.pvd"))).getroot()
        entries = [(float(e.attrib["timestep"]), e.attrib["file"]) for e in index.iter("DataSet")]
        require(len(entries) == 3 and entries[0][0] == 0.0 and abs(entries[-1][0] - 4e-8) < 1e-15, f"index: {entries}")
        for time, name in entries:
            for kind in ("particles", "elements"):
                vtu = folder / "vtu" / name.replace("particles", kind)
                arrays = equals_the_snapshot(vtu, run / vtu.with_suffix(".hdf").name, time)
        read_by_vtk(vtu, arrays)

        # CSV of particles and of elements: heads with units, one row each.
        whipple("export", run, "-o", folder / "csv", "--format", "csv", "--fields", "velocity,pressure,body,id", "--last")
        files = sorted(path.name for path in (folder / "csv").iterdir())
        require(len(files) == 2 and all(name.endswith(".000002.csv") for name in files), f"{files}")
        with (folder / "csv" / files[1]).open(newline="") as stream:
            rows = list(csv.DictReader(stream))
        require(list(rows[0]) == ["x [m]", "y [m]", "z [m]", "body", "id", "pressure [Pa]", "velocity_x [m/s]", "velocity_y [m/s]",
                                  "velocity_z [m/s]"], f"{list(rows[0])}")
        with h5py.File(run / files[1].replace(".csv", ".hdf")) as file:
            require(len(rows) == len(file["VTKHDF/Points"]), "rows")
            require(np.array_equal(np.float32([row["pressure [Pa]"] for row in rows]), file["VTKHDF/PointData/pressure"][:]), "pressure")
            require(np.array_equal(np.uint64([row["id"] for row in rows]), file["VTKHDF/PointData/id"][:]), "numbers")
        with (folder / "csv" / files[0]).open(newline="") as stream:
            rows = list(csv.DictReader(stream))
        with h5py.File(run / files[0].replace(".csv", ".hdf")) as file:
            vtk = file["VTKHDF"]
            centres = vtk["Points"][:][vtk["Connectivity"][:].reshape(-1, 8)].astype(float).mean(axis=1)
            found = np.array([[float(row[f"{a} [m]"]) for a in "xyz"] for row in rows])
            require(np.allclose(found, centres, rtol=1e-6, atol=1e-12), "centres of the elements")

        # What is refused leaves nothing behind.
        for name, code in (("pressure,hardness", 2), ("", 2)):
            whipple("export", run, "-o", folder / "refused", "--fields", name, code=code)
            require(not (folder / "refused").exists(), f"a folder in spite of --fields {name!r}")
        whipple("export", run, "-o", "/proc/nowhere", code=2)
        shutil.copytree(run, folder / "without_elements")
        for path in (folder / "without_elements").glob("*.elements.*"):
            path.unlink()
        whipple("export", folder / "without_elements", "-o", folder / "particles", "--last")
        files = sorted(path.name for path in (folder / "particles").iterdir())
        require(len(files) == 2 and all("particles" in name for name in files), f"{files}")

        # The elements as the mesh of a body of another run.
        first = folder / "vtu" / entries[0][1].replace("particles", "elements")
        text = pathlib.Path(CASE).read_text(encoding="utf-8")
        shape = re.search(r"shape = \{ box.*\n", text)[0]
        mesh = f'discretization = {{ method = "finite_elements", mesh = "{first}", mesh_unit = "1 m", group = "body 1" }}\n'
        (folder / "again.toml").write_text(text.replace(shape, mesh))
        told = whipple("check", folder / "again.toml")
        with h5py.File(run / first.with_suffix(".hdf").name) as file:
            elements = len(file["VTKHDF/Types"])
        require(str(elements) in told, f"{elements} elements: {told}")
        (folder / "again.toml").write_text(text.replace(shape, mesh.replace("body 1", "body 7")))
        told = whipple("check", folder / "again.toml", code=2)
        require('no group "body 7"' in told and "body 1" in told, told)

        told = whipple("export", run, "-o", folder / "csv", code=2)
        require("not an empty folder" in told, told)
        told = whipple("export", run, "-o", folder / "x", "--fields", "presure", code=2)
        require('no field "presure", did you mean "pressure"?' in told, told)
        require(not (folder / "x").exists() or not list((folder / "x").iterdir()), "files of a refused export")
        told = whipple("export", folder, "-o", folder / "y", code=2)
        require("contains no run.toml" in told, told)
    print("exported snapshots hold what was written")


main()
