// SPDX-License-Identifier: BSD-3-Clause
// Files of Gmsh: both formats, groups by dimension, elements that cannot be computed with, errors with their
// line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <tuple>

#include "src/core/base/error.hpp"
#include "src/fem/mesh_file.hpp"
#include "src/fem/structured.hpp"
#include "tests/folders.hpp"
#include "tests/unit/fem_support.hpp"
#include "tests/unit/folder_test.hpp"

namespace whipple::fem_test {
namespace {

using fem::Hexahedra;
using ::testing::AllOf;
using ::testing::HasSubstr;

class Gmsh : public FolderTest {
 protected:
  static std::string text_of(const std::string& name) {
    std::ifstream file(whipple::tests::source_folder() + "/tests/data/fem/" + name);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  /// The file with the first `from` replaced.
  std::filesystem::path changed(const std::string& name, const std::string& from,
                                const std::string& to) const {
    std::string text = text_of(name);
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
    std::ofstream(folder_ / "changed.msh") << text;
    return folder_ / "changed.msh";
  }
};

/// Files that Gmsh 4.8.4 wrote from two_boxes.geo: two boxes, 12 and 18 elements, sheared; both formats
/// alike.
TEST_F(Gmsh, ReadsBothFormats) {
  std::vector<Hexahedra> plates;
  for (const char* name : {"two_boxes_22.msh", "two_boxes_41.msh"}) {
    const auto file = fem::MeshFile::read(whipple::tests::source_folder() + "/tests/data/fem/" + name, 1e-3);
    EXPECT_THAT(file.group_names(),
                ::testing::UnorderedElementsAre("plate", "projectile", "rebar", "bottom"));
    const Hexahedra plate = file.hexahedra("plate"), projectile = file.hexahedra("projectile");
    EXPECT_EQ(plate.elements.size(), 12U) << name;
    EXPECT_EQ(plate.nodes.size(), 36U) << name;
    EXPECT_NEAR(fem::volume(plate), 2e-9, 1e-22) << name;
    EXPECT_EQ(projectile.elements.size(), 18U) << name;
    EXPECT_NEAR(fem::volume(projectile), 3e-9, 1e-20) << name;  // sheared by 0.5 over a height of 1.5
    fem::check(plate, "plate");
    fem::check(projectile, "projectile");
    const fem::Lines rebar = file.lines("rebar");
    EXPECT_EQ(rebar.elements.size(), 3U);
    EXPECT_EQ(rebar.nodes.size(), 4U);
    double length = 0.0;
    for (const auto& [a, b] : rebar.elements) length += (rebar.nodes[a] - rebar.nodes[b]).norm();
    EXPECT_NEAR(length, 2e-3, 1e-15);
    plates.push_back(plate);
  }
  EXPECT_EQ(plates[0].nodes.size(), plates[1].nodes.size());
}

/// Two boxes of one element each, side by side along x; the faces at x = 1 have nodes of their own.
std::string two_parts(const std::string& elements, const std::string& gap = "1") {
  std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n16\n";
  int node = 0;
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"0", "1"}, {gap, "2"}}) {
    for (const char* z : {"0", "1"}) {
      for (const auto& [x, y] :
           {std::pair{from, "0"}, std::pair{to, "0"}, std::pair{to, "1"}, std::pair{from, "1"}}) {
        text += std::to_string(++node) + ' ' + x + ' ' + y + ' ' + z + '\n';
      }
    }
  }
  const auto count = std::ranges::count(elements, '\n');
  return text + "$EndNodes\n$Elements\n" + std::to_string(count) + '\n' + elements + "$EndElements\n";
}
constexpr const char* first_part = "1 5 2 1 1 1 2 3 4 5 6 7 8\n";

TEST_F(Gmsh, GroupsAreThoseOfADimension) {
  // A surface and a volume with one tag.
  std::ofstream(folder_ / "tags.msh")
      << "\xEF\xBB\xBF" + two_parts(std::string("1 3 2 1 1 1 2 3 4\n") + first_part);
  const fem::MeshFile file = fem::MeshFile::read(folder_ / "tags.msh");
  EXPECT_THAT(file.group_names(3), ::testing::ElementsAre("physical 1"));
  EXPECT_EQ(file.group_names().size(), 2U);
  for (const char* name : {"physical 1", "1"}) EXPECT_EQ(file.hexahedra(name).elements.size(), 1U) << name;
  EXPECT_THAT(message_of<InputError>([&] { std::ignore = file.hexahedra("2"); }),
              HasSubstr("no physical group"));
  const auto boxes =
      fem::MeshFile::read(whipple::tests::source_folder() + "/tests/data/fem/two_boxes_41.msh");
  EXPECT_THAT(boxes.group_names(3), ::testing::UnorderedElementsAre("plate", "projectile"));
}

TEST_F(Gmsh, ElementsMustNotLieInOneAnother) {
  const auto read = [&](const std::string& text) {
    std::ofstream(folder_ / "overlap.msh") << text;
    return fem::MeshFile::read(folder_ / "overlap.msh").hexahedra("1");
  };
  const auto message = [&](const std::string& text) {
    return message_of<InputError>([&] { std::ignore = read(text); });
  };
  const std::string first = first_part, second = "2 5 2 1 1 9 10 11 12 13 14 15 16\n";
  EXPECT_EQ(fem::unmerged_nodes(read(two_parts(first + second))), 4U);
  EXPECT_EQ(fem::unmerged_nodes(read(two_parts(first + second, "1.1"))), 0U);
  EXPECT_THAT(
      message(two_parts(first + "2 5 2 1 1 1 2 3 4 5 6 7 8\n")),
      HasSubstr("overlap.msh:26: error: element 2 of group \"1\" is the same as element 1 (line 25)"));
  // The same nodes from another corner on, and nodes of its own in the same places.
  EXPECT_THAT(message(two_parts(first + "2 5 2 1 1 2 3 4 1 6 7 8 5\n")), HasSubstr("is the same as"));
  EXPECT_THAT(message(two_parts(first + second, "0")), HasSubstr("is on the same side of a face as"));
}

TEST_F(Gmsh, NamesFileLineAndElement) {
  const auto read = [](const std::filesystem::path& path) {
    return message_of<InputError>([&] { fem::MeshFile::read(path); });
  };
  const auto of_group = [](const std::filesystem::path& path, const std::string& group) {
    return message_of<InputError>([&] { std::ignore = fem::MeshFile::read(path).hexahedra(group); });
  };
  const std::filesystem::path good = whipple::tests::source_folder() + "/tests/data/fem/two_boxes_22.msh";
  EXPECT_THAT(of_group(good, "projektile"),
              AllOf(HasSubstr("no physical group \"projektile\""), HasSubstr("did you mean \"projectile\""),
                    HasSubstr("The mesh has: rebar, bottom, plate, projectile")));
  EXPECT_THAT(of_group(good, "bottom"), HasSubstr("\"bottom\" is one of surfaces, not of volumes"));
  EXPECT_THAT(message_of<InputError>([&] { std::ignore = fem::MeshFile::read(good).lines("plate"); }),
              HasSubstr("is one of volumes, not of curves"));
  EXPECT_THAT(read(folder_ / "none.msh"), HasSubstr("there is no such file"));
  EXPECT_THAT(read(changed("two_boxes_22.msh", "$MeshFormat\n", "solid\n")), HasSubstr("no mesh of Gmsh"));
  EXPECT_THAT(read(changed("two_boxes_22.msh", "2.2 0 8", "2.2 1 8")),
              HasSubstr("changed.msh:2: error: binary file"));
  EXPECT_THAT(read(changed("two_boxes_22.msh", "2.2 0 8", "4 0 8")),
              HasSubstr(":2: error: format 4; supported are 2.2 and 4.1"));
  EXPECT_THAT(read(changed("two_boxes_41.msh", "$EndElements", "")), HasSubstr("expected $EndElements"));
  EXPECT_THAT(read(changed("two_boxes_22.msh", "$Elements\n", "$Comments\n")),
              HasSubstr("ends inside $Comments"));
  EXPECT_THAT(read(changed("two_boxes_22.msh", "\n1 0 0 0\n", "\n1 0 x 0\n")),
              HasSubstr("error: \"x\" is not a coordinate"));
  EXPECT_THAT(read(changed("two_boxes_22.msh", "\n1 0 0 0\n", "\n1 0 0\n")),
              HasSubstr("the line ends where a coordinate is expected"));
  EXPECT_THAT(read(changed("two_boxes_22.msh", "\n1 0 0 0\n", "\n2 0 0 0\n")),
              HasSubstr("node 2 is defined twice"));
  EXPECT_THAT(read(changed("two_boxes_22.msh", "\n1 0 0 0\n", "\n1 0 nan 0\n")),
              HasSubstr("is not a coordinate"));
  EXPECT_THAT(read(changed("two_boxes_22.msh", "\n3 1 \"plate\"", "\n9 1 \"plate\"")),
              HasSubstr(":8: error: \"9\" is not a dimension: 0 to 3"));
}

TEST_F(Gmsh, TakesNoMemoryForWhatAFileOnlyDeclares) {
  const std::string huge = "4000000000000000000";
  const auto read = [](const std::filesystem::path& path) {
    return message_of<InputError>([&] { fem::MeshFile::read(path); });
  };
  EXPECT_THAT(read(changed("two_boxes_22.msh", "\n1 1 2 8 1", "\n1 1 " + huge + " 8 1")),
              HasSubstr("the line ends where a tag is expected"));
  EXPECT_THAT(read(changed("two_boxes_41.msh", "\n0 1 0 1\n", "\n0 1 0 " + huge + "\n")),
              HasSubstr("is not the tag of a node"));
  EXPECT_THAT(read(changed("two_boxes_41.msh", "\n1 0 0 0 2 0 0 1 8", "\n1 0 0 0 2 0 0 " + huge + " 8")),
              HasSubstr("the line ends where the tag of a physical group is expected"));
}

TEST_F(Gmsh, RefusesElementsThatItCannotComputeWith) {
  // The first hexahedron of the plate, by its line in the file.
  const std::string text = text_of("two_boxes_22.msh");
  std::istringstream lines(text);
  std::string line, first;
  std::size_t number = 0, at = 0;
  while (std::getline(lines, line)) {
    ++number;
    std::istringstream words(line);
    int tag = 0, kind = 0, tags = 0, physical = 0;
    if (words >> tag >> kind >> tags >> physical && kind == 5 && tags == 2 && physical == 1) {
      first = line;
      at = number;
      break;
    }
  }
  ASSERT_FALSE(first.empty());
  std::istringstream words(first);
  std::array<int, 13> n{};
  for (int& value : n) words >> value;
  const auto message = [&](const std::string& replacement) {
    const auto path = changed("two_boxes_22.msh", first, replacement);
    return message_of<InputError>([&] { std::ignore = fem::MeshFile::read(path).hexahedra("plate"); });
  };
  const std::string where = "changed.msh:" + std::to_string(at) + ": error: element " + std::to_string(n[0]);
  const auto join = [&](std::span<const int> nodes, int kind) {
    std::ostringstream out;
    out << n[0] << ' ' << kind << " 2 1 " << n[4];
    for (const int node : nodes) out << ' ' << node;
    return out.str();
  };
  const std::span<const int> corners = std::span(n).subspan(5);
  EXPECT_THAT(
      message(join(corners.first(4), 4)),
      HasSubstr(where +
                " of group \"plate\" is one of the 4-node tetrahedra; supported are 8-node hexahedra"));
  const std::array<int, 8> inverted = {n[9], n[10], n[11], n[12], n[5], n[6], n[7], n[8]};
  EXPECT_THAT(message(join(inverted, 5)),
              HasSubstr(where + " of group \"plate\" is inverted or flat at corner 0"));
  std::array<int, 8> degenerate;
  std::ranges::copy(corners, degenerate.begin());
  degenerate[7] = degenerate[6];
  EXPECT_THAT(message(join(degenerate, 5)),
              HasSubstr(where + " of group \"plate\" is degenerate: corners 6 and 7 are one node"));
  EXPECT_THAT(message(join(corners.first(7), 5)),
              HasSubstr("the line ends where the number of a node is expected"));
  degenerate[7] = 999;
  EXPECT_THAT(message(join(degenerate, 5)),
              HasSubstr("element " + std::to_string(n[0]) + ": node 999 is not defined"));
}

/// Two hexahedra and a bar of an input of Abaqus: sets by name, by list, by range and of sets; comments, blank lines, lines
/// that go on, small letters.
const char* const bricks = "two_bricks.inp";

TEST_F(Gmsh, AbaqusWithoutElementSetsIsOneGroup) {
  const std::string all = text_of(bricks);
  std::ofstream(folder_ / "mesh.inp")
      << all.substr(0, all.find("*Element")) << "*Element, type=C3D8\n1, 1,2,3,4,5,6,7,8\n";
  const fem::MeshFile file = fem::MeshFile::read(folder_ / "mesh.inp", 1e-3);
  EXPECT_NEAR(fem::volume(file.hexahedra("all")), 1e-9, 1e-22);
  EXPECT_THAT(file.group_names(3), ::testing::ElementsAre("all"));
}

/// A sector of 30 degrees between the radii 1 and 2 with straight edges: 1/2 sin 30 (2^2 - 1^2) high 1.
TEST_F(Gmsh, AbaqusHasNodesInCylindricalCoordinates) {
  std::ofstream(folder_ / "mesh.inp") << R"(*HEADING
one hexahedron
*NODE, NSET=ALL, SYSTEM=C
1, 1., 0., 0.
2, 2., 0., 0.
3, 2., 30., 0.
4, 1., 30., 0.
5, 1., 0., 1.
6, 2., 0., 1.
7, 2., 30., 1.
8, 1., 30., 1.
*ELEMENT, TYPE=C3D8R, ELSET=E
1, 1,2,3,4,5,6,7,8
*SOLID SECTION, ELSET=E, MATERIAL=M
)";
  const Hexahedra mesh = fem::MeshFile::read(folder_ / "mesh.inp", 1e-3).hexahedra("E");
  EXPECT_NEAR(fem::volume(mesh), 0.75e-9, 1e-22);
  EXPECT_NEAR(mesh.nodes[2][1], 1e-3, 1e-16);
}

TEST_F(Gmsh, AbaqusHasElementSets) {
  const auto read = [&](const std::string& from = "", const std::string& to = "") {
    std::string text = text_of(bricks);
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    std::ofstream(folder_ / "mesh.inp") << text;
    return fem::MeshFile::read(folder_ / "mesh.inp", 1e-3);
  };
  const fem::MeshFile file = read();
  EXPECT_THAT(file.group_names(3), ::testing::ElementsAre("Lower Box", "upper", "both"));
  EXPECT_NEAR(fem::volume(file.hexahedra("Lower Box")), 1e-9, 1e-22);
  EXPECT_NEAR(file.hexahedra("upper").nodes[6][2], 2e-3, 1e-15);
  EXPECT_EQ(file.hexahedra("both").elements.size(), 2U);
  EXPECT_EQ(file.hexahedra("both").nodes.size(), 12U);
  EXPECT_EQ(file.lines("bar").elements.size(), 1U);
  EXPECT_NEAR(fem::volume(read("2, 1., 0., 0.", "2, 1.D0, 0.d0, 0.").hexahedra("Lower Box")), 1e-9, 1e-22)
      << "of Fortran";
  EXPECT_EQ(read(", elset=", ",\n elset=").group_names(3).size(), 3U) << "a keyword in two lines";
  const auto fault = [&](const std::string& from, const std::string& to) {
    return message_of<InputError>([&] { static_cast<void>(read(from, to).hexahedra("both")); });
  };
  EXPECT_THAT(fault("2, 1., 0., 0.", "2 1. 0. 0."), HasSubstr("numbers stand between commas"))
      << "as those of LS-DYNA";
  EXPECT_THAT(fault("2, 1., 0., 0.", "2, 1., x, 0."),
              HasSubstr("mesh.inp:6: error: \"x\" is not a coordinate"));
  EXPECT_THAT(fault("2, 1., 0., 0.", "1, 1., 0., 0."), HasSubstr("node 1 is defined twice"));
  EXPECT_THAT(fault("   7, 8\n", "   7, 13\n"),
              HasSubstr("mesh.inp:20: error: element 1: node 13 is not defined"));
  EXPECT_THAT(fault("   7, 8\n", "   7, 8, 9\n"), HasSubstr("element 1 has 9 nodes instead of 8"));
  EXPECT_THAT(fault("   7, 8\n", ""), HasSubstr("element 1 has 6 nodes instead of 8"));
  EXPECT_THAT(fault("type=C3D8R, elset", "type=CPE4, elset"),
              HasSubstr("of the type \"CPE4\" are not known"));
  EXPECT_THAT(fault("C3D8R\n7, 5, 6, 7, 8, 9, 10, 11, 12", "C3D6\n7, 5, 6, 7, 9, 10, 11"),
              HasSubstr("one of the 6-node prisms"));
  EXPECT_THAT(fault("7, 7, 1", "7, 700000000000, 1"), HasSubstr("is not one of elements"));
  EXPECT_THAT(fault("lower box, 7", "lower boxes, 7"), HasSubstr("is not defined before this line"));
  EXPECT_THAT(fault("*Heading", "*Instance, name=a"), HasSubstr("parts and assemblies"));
  EXPECT_THAT(fault("elset=\"Lower Box\"", "elset=lower"),
              HasSubstr("element set \"lower box\" is not defined"));
  EXPECT_THAT(fault("*Density", "*NFILL"), HasSubstr("generated or moved nodes"));
  EXPECT_THAT(fault("*Density", "*Densty"),
              HasSubstr("mesh.inp:30: error: the keyword *DENSTY is not known here"));
  EXPECT_THAT(fault("NSET=all", "NSET=all, INPUT=nodes.txt"),
              HasSubstr("the parameter INPUT of *NODE is not read"));
  EXPECT_THAT(fault("elset=\"Lower Box\"", "elset=\"Lower Box\", OFFSET=10"),
              HasSubstr("the parameter OFFSET of *ELEMENT is not read"));
  EXPECT_THAT(fault("NSET=all", "NSET=all, SYSTEM=S"), HasSubstr("nodes in the system \"S\" are not read"));
  EXPECT_THAT(fault("1, 1, 2, 3, 4, 5, 6,", "1, 4, 3, 2, 1, 8, 7,\n 6, 5\n2, 1, 2, 3, 4, 5, 6,"),
              HasSubstr("is inverted"));
}

}  // namespace
}  // namespace whipple::fem_test
