// SPDX-License-Identifier: BSD-3-Clause
// STEP files as surfaces, triangulated by the program gmsh; one body from four kinds of sources.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <numbers>
#include <sstream>

#include "src/app/step_mesher.hpp"
#include "src/case/build/lattice.hpp"
#include "src/case/build/seeding.hpp"
#include "src/case/shapes/source_file.hpp"
#include "src/case/shapes/surface.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/solids/step.hpp"
#include "tests/folders.hpp"
#include "tests/unit/folder_test.hpp"

namespace whipple::app {
namespace step_test {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* name = "ball with hole.step";
constexpr double radius = 10.0, hole = 3.0;  // mm
/// That of a ball without what a cylinder through its centre takes: a ball of the height of the hole.
const double exact_volume = 4.0 / 3.0 * std::numbers::pi * std::pow(radius * radius - hole * hole, 1.5);

bool is_inside(const Vector3& x) {  // mm
  return x.norm() < radius && std::hypot(x[0], x[1]) > hole;
}

bool has_gmsh() {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (fs::exists(fs::path(folder) / "gmsh")) return true;
  }
  return false;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

class StepFiles : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    solids::set_step_mesher(triangulate_by_gmsh);
    text_ = read_text(fs::path(whipple::tests::source_folder()) / "tests/data/step" / name);
  }
  void TearDown() override {
    solids::set_step_mesher({});
    FolderTest::TearDown();
  }
  void write(const std::string& text, const std::string& file = name) const {
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
  cases::Surface read(double edge, double unit = std::numeric_limits<double>::infinity()) const {
    return {{.file = name, .unit = unit, .triangle_size = edge, .digest = {}}, folder_};
  }
  std::string refusal(double edge = 2e-3, double unit = std::numeric_limits<double>::infinity()) const {
    return message_of<InputError>([&] { read(edge, unit); });
  }
  cases::Case read_with(const std::string& shape, double cell) const {
    std::ofstream(folder_ / "case.toml") << fmt::format(
        "[domain]\nlower = [\"-12 mm\", \"-12 mm\", \"-12 mm\"]\nupper = [\"12 mm\", \"12 mm\", \"12 "
        "mm\"]\ncell_size = \"{} mm\"\n[time]\nend = \"1 us\"\n[[body]]\nname = \"b\"\nmaterial = "
        "\"copper\"\nshape = {}\n",
        cell, shape);
    return cases::read_case(folder_ / "case.toml", {});
  }

  std::string text_;
};

/// The file says millimetres, centimetres or inches.
TEST_F(StepFiles, KeepTheirUnit) {
  if (!has_gmsh()) GTEST_SKIP() << "gmsh is not installed (scripts/install_deps.sh --step)";
  const std::string millimetre = "( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) )";
  const std::string inch =
      "( CONVERSION_BASED_UNIT('INCH',#900) LENGTH_UNIT() NAMED_UNIT(#901) );\n#900 = "
      "LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#902);\n#901 = "
      "DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n#902 = " +
      millimetre;
  for (const auto& [unit, length] : {std::pair<std::string, double>{millimetre, 1e-3},
                                     {replaced(millimetre, ".MILLI.", ".CENTI."), 1e-2},
                                     {inch, 25.4e-3}}) {
    write(replaced(text_, millimetre, unit));
    const cases::Surface body = read(6.0 * length);
    EXPECT_NEAR(body.volume() / std::pow(length, 3), exact_volume, 0.01 * exact_volume) << unit;
    EXPECT_TRUE(body.audit().is_closed()) << unit;
    EXPECT_FALSE(body.contains(Vector3::Zero()));
    EXPECT_TRUE(body.contains(Vector3(5.0 * length, 0, 0)));
  }
}

TEST_F(StepFiles, RunsKeepTheTriangles) {
  if (!has_gmsh()) GTEST_SKIP() << "gmsh is not installed (scripts/install_deps.sh --step)";
  write(text_);
  const cases::Case setup = read_with(fmt::format("{{ surface = {{ file = \"{}\" }} }}", name), 4.0);
  const std::vector<std::string> account = setup.bodies[0].shape->account();
  EXPECT_THAT(account[2], HasSubstr("triangulated by gmsh, edges up to 4 mm")) << "those of the cells";
  const fs::path run = folder_ / "run";
  fs::create_directories(run);
  cases::keep_sources(*setup.bodies[0].shape, run);
  std::ofstream(run / "run.toml") << to_toml(setup, {"copper"});
  fs::remove(folder_ / name);
  solids::set_step_mesher([](const fs::path&, double, const fs::path&) { FAIL() << "triangulated again"; });
  const cases::Case again = cases::read_case(run / "run.toml", {});
  EXPECT_EQ(cases::seed(again).particles.mass, cases::seed(setup).particles.mass);
  EXPECT_EQ(cases::read_written_case(run / "run.toml").bodies[0].shape->volume(),
            setup.bodies[0].shape->volume());
  fs::path stl;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(run)) {
    if (entry.path().extension() == ".stl") stl = entry.path();
  }
  ASSERT_FALSE(stl.empty());
  std::ofstream(stl, std::ios::app) << "solid more\nendsolid more\n";
  EXPECT_THAT(message_of<InputError>([&] { cases::read_case(run / "run.toml", {}); }),
              HasSubstr("the file has changed: its digest is not that of its name"));
}

TEST_F(StepFiles, AreRefusedWithOneMessage) {
  write(replaced(text_, "LENGTH_UNIT", "ANGLE_UNIT"));
  EXPECT_THAT(refusal(), HasSubstr("a STEP file without a unit of length"));
  write(text_);
  EXPECT_THAT(refusal(2e-3, 1e-3), HasSubstr("a STEP file states its unit of length: leave 'unit' out"));
  EXPECT_THAT(refusal(std::numeric_limits<double>::infinity()), HasSubstr("'triangle_size' is missing"));
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  const std::string message = refusal();
  setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(message, testing::AllOf(
                           HasSubstr("ball with hole.step: a STEP file is triangulated by the program gmsh"),
                           HasSubstr("scripts/install_deps.sh --step")));
  solids::set_step_mesher({});
  EXPECT_THAT(refusal(), HasSubstr("a STEP file, which this program does not triangulate: save it as STL"));
  write("solid s\nfacet normal 0 0 0\nendsolid s\n");
  EXPECT_THAT(refusal(), HasSubstr("'unit' is missing: the file does not state its unit of length"));
  EXPECT_THAT(refusal(2e-3, 1e-3), HasSubstr("'triangle_size' belongs to STEP files"));
}

TEST_F(StepFiles, DamagedOnesAreRefused) {
  if (!has_gmsh()) GTEST_SKIP() << "gmsh is not installed (scripts/install_deps.sh --step)";
  write(text_.substr(0, text_.size() / 2) +
        "#129 = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) );\n");
  EXPECT_THAT(refusal(), HasSubstr("gmsh does not triangulate it"));
}

/// The ball with its hole as a surface of revolution in binary STL, coordinates in mm.
std::string stl_of_ball(int rows) {
  const int columns = 4 * rows;
  const double top = std::sqrt(radius * radius - hole * hole), first = std::atan2(hole, top);
  std::vector<Vector3> profile;  // radius, 0, z; closed
  for (int i = 0; i <= rows; ++i) {
    const double polar = first + (std::numbers::pi - 2.0 * first) * i / rows;
    profile.emplace_back(radius * std::sin(polar), 0.0, radius * std::cos(polar));
  }
  for (int i = 1; i < rows; ++i) profile.emplace_back(hole, 0.0, -top + 2.0 * top * i / rows);
  std::string records;
  std::uint32_t count = 0;
  const auto add = [&](const auto& value) {
    records.append(reinterpret_cast<const char*>(&value), sizeof value);  // NOLINT
  };
  const auto corner = [&](std::size_t i, int j) {
    const Vector3& at = profile[i % profile.size()];
    const double turn = 2.0 * std::numbers::pi * (j % columns) / columns;
    for (const double x : {at[0] * std::cos(turn), at[0] * std::sin(turn), at[2]}) add(static_cast<float>(x));
  };
  for (std::size_t i = 0; i < profile.size(); ++i) {
    for (int j = 0; j < columns; ++j) {
      records += std::string(12, '\0');
      corner(i, j), corner(i + 1, j), corner(i + 1, j + 1);
      records += std::string(2 + 12, '\0');
      corner(i, j), corner(i + 1, j + 1), corner(i, j + 1);
      records += std::string(2, '\0');
      count += 2;
    }
  }
  std::string head(80, ' ');
  head.append(reinterpret_cast<const char*>(&count), sizeof count);  // NOLINT
  return head + records;
}

std::string image_of_ball(double voxel) {  // mm
  const int n = 2 * static_cast<int>(std::ceil(radius / voxel + 1.0));
  const double start = -0.5 * (n - 1) * voxel;
  std::string bytes = fmt::format(
      "NRRD0004\ntype: uchar\ndimension: 3\nsizes: {0} {0} {0}\nencoding: raw\nspace origin: ({1},{1},{1})\n"
      "space directions: ({2},0,0) (0,{2},0) (0,0,{2})\n\n",
      n, start, voxel);
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        bytes += is_inside(Vector3(start + i * voxel, start + j * voxel, start + k * voxel)) ? '\1' : '\0';
      }
    }
  }
  return bytes;
}

/// Volume of the particles, and sites of the lattice that are filled but outside of the exact body, or inside and
/// empty.
TEST_F(StepFiles, OneBodyFromFourSources) {
  if (!has_gmsh()) GTEST_SKIP() << "gmsh is not installed (scripts/install_deps.sh --step)";
  write(text_);
  write(stl_of_ball(24), "ball.stl");
  write(image_of_ball(0.25), "ball.nrrd");
  const std::vector<std::pair<std::string, std::string>> sources = {
      {"shapes",
       "{ difference = { from = { sphere = { center = [\"0 mm\", \"0 mm\", \"0 mm\"], radius = \"10 mm\" } "
       "}, "
       "minus = [{ cylinder = { center = [\"0 mm\", \"0 mm\", \"0 mm\"], axis = \"z\", radius = \"3 mm\", "
       "height "
       "= \"30 mm\" } }] } }"},
      {"STL, 1.3 mm", "{ surface = { file = \"ball.stl\", unit = \"1 mm\" } }"},
      {"STEP, a cell", fmt::format("{{ surface = {{ file = \"{}\" }} }}", name)},
      {"image, 0.25 mm",
       "{ image = { file = \"ball.nrrd\", unit = \"1 mm\", values = [1], smooth = true } }"}};
  for (const auto& [source, shape] : sources) {
    for (const double cell : {6.0, 3.0, 1.5}) {
      const cases::Case setup = read_with(shape, cell);
      const cases::Body& body = setup.bodies[0];
      const Particles p = cases::seed(setup).particles;
      double volume = 0.0;
      for (const double v : p.volume) volume += 1e9 * v;
      const double error = volume / exact_volume - 1.0;
      const double spacing = 0.5 * cell;
      int wrong = 0, filled = 0;
      const int n = static_cast<int>(std::ceil(2.0 * radius / spacing)) + 2;
      double farthest = 0.0;
      for (int i = 0; i < n * n * n; ++i) {
        const int row = i / n % n, layer = i / (n * n);
        const Vector3 x = spacing * (Vector3(i % n, row, layer) + Vector3(0.31, 0.17, 0.43) +
                                     Vector3::Constant(0.5 * (1 - n)));
        const bool inside = body.shape->contains(1e-3 * x);
        filled += is_inside(x) ? 1 : 0;
        if (inside == is_inside(x)) continue;
        ++wrong;
        farthest = std::max(farthest,
                            std::min(std::abs(x.norm() - radius), std::abs(std::hypot(x[0], x[1]) - hole)));
      }
      fmt::print(
          "{:<15} cells of {} mm: {} particles, volume {:+.3f} % (shape {:+.3f} %), {} of {} sites wrong, by "
          "up to {:.3f} "
          "cells\n",
          source, cell, p.size(), 1e2 * error, 1e2 * (1e9 * body.shape->volume() / exact_volume - 1.0), wrong,
          filled, farthest / cell);
      EXPECT_LT(farthest, 0.1 * cell) << source;
      // The triangles, or voxels, do not follow the cells (but of STEP); how particles sample the surface does.
      const double of_shape = 1e9 * body.shape->volume() / exact_volume - 1.0;
      EXPECT_LT(std::abs(of_shape), 0.005) << source;
      EXPECT_LT(std::abs(error - of_shape), 0.0035 * cell) << source;
    }
  }
}

}  // namespace step_test
}  // namespace whipple::app
