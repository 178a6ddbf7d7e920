// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/shapes/surface.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "src/case/shapes/combination.hpp"
#include "src/case/shapes/primitive.hpp"
#include "src/case/shapes/source_file.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/hash.hpp"
#include "src/core/base/text.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/solids/inside.hpp"
#include "src/solids/step.hpp"
#include "src/solids/surface_file.hpp"

namespace whipple::cases {

ParameterTable<SurfaceKeys> SurfaceKeys::parameters() {
  using K = SurfaceKeys;
  return {
      text("file", &K::file, "STL (text or binary), OBJ, PLY or STEP, relative to the case file"),
      real("unit", &K::unit, "m", range::positive(), "length of one unit of the file: \"1 mm\", \"1 inch\"")
          .optional("that of a STEP file; of others it must be given"),
      real("triangle_size", &K::triangle_size, "m", range::positive(),
           "longest edge of the triangles of a STEP file, which gmsh makes")
          .optional("domain.cell_size"),
      text("digest", &K::digest, "SHA-256 that the file must have; runs write it").optional()};
}

Surface::Surface(SurfaceKeys keys, const std::filesystem::path& folder, double resolution)
    : keys_(std::move(keys)), source_(find_source(keys_.file, keys_.digest, folder)) {
  keys_.file = named_file(keys_.file, folder).string();
  keys_.digest = source_.digest;
  std::vector<solids::Triangle> triangles = read_triangles(resolution);
  try {
    audit_ = solids::repair(triangles);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", utf8(source_.path.string()), error.what()));
  }
  inside_ = std::make_shared<const solids::Inside>(std::move(triangles), audit_);
  enclosure_ = solids::enclosure_of(inside_->tree(), audit_);
  volume_ = enclosure_ ? enclosure_->volume : counted_volume(*this);
  if (!(volume_ > 0.0)) {
    throw InputError(fmt::format("{}: its {} triangles enclose no volume: {} edges are open",
                                 utf8(source_.path.string()), audit_.triangles, audit_.open_edges));
  }
  measure_thickness();
}

std::vector<solids::Triangle> Surface::read_triangles(double resolution) {
  const std::string file = utf8(source_.path.string());
  if (!solids::is_step(source_.path)) {
    if (!std::isfinite(keys_.unit)) {
      throw InputError(
          fmt::format("{}: 'unit' is missing: the file does not state its unit of length", file));
    }
    if (std::isfinite(keys_.triangle_size)) {
      throw InputError(
          fmt::format("{}: 'triangle_size' belongs to STEP files, this one has its triangles", file));
    }
    return solids::read_surface(source_.path, keys_.unit);
  }
  if (std::isfinite(keys_.unit)) {
    throw InputError(fmt::format("{}: a STEP file states its unit of length: leave 'unit' out", file));
  }
  if (!std::isfinite(keys_.triangle_size)) keys_.triangle_size = resolution;
  if (!std::isfinite(keys_.triangle_size)) {
    throw InputError(
        fmt::format("{}: 'triangle_size' is missing, and the size of the cells is not known", file));
  }
  find_triangles();
  return solids::read_surface(source_.companions.front(), 1.0);
}

void Surface::find_triangles() {
  namespace fs = std::filesystem;
  constexpr std::size_t digits = 12;
  const std::string begin = source_.path.filename().string() + ".", end = ".stl";
  const auto digest_of = [&](const fs::path& path) {
    return sha256_of_file(regular_file(path)).substr(0, digits);
  };
  // A run keeps NAME.step beside NAME.step.DIGITS.stl.
  if (source_.path.parent_path().filename() == source_.digest.substr(0, digits)) {
    for (const fs::directory_entry& entry : fs::directory_iterator(source_.path.parent_path())) {
      const std::string called = entry.path().filename().string();
      if (called.size() != begin.size() + digits + end.size() || !called.starts_with(begin) ||
          !called.ends_with(end)) {
        continue;
      }
      if (digest_of(entry.path()) != called.substr(begin.size(), digits)) {
        throw InputError(fmt::format("{}: the file has changed: its digest is not that of its name",
                                     utf8(entry.path().string())));
      }
      source_.companions = {entry.path()};
      return;
    }
  }
  made_ = std::make_shared<const TemporaryFolder>();
  const fs::path raw = made_->path() / "triangles.stl";
  solids::triangulate_step(source_.path, keys_.triangle_size, raw);
  source_.companions = {made_->path() / (begin + digest_of(raw) + end)};
  fs::rename(raw, source_.companions.front());
}

bool Surface::contains(const Vector3& point) const { return inside_->contains(point); }

void Surface::measure_thickness() {
  constexpr std::size_t most_samples = 2000;
  const std::vector<solids::Triangle>& triangles = inside_->tree().triangles();
  const std::size_t stride = std::max<std::size_t>(1, triangles.size() / most_samples);
  const double longest = (audit_.upper - audit_.lower).norm(), step = longest / 1000.0;
  struct Sample {
    double thickness, area;
  };
  std::vector<Sample> samples((triangles.size() + stride - 1) / stride);
  parallel::for_each_uneven(samples.size(), [&](std::size_t i) {
    const solids::Triangle& t = triangles[i * stride];
    const Vector3 middle = (t[0] + t[1] + t[2]) / 3.0;
    Vector3 inwards = (t[2] - t[0]).cross(t[1] - t[0]);
    const double area = 0.5 * inwards.norm();
    inwards.normalize();
    if (!contains(middle + 0.1 * step * inwards)) inwards = -inwards;
    double depth = 0.0;
    while (depth < longest && contains(middle + (depth + 0.1 * step) * inwards)) depth += step;
    samples[i] = {depth, depth > 0.0 ? area : 0.0};  // 0: a sheet, or at a hole
  });
  std::ranges::sort(samples, {}, &Sample::thickness);
  double area = 0.0, passed = 0.0;
  for (const Sample& sample : samples) area += sample.area;
  thickness_ = std::numeric_limits<double>::quiet_NaN();
  for (const Sample& sample : samples) {
    passed += sample.area;
    if (!(passed > 0.01 * area)) continue;
    thickness_ = sample.thickness;
    break;
  }
}

std::vector<std::string> Surface::account() const {
  const Vector3 size = 1e3 * (audit_.upper - audit_.lower);
  std::vector<std::string> lines = {
      fmt::format("surface {}: {} triangles, {:.4g} x {:.4g} x {:.4g} mm, SHA-256 {}",
                  source_.path.filename().string(), audit_.triangles, size[0], size[1], size[2],
                  source_.digest),
      fmt::format("  volume {:.6g} mm^3 by {}; thinnest part {:.3g} mm", 1e9 * volume_,
                  enclosure_ ? "the divergence theorem" : "counting", 1e3 * thickness_)};
  if (!source_.companions.empty()) {
    lines.push_back(fmt::format("  triangulated by gmsh, edges up to {:.4g} mm", 1e3 * keys_.triangle_size));
  }
  if (enclosure_ && enclosure_->inverted > 0) {
    lines.push_back(fmt::format("  {} of {} closed parts turned inside out: read as their inside",
                                enclosure_->inverted, enclosure_->parts));
  }
  if (enclosure_ && enclosure_->covered > 0) {
    lines.push_back(
        fmt::format("  {} of {} closed parts enclosed twice: they lie in the solid, with its sense; turned "
                    "they would be cavities: look at it",
                    enclosure_->covered, enclosure_->parts));
  }
  if (!enclosure_ && audit_.are_parts_closed) lines.emplace_back("  closed parts cross: look at it");
  if (audit_.degenerate + audit_.repeated + audit_.flipped > 0) {
    lines.push_back(
        fmt::format("  repaired: {} triangles without area and {} repeated ones dropped, {} turned",
                    audit_.degenerate, audit_.repeated, audit_.flipped));
  }
  if (audit_.cancelled > 0) {
    lines.push_back(
        fmt::format("  {} faces within the solid, given once in each sense, dropped", audit_.cancelled));
  }
  if (!audit_.is_closed()) {
    lines.push_back(
        fmt::format("  not closed: {} open edges, {} of more than two triangles; closed by its winding "
                    "number: look at it",
                    audit_.open_edges, audit_.crowded_edges));
  }
  return lines;
}

std::string Surface::toml() const { return shape_as_toml(keys_); }

}  // namespace whipple::cases
