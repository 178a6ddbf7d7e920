#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The files of a series against the rules of docs/manual/output.md, read by a program that is not ours (h5py).

usage: io_vtkhdf_schema.py RUN_DIR [ranks]
"""
import json
import pathlib
import sys

import h5py
import numpy as np

from checks import require

BUILT_IN_FILTERS = {"deflate", "shuffle", "fletcher32", "scaleoffset"}
REALS = ("mass pressure temperature density internal_energy melted_fraction vaporised_fraction plastic_strain "
         "void_fraction distension failure_threshold_factor von_mises_stress artificial_viscosity sound_speed volume").split()
POINT_DATA = {name: ("float32", 0) for name in REALS} | {
    "velocity": ("float32", 3), "stress": ("float32", 6), "phase": ("uint8", 0), "failed": ("uint8", 0),
    "body": ("uint16", 0), "material": ("uint16", 0), "id": ("uint64", 0),
}


def filters(dataset):
    properties = dataset.id.get_create_plist()
    return [properties.get_filter(i)[3].decode() for i in range(properties.get_nfilters())]


def check_file(path, time, ranks):
    with path.open("rb") as stream:
        require(stream.read(9)[1:4] == b"HDF", f"{path}: no HDF5 signature at the beginning")
    with h5py.File(path, "r") as file:
        vtk = file["VTKHDF"]
        version = vtk.attrs["Version"]
        require(version.dtype == np.int64 and list(version) == [1, 0], f"{path}: Version {version}")
        kind = vtk.attrs.get_id("Type")
        require(not kind.get_type().is_variable_str() and kind.get_type().get_size() == 16 and kind.shape == (),
                f"{path}: Type is not a fixed-length text of 16")
        require(vtk.attrs["Type"] == b"UnstructuredGrid", f"{path}: Type {vtk.attrs['Type']}")

        counts = vtk["NumberOfPoints"][:]
        n = int(counts.sum())
        require(len(counts) == ranks, f"{path}: {len(counts)} partitions for {ranks} ranks")
        for name in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"):
            require(vtk[name].dtype == np.int64 and (vtk[name][:] == counts).all(), f"{path}: {name}")
        require(vtk["Points"].dtype == np.float32 and vtk["Points"].shape == (n, 3), f"{path}: Points")
        require(vtk["Types"].dtype == np.uint8 and (vtk["Types"][:] == 1).all() and len(vtk["Types"]) == n,
                f"{path}: Types")
        require((vtk["Connectivity"][:] == np.concatenate([np.arange(c) for c in counts])).all(),
                f"{path}: Connectivity is not local to the partitions")
        require((vtk["Offsets"][:] == np.concatenate([np.arange(c + 1) for c in counts])).all(), f"{path}: Offsets")

        for name, array in vtk["PointData"].items():
            require(name in POINT_DATA, f"{path}: unexpected field {name}")
            kind, columns = POINT_DATA[name]
            require(array.dtype == kind, f"{path}: {name} is {array.dtype}")
            require(array.shape == ((n,) if columns == 0 else (n, columns)), f"{path}: {name} has shape {array.shape}")
            require("unit" in array.attrs, f"{path}: {name} has no unit")
            require(name != "pressure" or array.attrs["unit"] == "Pa", f"{path}: pressure in {array.attrs['unit']}")
        require({"velocity", "mass", "body", "id"} <= set(vtk["PointData"]), f"{path}: a field of reports is missing")
        require(len(np.unique(vtk["PointData/id"][:])) == n, f"{path}: an id occurs twice")

        for name, array in vtk["FieldData"].items():
            require(h5py.check_string_dtype(array.dtype) is None or h5py.check_string_dtype(array.dtype).length is None,
                    f"{path}: FieldData/{name} is a fixed-length text")
        require(vtk["FieldData/TimeValue"].dtype == np.float64 and list(vtk["FieldData/TimeValue"][:]) == [time],
                f"{path}: TimeValue is not the time of the index")

        def check_filters(name, item):
            if isinstance(item, h5py.Dataset):
                require(set(filters(item)) <= BUILT_IN_FILTERS, f"{path}: {name} uses {filters(item)}")
                if item.chunks:
                    require(item.chunks[0] <= 2**18 and (item.chunks[0] >= 2**16 or item.chunks[0] == item.shape[0]),
                            f"{path}: {name} has chunks {item.chunks}")
        vtk.visititems(check_filters)
        require(isinstance(file["run"].attrs["input"], str) and "[[body]]" in file["run"].attrs["input"],
                f"{path}: the input is not in /run")
        return n


def main():
    folder = pathlib.Path(sys.argv[1])
    ranks = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    (index_path,) = folder.glob("*.particles.hdf.series")
    index = json.loads(index_path.read_text())
    require(index["file-series-version"] == "1.0", "file-series-version")
    times = [entry["time"] for entry in index["files"]]
    require(times == sorted(set(times)), f"times do not ascend: {times}")
    counts = [check_file(folder / entry["name"], entry["time"], ranks) for entry in index["files"]]
    files = sorted(path.name for path in folder.glob("*.particles.*.hdf"))
    require(files == [entry["name"] for entry in index["files"]], "files and index differ")
    require(not list(folder.glob("*.partial")), "a temporary file was left")
    print(f"{len(counts)} files, {counts[0]} to {counts[-1]} particles, {ranks} partitions each: valid")


if __name__ == "__main__":
    main()
