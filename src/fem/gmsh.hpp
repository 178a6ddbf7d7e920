// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/fem/bars.hpp"
#include "src/fem/mesh.hpp"

namespace whipple::fem {

/// Meshes by physical group, from a file of Gmsh. The reader is the project's own: the library of Gmsh brings
/// 24 packages (OpenCASCADE, FLTK, ...; 180 MB), reports errors without their line, and is under the GPL.
class GmshFile {
 public:
  /// Reads a file of format 2.2 or 4.1, ASCII.
  /// @param length_unit  m per unit of the file's coordinates
  /// @throws InputError naming file and line: not readable, another format, binary, damaged, a node that is
  /// not defined
  static GmshFile read(const std::filesystem::path& path, double length_unit = 1.0);

  /// Names of the groups, "physical 3" for one without a name, in the order of the file.
  /// @param dimension  of the groups; none: all
  [[nodiscard]] std::vector<std::string> group_names(std::optional<int> dimension = {}) const;

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
  friend class GmshReader;
  struct Element {
    std::uint64_t tag;
    std::size_t line;
    int kind;
    std::vector<std::uint32_t> nodes;
  };
  struct Group {
    int dimension;
    int tag;
    std::string name;
    std::vector<std::uint32_t> elements;  // indices
  };
  [[nodiscard]] const Group& find(const std::string& group, int dimension, int kind) const;
  [[nodiscard]] std::vector<Vector3> own_nodes(const Group& group, std::vector<std::uint32_t>& number) const;

  std::filesystem::path path_;
  std::vector<Vector3> nodes_;
  std::vector<Element> elements_;
  std::vector<Group> groups_;
};

}  // namespace whipple::fem
