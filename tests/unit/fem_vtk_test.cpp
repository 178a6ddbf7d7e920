// SPDX-License-Identifier: BSD-3-Clause
// Meshes of VTK: every encoding gives the same mesh, groups by arrays of integers, errors that name the file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "src/core/base/error.hpp"
#include "src/fem/mesh_file.hpp"
#include "src/fem/structured.hpp"
#include "tests/folders.hpp"
#include "tests/unit/fem_support.hpp"
#include "tests/unit/folder_test.hpp"

namespace whipple::fem_test {
namespace {

using ::testing::HasSubstr;

class Vtk : public FolderTest {
 protected:
  static std::string text_of(const std::string& name) {
    std::ifstream file(whipple::tests::source_folder() + "/tests/data/fem/" + name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  /// What is said of a file in which the first `from` is replaced; nothing if it is read.
  std::string fault(const std::string& name, const std::string& from, const std::string& to) const {
    std::string text = text_of(name);
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
    std::ofstream(folder_ / "changed.vtu", std::ios::binary) << text;
    try {
      static_cast<void>(fem::MeshFile::read(folder_ / "changed.vtu").hexahedra("body 0"));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
};

/// Files that VTK 9.1 wrote of one grid: three unit cubes in a row, the third of another body, and a line.
TEST_F(Vtk, EveryEncodingIsTheSameMesh) {
  for (const char* name : {"boxes_ascii.vtu", "boxes_base64.vtu", "boxes_zlib.vtu", "boxes_raw.vtu",
                           "boxes_appended_zlib.vtu", "boxes_raw_zlib.vtu", "boxes_51.vtk", "boxes_42.vtk"}) {
    const auto file = fem::MeshFile::read(whipple::tests::source_folder() + "/tests/data/fem/" + name, 1e-3);
    EXPECT_EQ(file.group_names(), (std::vector<std::string>{"body 0", "body 1", "body 2"})) << name;
    EXPECT_EQ(file.group_names(3), (std::vector<std::string>{"body 0", "body 1"})) << name;
    const fem::Hexahedra two = file.hexahedra("body 0"), one = file.hexahedra("body 1");
    EXPECT_EQ(two.elements.size(), 2U) << name;
    EXPECT_EQ(two.nodes.size(), 12U) << name;
    EXPECT_NEAR(fem::volume(two), 2e-9, 1e-22) << name;
    EXPECT_NEAR(fem::volume(one), 1e-9, 1e-22) << name;
    EXPECT_NEAR(one.nodes.front().x(), 2e-3, 1e-15) << name;
    fem::check(two, name);
    EXPECT_EQ(file.lines("body 2").elements.size(), 1U) << name;
  }
}

TEST_F(Vtk, WithoutArraysOfIntegersAllCellsAreOneGroup) {
  std::string text = text_of("boxes_ascii.vtu");
  const std::size_t from = text.find("<CellData>"), to = text.find("</CellData>");
  text.erase(from, to + 11 - from);
  std::ofstream(folder_ / "plain.vtu") << text;
  const auto file = fem::MeshFile::read(folder_ / "plain.vtu");
  EXPECT_EQ(file.group_names(3), std::vector<std::string>{"all"});
  EXPECT_THROW(static_cast<void>(file.hexahedra("all")), InputError) << "the line is no hexahedron";
}

/// An array that numbers the cells makes no groups; who asks for one of them is told.
TEST_F(Vtk, NumbersOfCellsAreNoGroups) {
  std::string text = text_of("boxes_ascii.vtu");
  const std::size_t values = text.find("0 0 1 2");
  ASSERT_NE(values, std::string::npos);
  text.replace(values, 7, "0 3 1 2");
  std::ofstream(folder_ / "numbered.vtu") << text;
  const auto file = fem::MeshFile::read(folder_ / "numbered.vtu");
  EXPECT_EQ(file.group_names(), std::vector<std::string>{"all"});
  try {
    static_cast<void>(file.hexahedra("body 3"));
    FAIL() << "a group of one cell";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                HasSubstr("no group \"body 3\". The mesh has: all. The array \"body\" has another "
                          "value in every cell: it numbers cells"));
  }
}

TEST_F(Vtk, VoxelsAreHexahedraWithAnotherOrder) {
  std::ofstream(folder_ / "voxel.vtk")
      << "# vtk DataFile Version 3.0\nvoxel\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 float\n"
         "0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1\nCELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n11\n";
  EXPECT_NEAR(fem::volume(fem::MeshFile::read(folder_ / "voxel.vtk").hexahedra("all")), 1.0, 1e-12);
}

// Arrays that a mesh does not need are left out, whatever they are.
TEST_F(Vtk, ArraysThatAreNotNeededAreLeftOut) {
  std::string text = "# vtk DataFile Version 3.0\nc\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 float\n";
  for (const char* point : {"0 0 0", "1 0 0", "1 1 0", "0 1 0", "0 0 1", "1 0 1", "1 1 1", "0 1 1"})
    text += std::string(point) + "\n";
  text +=
      "CELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n12\nCELL_DATA 1\nGLOBAL_IDS ids vtkIdType\n7\n"
      "TENSORS stress float\n1 0 0\n0 1 0\n0 0 1\n\nTENSORS6 strain float\n1 2 3 4 5 6\n"
      "POINT_DATA 8\nTEXTURE_COORDINATES place 2 float\n";
  for (int i = 0; i < 16; ++i) text += "0.5 ";
  text += "\nVECTORS u float\n";
  for (int i = 0; i < 24; ++i) text += "0 ";
  std::ofstream(folder_ / "arrays.vtk") << text << "\n";
  EXPECT_NEAR(fem::volume(fem::MeshFile::read(folder_ / "arrays.vtk").hexahedra("all")), 1.0, 1e-12);
}

TEST_F(Vtk, DamageIsNamed) {
  EXPECT_EQ(fault("boxes_ascii.vtu", "Name=\"pressure\"", "Name=\"other\""), "");
  EXPECT_THAT(fault("boxes_ascii.vtu", "<Cells>", "<Cells"), HasSubstr("changed.vtu:"));
  EXPECT_THAT(fault("boxes_ascii.vtu", "type=\"UnstructuredGrid\"", "type=\"PolyData\""),
              HasSubstr("holds \"PolyData\", expected an UnstructuredGrid"));
  EXPECT_THAT(fault("boxes_ascii.vtu", "LittleEndian", "BigEndian"), HasSubstr("is big endian"));
  EXPECT_THAT(fault("boxes_zlib.vtu", "vtkZLibDataCompressor", "vtkLZ4DataCompressor"),
              HasSubstr("only vtkZLibDataCompressor"));
  EXPECT_THAT(fault("boxes_ascii.vtu", "0 1 5 4 8", "0 1 5 4 99"), HasSubstr("cell 0: there is no point 99"));
  EXPECT_THAT(fault("boxes_ascii.vtu", "12 12 12 3", "12 12 42 3"),
              HasSubstr("cells of the type 42 of VTK are not known here"));
  EXPECT_THAT(fault("boxes_ascii.vtu", "12 12 12 3", "12 12 10 3"),
              HasSubstr("cell 2: has 8 points instead of 4"));
  EXPECT_THAT(fault("boxes_ascii.vtu", "0 0 1 2", "0 0 1"), HasSubstr("\"body\" has 3 values for 4 cells"));
  // What is packed may be of any length: nothing is unpacked beyond what the piece announces.
  EXPECT_THAT(fault("boxes_zlib.vtu", "NumberOfPoints=\"16\"", "NumberOfPoints=\"4\""),
              HasSubstr("an array unpacks to 384 bytes, but the points and cells that the piece announces "
                        "take at most 96"));
  EXPECT_THAT(fault("boxes_zlib.vtu", "NumberOfCells=\"4\"", "NumberOfCells=\"-4\""),
              HasSubstr("no number of points or cells"));
  EXPECT_THAT(fault("boxes_base64.vtu", "EAAAAAAA", "EAAAAAA"), HasSubstr("changed.vtu: error:"));
  EXPECT_THAT(fault("boxes_raw.vtu", "</AppendedData>", ""), ::testing::AnyOf("", HasSubstr("error")));
  std::string deep = "<VTKFile>";
  for (int k = 0; k < 100000; ++k) deep += "<a>";
  std::ofstream(folder_ / "deep.vtu") << deep;
  EXPECT_THROW(fem::MeshFile::read(folder_ / "deep.vtu"), InputError);
}

/// Every file of every encoding that ends early, or has a changed byte, is read or refused.
TEST_F(Vtk, DamagedFilesAreReadOrRefused) {
  for (const char* name :
       {"boxes_ascii.vtu", "boxes_base64.vtu", "boxes_raw.vtu", "boxes_raw_zlib.vtu", "boxes_51.vtk"}) {
    const std::string whole = text_of(name);
    for (std::size_t k = 0; k < whole.size(); k += 7) {
      for (const bool cut : {true, false}) {
        std::string text = cut ? whole.substr(0, k) : whole;
        if (!cut) text[k] = static_cast<char>(text[k] ^ (1 << (k % 8)));
        std::ofstream(folder_ / "damaged.vtu", std::ios::binary) << text;
        try {
          static_cast<void>(fem::MeshFile::read(folder_ / "damaged.vtu").hexahedra("body 0"));
        } catch (const InputError&) {
        }
      }
    }
  }
}

}  // namespace
}  // namespace whipple::fem_test
