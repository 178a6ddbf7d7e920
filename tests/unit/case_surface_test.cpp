// SPDX-License-Identifier: BSD-3-Clause
// Bodies enclosed by surfaces of triangles: one body from four formats, damaged surfaces, and what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>
#include <fstream>
#include <numbers>

#include "src/case/shapes/source_file.hpp"
#include "src/case/shapes/surface.hpp"
#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/random_bits.hpp"
#include "tests/unit/case_support.hpp"
#include "tests/unit/folder_test.hpp"
#include "tests/unit/shape_support.hpp"

namespace whipple::cases {
namespace surface_test {

using solids::Triangle;

/// A sphere about the origin as a grid of longitudes and latitudes.
std::vector<Triangle> ball(double radius, int rows) {
  const int columns = 2 * rows;
  const auto at = [&](int i, int j) {
    const double polar = std::numbers::pi * i / rows, around = std::numbers::pi * (j % columns) / rows;
    if (i == 0 || i == rows) return Vector3(0, 0, i == 0 ? radius : -radius);
    return Vector3(radius * std::sin(polar) * std::cos(around), radius * std::sin(polar) * std::sin(around),
                   radius * std::cos(polar));
  };
  std::vector<Triangle> triangles;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      if (i < rows - 1) triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      if (i > 0) triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return triangles;
}

/// A box from the origin.
std::vector<Triangle> block(const Vector3& edges) {
  std::vector<Triangle> triangles;
  for (int a = 0; a < 3; ++a) {
    for (const bool upper : {false, true}) {
      const auto at = [&](double u, double v) {
        Vector3 x = Vector3::Zero();
        x[a] = upper ? 1.0 : 0.0;
        x[(a + 1) % 3] = upper ? u : v;
        x[(a + 2) % 3] = upper ? v : u;
        return Vector3(x.cwiseProduct(edges));
      };
      triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
      triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
    }
  }
  return triangles;
}

template <class Number>
void append(std::string& bytes, Number value, bool swapped = false) {
  std::string raw(sizeof value, '\0');
  std::memcpy(raw.data(), &value, sizeof value);
  if (swapped) std::reverse(raw.begin(), raw.end());
  bytes += raw;
}

std::string binary_stl(const std::vector<Triangle>& triangles) {
  std::string bytes = "solid as many binary files begin";
  bytes.resize(80, ' ');
  append(bytes, static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& t : triangles) {
    bytes += std::string(12, '\0');
    for (const Vector3& x : t) {
      for (int a = 0; a < 3; ++a) append(bytes, static_cast<float>(x[a]));
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

std::string text_stl(const std::vector<Triangle>& triangles) {
  std::string text = "solid part\n";
  for (const Triangle& t : triangles) {
    text += "facet normal 0 0 0\n outer loop\n";
    for (const Vector3& x : t) text += fmt::format("  vertex {:.9e} {:.9e} {:.9e}\r\n", x[0], x[1], x[2]);
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid part\n";
}

std::string obj(const std::vector<Triangle>& triangles) {
  std::string text = "# made for a test\nmtllib none.mtl\no part\n";
  for (const Triangle& t : triangles) {
    for (const Vector3& x : t) text += fmt::format("v {:.9g} {:.9g} {:.9g}\n", x[0], x[1], x[2]);
    text += "vn 0 0 1\nf -3/1/1 -2//1 -1\n";
  }
  return text;
}

enum class Order : std::uint8_t { text, little, big };

std::string ply(const std::vector<Triangle>& triangles, Order order) {
  const char* const format = order == Order::text     ? "ascii"
                             : order == Order::little ? "binary_little_endian"
                                                      : "binary_big_endian";
  std::string bytes = fmt::format(
      "ply\nformat {} 1.0\ncomment for a test\nelement vertex {}\nproperty float x\nproperty float "
      "y\nproperty float "
      "z\nproperty uchar red\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      format, 3 * triangles.size(), triangles.size());
  const bool swapped = order == Order::big;
  for (const Triangle& t : triangles) {
    for (const Vector3& x : t) {
      for (int a = 0; a < 3; ++a) {
        order == Order::text ? bytes += fmt::format("{:.9g} ", x[a])
                             : (append(bytes, static_cast<float>(x[a]), swapped), bytes);
      }
      order == Order::text ? bytes += "255\n" : bytes += '\xff';
    }
  }
  for (int i = 0; i < static_cast<int>(3 * triangles.size()); i += 3) {
    if (order == Order::text) {
      bytes += fmt::format("3 {} {} {}\n", i, i + 1, i + 2);
      continue;
    }
    bytes += '\3';
    for (int k = i; k < i + 3; ++k) append(bytes, k, swapped);
  }
  return bytes;
}

class Surfaces : public FolderTest {
 protected:
  std::filesystem::path write(const std::string& bytes, const char* name = "part.stl") const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  std::unique_ptr<Surface> read(const std::string& bytes, double unit = 1e-3) const {
    write(bytes);
    return std::make_unique<Surface>(SurfaceKeys{.file = "part.stl", .unit = unit, .digest = {}}, folder_);
  }
  std::string refusal(const std::string& bytes) const {
    return message_of<InputError>([&] { read(bytes); });
  }
};

TEST_F(Surfaces, OneBodyFromEveryFormat) {
  const std::vector<Triangle> triangles = ball(5.0, 24);
  const auto first = read(binary_stl(triangles));
  EXPECT_TRUE(first->audit().is_closed());
  EXPECT_NEAR(first->volume(), 4.0 / 3.0 * std::numbers::pi * 1.25e-7, 0.02 * 5.2e-7);
  EXPECT_NEAR(first->smallest_extent(Vector3::UnitX()), 1e-2, 2e-4);
  for (const std::string& bytes : {text_stl(triangles), obj(triangles), ply(triangles, Order::text),
                                   ply(triangles, Order::little), ply(triangles, Order::big)}) {
    const auto other = read(bytes);
    EXPECT_EQ(other->audit().triangles, triangles.size());
    EXPECT_NEAR(other->volume(), first->volume(), 1e-6 * first->volume());
    for (std::uint64_t i = 0; i < 2000; ++i) {
      const Vector3 x = 6e-3 * Vector3(2 * uniform(1, 3 * i) - 1, 2 * uniform(1, 3 * i + 1) - 1,
                                       2 * uniform(1, 3 * i + 2) - 1);
      if (std::abs(x.norm() - 5e-3) < 1e-6) continue;
      ASSERT_EQ(first->contains(x), other->contains(x));
    }
  }
}

TEST_F(Surfaces, UnitsScaleTheBody) {
  const auto inches = read(text_stl(block({1, 2, 3})), 0.0254);
  EXPECT_NEAR(inches->volume(), 6.0 * std::pow(0.0254, 3), 1e-12);
  EXPECT_NEAR(inches->smallest_extent(Vector3::UnitX()), 0.0254, 2e-4);
}

/// Wrong points of damaged spheres lie within a cell of the surface, and the error of the volume falls with the cell.
TEST_F(Surfaces, MissingTrianglesDoNotMatter) {
  double former = 1.0;
  for (const int rows : {20, 40, 80}) {  // the cell is as large as a triangle
    const double cell = std::numbers::pi / rows;
    std::vector<Triangle> damaged;
    std::uint64_t number = 0;
    for (Triangle t : ball(1.0, rows)) {
      const double missing = uniform(7, ++number), turned = uniform(8, number), twice = uniform(9, number);
      if (missing < 0.15) continue;
      if (turned < 0.01) std::swap(t[1], t[2]);
      damaged.push_back(t);
      if (twice < 0.01) damaged.push_back(t);
    }
    const auto body = read(binary_stl(damaged), 1.0);
    EXPECT_GT(body->audit().open_edges, 0U);
    EXPECT_GT(body->audit().flipped, 0U);
    EXPECT_GT(body->audit().repeated, 0U);
    long asked = 0, wrong = 0, inside = 0, right = 0;
    for (double x = -1.1 + 0.25 * cell; x < 1.1; x += 0.5 * cell) {
      for (double y = -1.1 + 0.25 * cell; y < 1.1; y += 0.5 * cell) {
        for (double z = -1.1 + 0.25 * cell; z < 1.1; z += 0.5 * cell) {
          const Vector3 p(x, y, z);
          const bool is_inside = body->contains(p), is_in_ball = p.norm() < 1.0;
          ++asked;
          inside += is_inside ? 1 : 0;
          right += is_in_ball ? 1 : 0;
          if (is_inside == is_in_ball) continue;
          ++wrong;
          EXPECT_LT(std::abs(p.norm() - 1.0), cell) << rows;
        }
      }
    }
    const double error = std::abs(static_cast<double>(inside - right)) / static_cast<double>(right);
    RecordProperty(fmt::format("volume_error_{}", rows), fmt::format("{:.2e}", error));
    std::printf("rows %d: %zu triangles, wrong %.3f %%, error of the volume %.4f\n", rows, damaged.size(),
                100.0 * static_cast<double>(wrong) / static_cast<double>(asked), error);
    EXPECT_LT(error, former);
    EXPECT_LT(error, 0.5 * cell);
    former = error;
  }
}

TEST_F(Surfaces, TurnedAndDoubledSurfacesAreBodies) {
  std::vector<Triangle> turned = block({10, 10, 10});
  for (Triangle& t : turned) std::swap(t[1], t[2]);
  const auto body = read(binary_stl(turned));
  EXPECT_NEAR(body->volume(), 1e-6, 1e-12);
  EXPECT_TRUE(body->contains({5e-3, 5e-3, 5e-3}));
  EXPECT_FALSE(body->contains({5e-3, 5e-3, 11e-3}));

  std::vector<Triangle> doubled = turned;
  for (const Triangle& t : block({10, 10, 10})) doubled.push_back(t);
  const auto other = read(binary_stl(doubled));
  EXPECT_EQ(other->audit().repeated, 12U);  // a closed shell in both senses stays
  EXPECT_EQ(other->audit().cancelled, 0U);
  EXPECT_TRUE(other->audit().is_closed());
  EXPECT_NEAR(other->volume(), 1e-6, 1e-12);

  std::vector<Triangle> one_turned = block({10, 10, 10});
  std::swap(one_turned[3][1], one_turned[3][2]);
  EXPECT_EQ(read(binary_stl(one_turned))->audit().flipped, 1U);
}

/// Says whether a line of the account holds a piece.
bool says(const Surface& body, const std::string& piece) {
  return std::ranges::any_of(body.account(),
                             [&](const std::string& line) { return line.find(piece) != std::string::npos; });
}

void turn(std::vector<Triangle>& triangles) {
  for (Triangle& t : triangles) std::swap(t[1], t[2]);
}

void add(std::vector<Triangle>& to, const std::vector<Triangle>& part, const Vector3& shift) {
  for (const Triangle& t : part) to.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
}

/// Faces that two plates share cancel, whichever plate comes first; membranes within a body as well.
TEST_F(Surfaces, PlatesInContactAreOneBody) {
  const std::vector<Triangle> plate = block({10, 10, 4});
  for (const std::array<double, 3>& order : {std::array{0.0, 4.0, 8.0}, std::array{0.0, 8.0, 4.0}}) {
    std::vector<Triangle> laminate;
    for (const double z : order) add(laminate, plate, Vector3(0, 0, z));
    const auto body = read(binary_stl(laminate));
    EXPECT_EQ(body->audit().cancelled, 4U);
    EXPECT_EQ(body->audit().repeated, 0U);
    EXPECT_NEAR(body->volume(), 1.2e-6, 1e-13);
    for (const double z : {1.0, 3.99, 4.01, 7.99, 8.01, 11.0}) {
      EXPECT_TRUE(body->contains({5e-3, 4e-3, 1e-3 * z})) << z;
    }
    EXPECT_TRUE(says(*body, "4 faces within the solid"));
  }
  std::vector<Triangle> cube = block({16, 16, 16});
  for (const double z : {4.0, 8.0, 12.0}) {
    const Triangle membrane = {Vector3(0, 0, z), Vector3(16, 0, z), Vector3(16, 16, z)};
    cube.push_back(membrane);
    cube.push_back({membrane[0], membrane[2], membrane[1]});
  }
  const auto body = read(binary_stl(cube));
  EXPECT_EQ(body->audit().cancelled, 3U);
  EXPECT_NEAR(body->volume(), 4.096e-6, 1e-12);
}

/// The volume of a closed surface is not left to points, of which thin walls and small parts hold few.
TEST_F(Surfaces, ThinAndScatteredBodiesHaveTheirVolume) {
  const double ball_volume = read(binary_stl(ball(1.0, 40)))->volume();
  std::vector<Triangle> shell = ball(10.0, 40), inner = ball(9.9, 40);
  turn(inner);
  add(shell, inner, Vector3::Zero());
  const double thin = ball_volume * (1000.0 - std::pow(9.9, 3));
  EXPECT_NEAR(read(binary_stl(shell))->volume(), thin, 1e-4 * thin);

  std::vector<Triangle> two = ball(0.5, 40);
  add(two, ball(0.5, 40), Vector3(200, 190, 180));
  const auto scattered = read(binary_stl(two));
  EXPECT_NEAR(scattered->volume(), 0.25 * ball_volume, 1e-4 * ball_volume);
  EXPECT_TRUE(says(*scattered, "by the divergence theorem"));
}

TEST_F(Surfaces, PartsCountByTheWindingNumberOnTheirSides) {
  // A ball within a ball, with its sense, is no cavity.
  std::vector<Triangle> twice = ball(10.0, 40);
  add(twice, ball(8.0, 40), Vector3::Zero());
  const auto solid = read(binary_stl(twice));
  EXPECT_NEAR(solid->volume(), read(binary_stl(ball(10.0, 40)))->volume(), 1e-12);
  EXPECT_TRUE(says(*solid, "1 of 2 closed parts enclosed twice"));
  // Two cubes that share an edge, one of them turned: both are bodies.
  std::vector<Triangle> cubes = block({5, 5, 5}), other = block({5, 5, 5});
  turn(other);
  add(cubes, other, Vector3(-5, -5, 0));
  const auto both = read(binary_stl(cubes));
  EXPECT_EQ(both->audit().crowded_edges, 1U);
  EXPECT_NEAR(both->volume(), 2.5e-7, 1e-13);
  EXPECT_TRUE(says(*both, "1 of 2 closed parts turned inside out"));
  // Parts that cross are counted: an eighth of each cube is there twice.
  std::vector<Triangle> crossing = block({10, 10, 10});
  add(crossing, block({10, 10, 10}), Vector3(5, 5, 5));
  const auto counted = read(binary_stl(crossing));
  EXPECT_NEAR(counted->volume(), 1.875e-6, 0.002e-6);
  EXPECT_TRUE(says(*counted, "closed parts cross"));
}

TEST_F(Surfaces, ExtentsOfScaledBodiesAreScaled) {
  write(binary_stl(block({10, 10, 10})));
  const std::string file = (folder_ / "part.stl").string();
  const auto shape =
      shape_test::shape_of("{ scaled = { factors = [0.1, 2.0, 1.0], shape = { surface = { file = \"" + file +
                           "\", unit = 1e-3 } } } }");
  EXPECT_NEAR(shape->smallest_extent(Vector3::UnitX()), 1e-3, 2e-5);
}

TEST_F(Surfaces, WritingsOfOtherProgramsAreRead) {
  const std::vector<Triangle> cube = block({10, 10, 10});
  std::string text = text_stl(cube), upper = text;
  for (char& c : upper) c = c >= 'a' && c <= 'z' && c != 'e' ? static_cast<char>(c - 'a' + 'A') : c;
  for (const std::string& bytes : {upper, "\xEF\xBB\xBF" + text, "usemtl steel\n" + obj(cube),
                                   replaced(ply(cube, Order::text), "end_header\n", "end_header\n \n")}) {
    EXPECT_NEAR(read(bytes)->volume(), 1e-6, 1e-12);
  }
  std::vector<Triangle> second;
  add(second, cube, Vector3(20, 0, 0));
  EXPECT_NEAR(read(text + text_stl(second))->volume(), 2e-6, 1e-12);
  EXPECT_NE(refusal(text + text.substr(0, text.size() - 14)).find("before \"endsolid\""), std::string::npos);
  EXPECT_NE(refusal("solid x\n facet\n outer loop\n vertex 0 0 \x1b[31m" + std::string(200, 'y') + "\n")
                .find("instead of \"\\x1B[31m" + std::string(35, 'y') + "...\""),
            std::string::npos);
}

TEST_F(Surfaces, FilesAreNamedByTheirDigest) {
  write(binary_stl(block({1, 1, 1})));
  EXPECT_NE(message_of<InputError>([&] {
              Surface({.file = "part.stl", .unit = 1.0, .digest = "../../etc"}, folder_);
            }).find("'digest' has 64 digits"),
            std::string::npos);
  std::filesystem::create_symlink("loop.stl", folder_ / "loop.stl");
  EXPECT_NE(message_of<InputError>([&] {
              Surface({.file = "loop.stl", .unit = 1.0, .digest = {}}, folder_);
            }).find("loop.stl: "),
            std::string::npos);
}

TEST_F(Surfaces, HollowBodiesHaveCavitiesAndWallsAThickness) {
  std::vector<Triangle> hollow = ball(10.0, 40);
  for (Triangle t : ball(8.0, 40)) {
    std::swap(t[1], t[2]);
    hollow.push_back(t);
  }
  const auto shell = read(binary_stl(hollow));
  EXPECT_FALSE(shell->contains({7.9e-3, 0, 0}));
  EXPECT_TRUE(shell->contains({9e-3, 0, 0}));
  EXPECT_FALSE(shell->contains({10.1e-3, 0, 0}));
  EXPECT_NEAR(shell->volume(), 4.0 / 3.0 * std::numbers::pi * (1e-6 - 0.512e-6), 0.02 * 2.04e-6);
  EXPECT_NEAR(shell->smallest_extent(Vector3::UnitX()), 2e-3, 0.1e-3);
}

TEST_F(Surfaces, WhatIsNoSurfaceIsRefused) {
  const std::string whole = binary_stl(block({1, 1, 1}));
  EXPECT_NE(refusal("").find("part.stl: the file is empty"), std::string::npos);
  EXPECT_NE(refusal(whole.substr(0, whole.size() - 7)).find("would have 684 bytes"), std::string::npos);
  EXPECT_NE(refusal(binary_stl({})).find("holds no triangle"), std::string::npos);
  EXPECT_NE(refusal("solid x\n facet\n outer loop\n vertex 0 0 nan\n").find("part.stl:4: expected a number"),
            std::string::npos);
  EXPECT_NE(refusal("solid x\n facet\n outer loop\n vertex 0 0 0\n endloop\n").find("of 1 corners"),
            std::string::npos);
  EXPECT_NE(refusal("v 0 0 0\nv 1 0 0\nf 1 2 3\n").find("part.stl:3: a face with corner \"3\""),
            std::string::npos);
  EXPECT_NE(refusal("ply\nformat ascii 1.0\nelement vertex 99999999999\n").find("in a file of"),
            std::string::npos);
  EXPECT_NE(refusal("ply\nformat binary_middle_endian 1.0\n").find("known: ascii"), std::string::npos);
  EXPECT_NE(refusal("lattice of nothing\n").find("a text, but neither STL, OBJ nor PLY"), std::string::npos);
  const std::vector<Triangle> flat(2, Triangle{Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0)});
  EXPECT_NE(refusal(binary_stl(flat)).find("bound no solid"), std::string::npos);
  EXPECT_NE(message_of<InputError>([&] {
              Surface({.file = "absent.stl", .unit = 1.0, .digest = {}}, folder_);
            }).find("absent.stl: no such file"),
            std::string::npos);
}

TEST_F(Surfaces, RunsKeepTheirFiles) {
  const auto body = read(binary_stl(block({10, 10, 10})));
  keep_sources(*body, folder_ / "run");
  const std::string written = body->toml();
  EXPECT_NE(written.find(body->source()->digest), std::string::npos);
  // The file is changed: the copy beside the written case is taken.
  write(binary_stl(block({20, 10, 10})));
  const SurfaceKeys keys{
      .file = (folder_ / "part.stl").string(), .unit = 1e-3, .digest = body->source()->digest};
  const Surface again(keys, folder_ / "run");
  EXPECT_NEAR(again.volume(), 1e-6, 1e-12);
  EXPECT_EQ(again.toml(), written);  // as a restart demands
  EXPECT_NE(message_of<InputError>([&] { Surface(keys, folder_); }).find("the file has changed"),
            std::string::npos);
}

TEST_F(Surfaces, AWrongUnitIsAskedFor) {
  write(binary_stl(block({5, 5, 5})));
  const std::string text =
      domain + replaced(sphere, R"(sphere = { center = ["0 mm", "0 mm", "-4 mm"], radius = "3 mm" })",
                        "surface = { file = \"" + (folder_ / "part.stl").string() + "\", unit = \"1 mm\" }");
  EXPECT_EQ(error_of(text), "");
  expect_error(replaced(text, "unit = \"1 mm\"", "unit = \"1 inch\""),
               {"\"sphere\" reaches", "outside of the domain", "is 'unit' of its file right?"});
}

TEST_F(Surfaces, TheUnitIsDemanded) {
  write(binary_stl(block({1, 1, 1})));
  const std::string file = "file = \"" + (folder_ / "part.stl").string() + "\"";
  shape_test::expect_refused("{ surface = { " + file + " } }", "unit");
  const auto shape = shape_test::shape_of("{ surface = { " + file + ", unit = 1e-3 } }");
  EXPECT_EQ(shape_test::shape_of(shape->toml())->toml(), shape->toml());
}

}  // namespace surface_test
}  // namespace whipple::cases
