// SPDX-License-Identifier: BSD-3-Clause
#include "src/solids/surface_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "src/core/base/error.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/text.hpp"
#include "src/solids/bytes.hpp"
#include "src/solids/fields.hpp"

namespace whipple::solids {
namespace {

constexpr std::size_t stl_header = 84, stl_record = 50;

/// Reads 50 bytes for each triangle: the normal, which is not used, three corners of three floats, and two bytes.
std::vector<Triangle> read_binary_stl(std::string_view bytes, const std::string& file) {
  std::vector<Triangle> triangles((bytes.size() - stl_header) / stl_record);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < 9; ++i) {
      const auto value = number_at<float>(bytes, stl_header + t * stl_record + 12 + 4 * i);
      if (!std::isfinite(value)) {
        throw InputError(fmt::format("{}: triangle {} has a coordinate that is not finite", file, t + 1));
      }
      triangles[t][i / 3][static_cast<Eigen::Index>(i % 3)] = value;
    }
  }
  return triangles;
}

std::vector<Triangle> read_text_stl(std::string_view text, const std::string& file) {
  std::vector<Triangle> triangles;
  Fields fields(text, file);
  Triangle triangle;
  std::size_t corners = 0;
  bool is_ended = false;
  while (fields.next_line()) {
    const std::string key = lower_case(fields.word());
    if (key == "vertex") {
      if (corners == 3) fields.fail("a facet of more than three corners");
      for (Eigen::Index i = 0; i < 3; ++i) triangle[corners][i] = fields.number<double>();
      ++corners;
    } else if (key == "endloop") {
      if (corners != 3) fields.fail(fmt::format("a facet of {} corners, expected three", corners));
      triangles.push_back(triangle);
      corners = 0;
    } else if (key == "endsolid") {
      is_ended = true;
    } else if (key == "solid") {
      is_ended = false;
    } else if (!key.empty() && key != "facet" && key != "outer" && key != "endfacet") {
      fields.fail(fmt::format("\"{}\" is no word of an STL file", shown(key)));
    }
  }
  if (corners != 0 || !is_ended) fields.fail("the file ends before \"endsolid\"");
  return triangles;
}

std::vector<Triangle> read_obj(std::string_view text, const std::string& file) {
  std::vector<Triangle> triangles;
  std::vector<Vector3> corners;
  std::vector<std::size_t> face;
  Fields fields(text, file);
  while (fields.next_line()) {
    const std::string_view key = fields.word();
    if (key == "v") {
      Vector3& x = corners.emplace_back();
      for (Eigen::Index i = 0; i < 3; ++i) x[i] = fields.number<double>();
    } else if (key == "f") {
      face.clear();
      for (std::string_view word = fields.word(); !word.empty(); word = fields.word()) {
        const auto number = Fields::parsed<std::int64_t>(word.substr(0, word.find('/')));
        const auto count = static_cast<std::int64_t>(corners.size());
        if (!number || *number == 0 || *number > count || *number < -count) {
          fields.fail(fmt::format("a face with corner \"{}\"; there are {} before it", shown(word), count));
        }
        face.push_back(static_cast<std::size_t>(*number > 0 ? *number - 1 : count + *number));
      }
      if (face.size() < 3) fields.fail("a face of fewer than three corners");
      for (std::size_t i = 2; i < face.size(); ++i) {
        triangles.push_back({corners[face[0]], corners[face[i - 1]], corners[face[i]]});
      }
    }
  }
  return triangles;
}

bool is_obj(std::string_view text) {
  Fields fields(text, "");
  while (fields.next_line()) {
    const std::string_view key = fields.word();
    if (key == "v") return true;
    constexpr std::array<std::string_view, 8> before = {"mtllib", "usemtl", "o", "g", "s", "vn", "vt", "vp"};
    if (!key.empty() && !key.starts_with('#') && std::ranges::find(before, key) == before.end()) return false;
  }
  return false;
}

std::vector<Triangle> read_any(std::string_view bytes, const std::string& file) {
  if (bytes.empty()) throw InputError(fmt::format("{}: the file is empty", file));
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);  // mark of UTF-8
  if (bytes.starts_with("ply")) return read_ply(bytes, file);
  // Many binary STL files begin with "solid" as well: their size decides.
  const std::size_t announced =
      bytes.size() < stl_header ? 0
                                : stl_header + stl_record * std::size_t{number_at<std::uint32_t>(bytes, 80)};
  if (bytes.size() == announced) return read_binary_stl(bytes, file);
  const std::string head = lower_case(bytes.substr(0, 2000));
  if (head.starts_with("solid") && head.find("facet") != std::string::npos) {
    return read_text_stl(bytes, file);
  }
  if (is_obj(bytes)) return read_obj(bytes, file);
  if (head.find('\0') == std::string::npos) {
    throw InputError(fmt::format("{}: a text, but neither STL, OBJ nor PLY", file));
  }
  throw InputError(
      fmt::format("{}: neither STL, OBJ nor PLY; a binary STL file would have {} bytes by its number of "
                  "triangles, this one "
                  "has {}",
                  file, announced, bytes.size()));
}

}  // namespace

std::vector<Triangle> read_surface(const std::filesystem::path& path, double unit) {
  const std::string bytes = read_text(path);
  std::vector<Triangle> triangles = read_any(bytes, utf8(path.string()));
  for (Triangle& triangle : triangles) {
    for (Vector3& x : triangle) x *= unit;
  }
  return triangles;
}

}  // namespace whipple::solids
