// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
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

/// Holds the points of an unstructured grid with numbers of each.
struct VtkPoints {
  struct Array {
    std::string name;
    std::vector<double> values;
  };
  std::vector<double> points;  ///< x, y, z of each
  std::vector<Array> data;     ///< arrays of one component
};

/// Reads the points of a VTU file, without its cells. @param wanted  selects arrays of the points by name
/// @throws InputError with a message that begins with `file`: damaged, another dataset type, big endian, several
/// pieces, another compression than zlib, an array of another length
VtkPoints read_vtu_points(const std::string& text, const std::string& file,
                          const std::function<bool(std::string_view)>& wanted);

/// Reads the text of a VTU file. @throws InputError with a message that begins with `file`
VtkGrid read_vtu(const std::string& text, const std::string& file);

/// Reads the text of a legacy ASCII file. @throws InputError with a message that begins with `file`
VtkGrid read_legacy_vtk(const std::string& text, const std::string& file);

}  // namespace whipple::fem
