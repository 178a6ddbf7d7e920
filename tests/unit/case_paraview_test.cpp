// SPDX-License-Identifier: BSD-3-Clause
// Bodies of particles from files that ParaView wrote (tests/data/points/write.py), in every mode of its writer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "src/case/shapes/points.hpp"
#include "src/core/base/error.hpp"
#include "tests/folders.hpp"

namespace whipple::cases {
namespace {

using testing::HasSubstr;

constexpr double density = 8000.0;  // kg/m^3

std::unique_ptr<Shape> points_of_file(const std::string& name) {
  PointsKeys keys;
  keys.file = name + ".vtu";
  keys.unit = 1e-3;
  keys.mass_unit = 1e-6;
  return Points(keys, std::filesystem::path(whipple::tests::source_folder()) / "tests/data/points")
      .settled({.density = density});
}

TEST(PointsOfParaView, AreTheSameInEveryMode) {
  for (const char* name :
       {"ascii", "binary", "binary_zlib", "appended", "appended_raw", "appended_zlib", "appended_raw_zlib"}) {
    SCOPED_TRACE(name);
    const auto shape = points_of_file(name);
    const auto particles = shape->particles();
    ASSERT_EQ(particles.size(), 27U);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const auto place = [](std::size_t index) { return 0.5e-3 * static_cast<double>(index % 3); };
      EXPECT_LT((particles[i].position - Vector3(place(i), place(i / 3), place(i / 9))).norm(), 1e-15);
      const double mass = 1e-6 * (1.0 + 0.001 * static_cast<double>(i));
      EXPECT_NEAR(density * std::pow(particles[i].edge, 3), mass, 1e-12 * mass);
    }
  }
}

TEST(PointsOfParaView, PackedOtherwiseAreRefusedByName) {
  for (const auto& [name, packer] : {std::pair("appended_lz4", "vtkLZ4DataCompressor"),
                                     std::pair("appended_lzma", "vtkLZMADataCompressor")}) {
    try {
      static_cast<void>(points_of_file(name));
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(packer));
      EXPECT_THAT(error.what(), HasSubstr("vtkZLibDataCompressor"));
    }
  }
}

}  // namespace
}  // namespace whipple::cases
