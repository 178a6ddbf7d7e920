#!/usr/bin/env pvpython
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the .vtu files of this folder with ParaView: 27 points of a small ball of lead with their masses, in every mode of its
writer. The data arrays beside the mass are not read.

Usage: pvpython write.py [FOLDER]
"""
import pathlib
import sys

from paraview.simple import GetParaViewVersion, SaveData, TrivialProducer
from paraview.vtk import VTK_VERTEX, vtkDoubleArray, vtkIntArray, vtkPoints, vtkUnstructuredGrid

FOLDER = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
MODES = {  # options of the writer, by the name of the file
    "ascii": {"DataMode": "Ascii", "CompressorType": "None"},
    "binary": {"DataMode": "Binary", "CompressorType": "None"},
    "binary_zlib": {"DataMode": "Binary", "CompressorType": "ZLib"},
    "appended": {"DataMode": "Appended", "EncodeAppendedData": 1, "CompressorType": "None"},
    "appended_raw": {"DataMode": "Appended", "EncodeAppendedData": 0, "CompressorType": "None"},
    "appended_zlib": {"DataMode": "Appended", "EncodeAppendedData": 1, "CompressorType": "ZLib"},
    "appended_raw_zlib": {"DataMode": "Appended", "EncodeAppendedData": 0, "CompressorType": "ZLib"},
    "appended_lz4": {"DataMode": "Appended", "EncodeAppendedData": 0, "CompressorType": "LZ4"},
    "appended_lzma": {"DataMode": "Appended", "EncodeAppendedData": 0, "CompressorType": "LZMA"},
}


def grid():
    points, mass, body = vtkPoints(), vtkDoubleArray(), vtkIntArray()
    points.SetDataTypeToDouble()
    mass.SetName("mass")
    body.SetName("body")
    made = vtkUnstructuredGrid()
    for i in range(27):
        points.InsertNextPoint(0.5 * (i % 3), 0.5 * (i // 3 % 3), 0.5 * (i // 9))
        mass.InsertNextValue(1.0 + 0.001 * i)
        body.InsertNextValue(i)
    made.SetPoints(points)
    made.Allocate(27)
    for i in range(27):
        made.InsertNextCell(VTK_VERTEX, 1, [i])
    made.GetPointData().AddArray(mass)
    made.GetPointData().AddArray(body)
    return made


producer = TrivialProducer()
producer.GetClientSideObject().SetOutput(grid())
producer.UpdatePipeline()
for name, options in MODES.items():
    SaveData(str(FOLDER / f"{name}.vtu"), proxy=producer, **options)
print(f"written by ParaView {GetParaViewVersion()}")
