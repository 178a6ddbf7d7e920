// SPDX-License-Identifier: BSD-3-Clause
#include "src/fem/vtk_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string_view>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/fem/vtk_arrays.hpp"

namespace whipple::fem {
namespace {

constexpr std::string_view legacy_mark = "# vtk DataFile";

std::string_view begin_of(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? std::string_view() : text.substr(first);
}

/// Maps cell types of VTK (vtkCellType.h) to element kinds; voxels are hexahedra with another order of corners.
constexpr int voxel = 11;
int kind_of(long type) {
  static const std::map<long, int> kinds = {{1, 15},
                                            {3, line_kind},
                                            {5, 2},
                                            {9, 3},
                                            {10, 4},
                                            {voxel, hexahedron_kind},
                                            {12, hexahedron_kind},
                                            {13, 6},
                                            {14, 7},
                                            {21, 8},
                                            {22, 9},
                                            {23, 16},
                                            {24, 11},
                                            {25, 17},
                                            {26, 18},
                                            {27, 19}};
  const auto found = kinds.find(type);
  return found == kinds.end() ? 0 : found->second;
}

void add_nodes(const VtkGrid& grid, double length_unit, MeshData& data) {
  for (std::size_t i = 0; i + 2 < grid.points.size(); i += 3) {
    const Vector3 x(grid.points[i], grid.points[i + 1], grid.points[i + 2]);
    if (!x.allFinite())
      throw InputError(fmt::format("{}: error: point {} is not finite", data.path.string(), i / 3));
    data.nodes.push_back(length_unit * x);
  }
}

void add_elements(const VtkGrid& grid, MeshData& data) {
  const auto fail = [&](std::size_t cell, const std::string& what) {
    throw InputError(fmt::format("{}:{}: error: cell {}: {}", data.path.string(), grid.line, cell, what));
  };
  if (grid.offsets.size() != grid.types.size()) fail(0, "offsets and types differ in length");
  long begin = 0;
  for (std::size_t cell = 0; cell < grid.types.size(); ++cell) {
    const long end = grid.offsets[cell];
    if (end < begin || end > std::ssize(grid.connectivity))
      fail(cell, "its offset is not in the connectivity");
    MeshData::Element element{cell, grid.line, kind_of(grid.types[cell]), {}};
    if (element.kind == 0)
      fail(cell, fmt::format("cells of the type {} of VTK are not known here", grid.types[cell]));
    for (long i = begin; i < end; ++i) {
      const long point = grid.connectivity[static_cast<std::size_t>(i)];
      if (point < 0 || point >= std::ssize(data.nodes))
        fail(cell, fmt::format("there is no point {}", point));
      element.nodes.push_back(static_cast<std::uint32_t>(point));
    }
    const ElementKind& kind = *element_kind(element.kind);
    if (element.nodes.size() != kind.nodes)
      fail(cell, fmt::format("has {} points instead of {}", element.nodes.size(), kind.nodes));
    if (grid.types[cell] == voxel) {
      std::swap(element.nodes[2], element.nodes[3]);
      std::swap(element.nodes[6], element.nodes[7]);
    }
    data.elements.push_back(std::move(element));
    begin = end;
  }
}

/// Adds a group of cells; cells of several dimensions form a group of the largest dimension.
void add_group(const std::string& name, std::vector<std::uint32_t> cells, MeshData& data) {
  int dimension = 0;
  for (const std::uint32_t cell : cells)
    dimension = std::max(dimension, element_kind(data.elements[cell].kind)->dimension);
  data.groups.push_back({dimension, static_cast<int>(data.groups.size()) + 1, name, std::move(cells)});
}

void add_groups(const VtkGrid& grid, MeshData& data) {
  constexpr std::size_t most_groups = 1000;  // per array: arrays with more values number cells, not groups
  for (const VtkGrid::CellArray& array : grid.cell_data) {
    std::map<long, std::vector<std::uint32_t>> cells;
    for (std::size_t cell = 0; cell < array.values.size() && cells.size() <= most_groups; ++cell) {
      cells[array.values[cell]].push_back(static_cast<std::uint32_t>(cell));
    }
    const bool is_numbering = cells.size() > 1 && cells.size() == array.values.size();
    if (cells.size() > most_groups || is_numbering) {
      data.remark += fmt::format(
          " The array \"{}\" has {}: it numbers cells, and its values are no groups.", array.name,
          is_numbering ? "another value in every cell" : fmt::format("more than {} values", most_groups));
      continue;
    }
    for (auto& [value, members] : cells)
      add_group(fmt::format("{} {}", array.name, value), std::move(members), data);
  }
  if (!data.groups.empty()) return;
  std::vector<std::uint32_t> all(data.elements.size());
  for (std::uint32_t cell = 0; cell < all.size(); ++cell) all[cell] = cell;
  add_group("all", std::move(all), data);
}

}  // namespace

bool is_vtk(const std::filesystem::path& path) {
  std::ifstream file = regular_file(path);
  std::string begin(200, '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  begin.resize(static_cast<std::size_t>(file.gcount()));
  const std::string_view text = begin_of(begin);
  return text.starts_with("<?xml") || text.starts_with("<VTKFile") || text.starts_with(legacy_mark);
}

MeshData read_vtk(const std::filesystem::path& path, double length_unit) {
  const std::string text = read_text(path);
  const VtkGrid grid = begin_of(text).starts_with(legacy_mark) ? read_legacy_vtk(text, path.string())
                                                               : read_vtu(text, path.string());
  MeshData data;
  data.path = path;
  data.called = "group";
  add_nodes(grid, length_unit, data);
  add_elements(grid, data);
  if (data.elements.empty()) throw InputError(fmt::format("{}: error: has no cells", path.string()));
  for (const VtkGrid::CellArray& array : grid.cell_data) {
    if (array.values.size() != data.elements.size()) {
      throw InputError(fmt::format("{}: error: the array \"{}\" has {} values for {} cells", path.string(),
                                   array.name, array.values.size(), data.elements.size()));
    }
  }
  add_groups(grid, data);
  return data;
}

}  // namespace whipple::fem
