// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace whipple::fem {

/// Holds the contents of an unstructured grid in a VTK file, independent of its format.
struct VtkGrid {
  struct CellArray {
    std::string name;
    std::vector<long> values;  ///< of each cell
  };
  std::vector<double> points;  ///< x, y, z of each
  std::vector<long> connectivity, offsets, types;
  std::vector<CellArray> cell_data;  ///< arrays of integers, one component each
  std::size_t line = 1;              ///< line in the file where the cells begin
};

/// Reads the text of a VTU file. @throws InputError with a message that begins with `file`
VtkGrid read_vtu(const std::string& text, const std::string& file);

/// Reads the text of a legacy ASCII file. @throws InputError with a message that begins with `file`
VtkGrid read_legacy_vtk(const std::string& text, const std::string& file);

}  // namespace whipple::fem
