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

/// Holds the contents of a mesh file, independent of its format.
struct MeshData {
  struct Element {
    std::uint64_t tag;  ///< number in the file
    std::size_t line;   ///< line in the file
    int kind;           ///< element kind, numbered as by Gmsh
    std::vector<std::uint32_t> nodes;
  };
  struct Group {
    int dimension;
    int tag;
    std::string name;
    std::vector<std::uint32_t> elements;  ///< indices
  };
  std::filesystem::path path;
  const char* called = "physical group";  ///< name of a group in the terms of the format
  std::vector<Vector3> nodes;             ///< m
  std::vector<Element> elements;
  std::vector<Group> groups;
  std::string remark;  ///< hint for users who miss a group: a sentence after a blank, or empty
};

/// Describes a kind of element, numbered as by Gmsh (Gmsh reference manual, "MSH file format").
struct ElementKind {
  int number;
  const char* name;
  int dimension;
  std::size_t nodes;
};
inline constexpr int line_kind = 1, hexahedron_kind = 5;
/// Returns the kind with a number; null if it is unknown.
const ElementKind* element_kind(int number);

/// Holds meshes by group, from a Gmsh file (formats 2.2 and 4.1, ASCII), an Abaqus input file (keywords), or an
/// unstructured VTK grid. The readers are implemented here because the Gmsh library depends on 24 packages
/// (OpenCASCADE, FLTK, ...; 180 MB), reports errors without line numbers, and is under the GPL.
class MeshFile {
 public:
  /// Reads a file; its first line determines the format.
  /// @param length_unit  m per unit of the coordinates in the file
  /// @throws InputError naming file and line: unreadable, unknown format, binary, damaged, undefined node
  static MeshFile read(const std::filesystem::path& path, double length_unit = 1.0);

  /// Returns the names of the groups, "physical 3" for an unnamed Gmsh group, in the order of the file.
  /// @param dimension  of the groups; none: all
  [[nodiscard]] std::vector<std::string> group_names(std::optional<int> dimension = {}) const;
  /// Returns the term of the format for a group: "physical group", "element set".
  [[nodiscard]] const char* called() const { return data_.called; }

  /// Returns the hexahedra of a group of volumes, checked.
  /// @param group  its name, or its tag: "physical 3" or "3"
  /// @throws InputError if there is no such group (the message lists the existing ones), if it is not a group of
  /// volumes, contains elements other than eight-node hexahedra, or a degenerate or inverted element (file, line and
  /// number of the element)
  [[nodiscard]] Hexahedra hexahedra(const std::string& group) const;

  /// Returns the two-node lines of a group of curves, for bar elements.
  /// @throws InputError as above
  [[nodiscard]] Lines lines(const std::string& group) const;

 private:
  explicit MeshFile(MeshData data) : data_(std::move(data)) {}
  [[nodiscard]] const MeshData::Group& find(const std::string& group, int dimension, int kind) const;
  /// Returns the identification of an element in messages: file and line, number, group.
  [[nodiscard]] std::string located(std::uint32_t element, const std::string& group) const;
  [[nodiscard]] std::vector<Vector3> own_nodes(const MeshData::Group& group,
                                               std::vector<std::uint32_t>& number) const;

  MeshData data_;
};

}  // namespace whipple::fem
