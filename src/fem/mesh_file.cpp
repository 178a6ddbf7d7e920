// SPDX-License-Identifier: BSD-3-Clause
#include "src/fem/mesh_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <string_view>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/text.hpp"
#include "src/fem/abaqus.hpp"
#include "src/fem/facets.hpp"
#include "src/fem/gmsh.hpp"
#include "src/fem/structured.hpp"
#include "src/fem/vtk_mesh.hpp"

namespace whipple::fem {
namespace {

constexpr std::array kinds = {ElementKind{1, "2-node lines", 1, 2},
                              ElementKind{2, "3-node triangles", 2, 3},
                              ElementKind{3, "4-node quadrangles", 2, 4},
                              ElementKind{4, "4-node tetrahedra", 3, 4},
                              ElementKind{5, "8-node hexahedra", 3, 8},
                              ElementKind{6, "6-node prisms", 3, 6},
                              ElementKind{7, "5-node pyramids", 3, 5},
                              ElementKind{8, "3-node lines", 1, 3},
                              ElementKind{9, "6-node triangles", 2, 6},
                              ElementKind{10, "9-node quadrangles", 2, 9},
                              ElementKind{11, "10-node tetrahedra", 3, 10},
                              ElementKind{12, "27-node hexahedra", 3, 27},
                              ElementKind{13, "18-node prisms", 3, 18},
                              ElementKind{14, "14-node pyramids", 3, 14},
                              ElementKind{15, "points", 0, 1},
                              ElementKind{16, "8-node quadrangles", 2, 8},
                              ElementKind{17, "20-node hexahedra", 3, 20},
                              ElementKind{18, "15-node prisms", 3, 15},
                              ElementKind{19, "13-node pyramids", 3, 13}};

}  // namespace

const ElementKind* element_kind(int number) {
  const auto found = std::ranges::find(kinds, number, &ElementKind::number);
  return found == kinds.end() ? nullptr : &*found;
}

MeshFile MeshFile::read(const std::filesystem::path& path, double length_unit) {
  return MeshFile(is_vtk(path)      ? read_vtk(path, length_unit)
                  : is_abaqus(path) ? read_abaqus(path, length_unit)
                                    : read_gmsh(path, length_unit));
}

std::vector<std::string> MeshFile::group_names(std::optional<int> dimension) const {
  std::vector<std::string> names;
  for (const MeshData::Group& group : data_.groups) {
    if (!dimension || group.dimension == *dimension) names.push_back(group.name);
  }
  return names;
}

const MeshData::Group& MeshFile::find(const std::string& name, int dimension, int kind) const {
  const std::vector<std::string> names = group_names();
  if (names.empty()) {
    throw InputError(fmt::format("{}: the mesh has no {}s; a body needs one (Gmsh: Physical Volume)",
                                 data_.path.string(), data_.called));
  }
  // Groups are identified with their dimension: tags of surfaces and volumes are numbered separately, and may be equal.
  const auto is_called = [&](const MeshData::Group& g) {
    return g.name == name || name == fmt::format("physical {}", g.tag) || name == std::to_string(g.tag);
  };
  const auto same = [&](const MeshData::Group& g) { return g.dimension == dimension && g.name == name; };
  const auto tagged = [&](const MeshData::Group& g) { return g.dimension == dimension && is_called(g); };
  auto found = std::ranges::find_if(data_.groups, same);
  if (found == data_.groups.end()) found = std::ranges::find_if(data_.groups, tagged);
  if (found == data_.groups.end()) found = std::ranges::find_if(data_.groups, is_called);
  if (found == data_.groups.end()) {
    constexpr std::size_t most_listed = 20;
    std::vector<std::string> listed = names;
    if (names.size() > most_listed) {
      listed.resize(most_listed);
      listed.push_back(fmt::format("{} more", names.size() - most_listed));
    }
    const std::string nearest = did_you_mean(name, names);
    throw InputError(fmt::format("{}: no {} \"{}\"{} The mesh has: {}.{}", data_.path.string(), data_.called,
                                 name, nearest.empty() ? "." : nearest, fmt::join(listed, ", "),
                                 data_.remark));
  }
  constexpr std::array dimensions = {"points", "curves", "surfaces", "volumes"};
  if (found->dimension != dimension) {
    throw InputError(fmt::format("{}: {} \"{}\" is one of {}, not of {}", data_.path.string(), data_.called,
                                 name, dimensions[static_cast<std::size_t>(found->dimension)],
                                 dimensions[static_cast<std::size_t>(dimension)]));
  }
  if (found->elements.empty()) {
    throw InputError(fmt::format("{}: {} \"{}\" has no elements", data_.path.string(), data_.called, name));
  }
  for (const std::uint32_t e : found->elements) {
    const MeshData::Element& element = data_.elements[e];
    if (element.kind == kind) continue;
    throw InputError(
        fmt::format("{}:{}: error: element {} of group \"{}\" is one of the {}; supported are {} (gmsh: "
                    "transfinite volumes with "
                    "Recombine Surface, or Mesh.SubdivisionAlgorithm = 2)",
                    data_.path.string(), element.line, element.tag, name, element_kind(element.kind)->name,
                    element_kind(kind)->name));
  }
  return *found;
}

std::vector<Vector3> MeshFile::own_nodes(const MeshData::Group& group,
                                         std::vector<std::uint32_t>& number) const {
  constexpr std::uint32_t unnumbered = 0xffffffff;
  number.assign(data_.nodes.size(), unnumbered);
  std::vector<Vector3> own;
  for (const std::uint32_t e : group.elements) {
    for (const std::uint32_t node : data_.elements[e].nodes) {
      if (number[node] != unnumbered) continue;
      number[node] = static_cast<std::uint32_t>(own.size());
      own.push_back(data_.nodes[node]);
    }
  }
  return own;
}

std::string MeshFile::located(std::uint32_t element, const std::string& group) const {
  return fmt::format("{}:{}: error: element {} of group \"{}\"", data_.path.string(),
                     data_.elements[element].line, data_.elements[element].tag, group);
}

Hexahedra MeshFile::hexahedra(const std::string& name) const {
  const MeshData::Group& group = find(name, 3, hexahedron_kind);
  std::vector<std::uint32_t> number;
  Hexahedra result;
  result.nodes = own_nodes(group, number);
  for (const std::uint32_t e : group.elements) {
    Corners& corners = result.elements.emplace_back();
    std::ranges::transform(data_.elements[e].nodes, corners.begin(),
                           [&](std::uint32_t node) { return number[node]; });
  }
  if (const auto fault = first_fault(result)) {
    throw InputError(fmt::format("{} is {}", located(group.elements[fault->element], name), fault->reason));
  }
  const auto require_apart = [&](const Hexahedra& mesh) {
    const auto found = first_overlap(mesh);
    if (!found) return;
    const MeshData::Element& other = data_.elements[group.elements[found->other]];
    throw InputError(fmt::format("{} {} element {} (line {})", located(group.elements[found->element], name),
                                 found->same ? "is the same as" : "is on the same side of a face as",
                                 other.tag, other.line));
  };
  require_apart(result);
  if (unmerged_nodes(result) > 0) {
    Hexahedra merged = result;
    merge_nodes(merged, coincidence(merged));
    require_apart(merged);  // detects overlapping parts with duplicate nodes
  }
  return result;
}

Lines MeshFile::lines(const std::string& name) const {
  const MeshData::Group& group = find(name, 1, line_kind);
  std::vector<std::uint32_t> number;
  Lines result;
  result.nodes = own_nodes(group, number);
  for (const std::uint32_t e : group.elements) {
    const auto& nodes = data_.elements[e].nodes;
    if (nodes[0] == nodes[1]) {
      throw InputError(fmt::format("{} has one node twice", located(e, name)));
    }
    result.add({number[nodes[0]], number[nodes[1]]});
  }
  return result;
}

}  // namespace whipple::fem
