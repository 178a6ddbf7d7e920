// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/fem/bars.hpp"
#include "src/fem/mesh.hpp"

namespace whipple::fem {

/// What a file of a mesh holds, whatever its format.
struct MeshData {
  struct Element {
    std::uint64_t tag;  ///< its number in the file
    std::size_t line;   ///< of the file
    int kind;           ///< number of Gmsh
    std::vector<std::uint32_t> nodes;
  };
  struct Group {
    int dimension;
    int tag;
    std::string name;
    std::vector<std::uint32_t> elements;  ///< indices
  };
  std::filesystem::path path;
  const char* called = "physical group";  ///< what the format calls a group
  std::vector<Vector3> nodes;             ///< m
  std::vector<Element> elements;
  std::vector<Group> groups;
  std::string
      remark;  ///< what a user who misses a group should know; a sentence with a blank before it, or nothing
};

/// Kinds of elements by the number that Gmsh gives them (Gmsh reference manual, "MSH file format").
struct ElementKind {
  int number;
  const char* name;
  int dimension;
  std::size_t nodes;
};
inline constexpr int line_kind = 1, hexahedron_kind = 5;
/// Returns the kind of a number; null if it is unknown.
const ElementKind* element_kind(int number);

/// Meshes by group, from a file of Gmsh (formats 2.2 and 4.1, ASCII) an input of Abaqus (keywords),
/// or an unstructured grid of VTK. The readers are
/// the project's own: the library of Gmsh brings 24 packages (OpenCASCADE, FLTK, ...; 180 MB), reports errors without
/// their line, and is under the GPL.
class MeshFile {
 public:
  /// Reads a file; its first line tells the format.
  /// @param length_unit  m per unit of the file's coordinates
  /// @throws InputError naming file and line: not readable, another format, binary, damaged, a node that is
  /// not defined
  static MeshFile read(const std::filesystem::path& path, double length_unit = 1.0);

  /// Names of the groups, "physical 3" for one of Gmsh without a name, in the order of the file.
  /// @param dimension  of the groups; none: all
  [[nodiscard]] std::vector<std::string> group_names(std::optional<int> dimension = {}) const;
  /// Returns what the format calls a group: "physical group", "element set".
  [[nodiscard]] const char* called() const { return data_.called; }

  /// The hexahedra of a group of volumes, checked.
  /// @param group  its name, or its tag: "physical 3" or "3"
  /// @throws InputError if there is no such group (the message lists those that there are), if it is no group
  /// of volumes, holds other elements than eight-node hexahedra, or an element that is degenerate or inverted
  /// (file, line and number of the element)
  [[nodiscard]] Hexahedra hexahedra(const std::string& group) const;

  /// The two-node lines of a group of curves, for bar elements.
  /// @throws InputError as above
  [[nodiscard]] Lines lines(const std::string& group) const;

 private:
  explicit MeshFile(MeshData data) : data_(std::move(data)) {}
  [[nodiscard]] const MeshData::Group& find(const std::string& group, int dimension, int kind) const;
  /// How messages name an element of a group: file and line, number, group.
  [[nodiscard]] std::string located(std::uint32_t element, const std::string& group) const;
  [[nodiscard]] std::vector<Vector3> own_nodes(const MeshData::Group& group,
                                               std::vector<std::uint32_t>& number) const;

  MeshData data_;
};

}  // namespace whipple::fem
