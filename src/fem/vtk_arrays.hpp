// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace whipple::fem {

/// What the files of VTK hold of an unstructured grid, whatever their format.
struct VtkGrid {
  struct CellArray {
    std::string name;
    std::vector<long> values;  ///< of each cell
  };
  std::vector<double> points;  ///< x, y, z of each
  std::vector<long> connectivity, offsets, types;
  std::vector<CellArray> cell_data;  ///< arrays of integers, one component each
  std::size_t line = 1;              ///< of the file, where the cells begin
};

/// Reads the text of a VTU file. @throws InputError that begins with `file`
VtkGrid read_vtu(const std::string& text, const std::string& file);

/// Reads the text of a legacy file in ASCII. @throws InputError that begins with `file`
VtkGrid read_legacy_vtk(const std::string& text, const std::string& file);

}  // namespace whipple::fem
