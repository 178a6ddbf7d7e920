// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/shapes/points.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ranges>

#include "src/case/shapes/primitive.hpp"
#include "src/case/shapes/source_file.hpp"
#include "src/core/base/files.hpp"
#include "src/core/base/log.hpp"
#include "src/core/base/text.hpp"
#include "src/fem/vtk_arrays.hpp"
#include "src/fem/vtk_mesh.hpp"

namespace whipple::cases {
namespace {

solids::PointTable table_of_vtu(const std::string& text, const std::string& file) {
  const fem::VtkPoints read = fem::read_vtu_points(text, file, solids::is_size_column);
  solids::PointTable table{
      .file = file, .columns = {{"x", {}}, {"y", {}}, {"z", {}}}, .unread = {}, .lines = {}};
  for (std::size_t i = 0; i < read.points.size(); ++i) table.columns[i % 3].values.push_back(read.points[i]);
  for (const fem::VtkPoints::Array& array : read.data) table.columns.push_back({array.name, array.values});
  return table;
}

solids::PointTable read_table(const std::filesystem::path& path) {
  const std::string bytes = read_text(path), file = utf8(path.string());
  if (bytes.starts_with("# vtk DataFile")) {
    throw InputError(fmt::format("{}: a legacy VTK file: save it as .vtu (XML), or as CSV", file));
  }
  if (bytes.starts_with("\x89HDF")) {
    throw InputError(fmt::format(
        "{}: an HDF5 file: 'whipple export' makes VTU or CSV files of the snapshots of a run", file));
  }
  if (fem::is_vtk(path)) return table_of_vtu(bytes, file);
  solids::PointTable table = solids::read_point_csv(bytes, file);
  if (!table.unread.empty())
    log::info("{}: columns that are not read: {}", file, fmt::join(table.unread, ", "));
  return table;
}

}  // namespace

ParameterTable<PointsKeys> PointsKeys::parameters() {
  using K = PointsKeys;
  return {
      text("file", &K::file,
           "CSV with columns x, y, z, and mass or volume, or VTU, relative to the case file"),
      real("unit", &K::unit, "m", range::positive(), "length of one unit of the file: \"1 mm\"")
          .optional("those of the headings"),
      real("mass_unit", &K::mass_unit, "kg", range::positive(), "mass of one unit of the file: \"1 g\"")
          .optional("that of the heading"),
      choice("size", &K::size, "volumes follow from the masses and the density of the body | are those given")
          .optional("the one that the file has"),
      real("density", &K::density, "kg/m^3", range::positive(),
           "density that the masses belong to, which must be that of the body at the start; runs write it")
          .optional("that of the body"),
      text("digest", &K::digest, "SHA-256 that the file must have; runs write it").optional()};
}

double mean_edge(std::span<const GivenParticle> particles, bool is_planar) {
  const double power = is_planar ? 2.0 : 3.0;
  double sum = 0.0;
  for (const GivenParticle& each : particles) sum += std::pow(each.edge, power);
  return std::pow(sum / static_cast<double>(particles.size()), 1.0 / power);
}

double largest_edge(std::span<const GivenParticle> particles) {
  return std::ranges::max(particles, {}, &GivenParticle::edge).edge;
}

Points::Points(PointsKeys keys, const std::filesystem::path& folder) : keys_(std::move(keys)) {
  Read read{.source = find_source(keys_.file, keys_.digest, folder), .list = {}};
  keys_.file = named_file(keys_.file, folder).string();
  keys_.digest = read.source.digest;
  read.list = solids::points_of(read_table(read.source.path), {keys_.unit, keys_.mass_unit}, keys_.size);
  if (!read.list.are_masses && std::isfinite(keys_.density)) {
    throw InputError("'density' belongs to particles with masses, and the file has volumes");
  }
  // Where only the material tells a volume, the cubes are as if they filled their box.
  Vector3 lower = read.list.places.front(), upper = lower;
  for (const Vector3& x : read.list.places) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  const auto count = static_cast<double>(read.list.places.size());
  const double longest = (upper - lower).maxCoeff(),
               estimate = longest > 0.0 ? longest / std::cbrt(count) : 1e-3;
  const bool is_known = !read.list.are_masses || std::isfinite(keys_.density);
  for (std::size_t i = 0; i < read.list.places.size(); ++i) {
    const double volume = read.list.amounts[i] / (read.list.are_masses ? keys_.density : 1.0);
    particles_.push_back({read.list.places[i], is_known ? std::cbrt(volume) : estimate});
  }
  read_ = std::make_shared<const Read>(std::move(read));
  measure();
}

void Points::measure() {
  const Vector3 everywhere = Vector3::Constant(std::numeric_limits<double>::infinity());
  bounds_ = {everywhere, -everywhere};
  volume_ = 0.0;
  for (const GivenParticle& each : particles_) {
    const Vector3 half = Vector3::Constant(0.5 * each.edge);
    bounds_.lower = bounds_.lower.cwiseMin(each.position - half);
    bounds_.upper = bounds_.upper.cwiseMax(each.position + half);
    volume_ += each.edge * each.edge * each.edge;
  }
  bins_.reset();
}

bool Points::contains(const Vector3& point) const {
  const auto covers = [&](std::uint32_t i) {
    const Vector3 distance = (point - particles_[i].position).cwiseAbs();
    return distance.head(is_planar_ ? 2 : 3).maxCoeff() <= 0.5 * particles_[i].edge;
  };
  if (!bins_) {
    return std::ranges::any_of(
        std::views::iota(std::uint32_t{0}, static_cast<std::uint32_t>(particles_.size())), covers);
  }
  return !bins_->none_near(point, covers);
}

std::unique_ptr<Shape> Points::settled(const Settling& settling) const {
  const solids::PointList& list = read_->list;
  constexpr double tolerance = 1e-6;
  const double density = std::isfinite(settling.density) ? settling.density : keys_.density;
  if (list.are_masses && !std::isfinite(density)) return nullptr;
  if (std::isfinite(keys_.density) && std::abs(keys_.density - density) > tolerance * density) {
    throw InputError(fmt::format("'density' of the points is {} kg/m^3, and the body starts with {} kg/m^3",
                                 keys_.density, density));
  }
  auto made = std::make_unique<Points>(*this);
  if (list.are_masses) made->keys_.density = density;
  made->is_settled_ = true;
  made->is_planar_ = settling.is_planar;
  const double plane = list.places.front()[2];
  double size = 0.0;  // volumes or areas
  for (std::size_t i = 0; i < list.places.size(); ++i) {
    GivenParticle& particle = made->particles_[i];
    const double volume = list.amounts[i] / (list.are_masses ? density : 1.0);
    if (!settling.is_planar) {
      particle.edge = std::cbrt(volume);
      size += volume;
    } else {
      if (list.places[i][2] != plane) {
        throw InputError(
            fmt::format("{}: z = {} m, where others have {} m: these are no particles of a section",
                        list.where(i), list.places[i][2], plane));
      }
      const double depth = settling.depth(particle.position);
      if (!(depth > 0.0)) {
        throw InputError(fmt::format("{}: lies on or below the axis: expected a radius > 0", list.where(i)));
      }
      particle.position[2] = 0.0;
      particle.edge = std::sqrt(volume / depth);
      size += volume / depth;
    }
    if (!(particle.edge > 0.0) || !std::isfinite(particle.edge)) {
      throw InputError(fmt::format("{}: no volume follows from its {} of {}", list.where(i),
                                   list.are_masses ? "mass" : "volume", list.amounts[i]));
    }
  }
  made->measure();
  const Vector3 box = made->bounds_.upper - made->bounds_.lower;
  const double room = settling.is_planar ? box[0] * box[1] : box.prod();
  constexpr double most = 2.0;
  if (size > most * room) {
    throw InputError(
        fmt::format("{}: the {} particles fill the box around them {:.3g} times: is {} right?", list.file,
                    list.places.size(), size / room,
                    list.are_masses ? "the unit of mass, and the density," : "the unit of the volumes"));
  }
  // Cubes are looked up in bins no smaller than they reach, and not many more bins than particles.
  double edge = 0.5 * largest_edge(made->particles_);
  const auto bins = [&] { return (box / edge).cwiseMax(0.0).array().floor().operator+(1.0).prod(); };
  while (bins() > 4.0 * static_cast<double>(list.places.size()) + 64.0) edge *= 1.26;
  made->bins_.emplace(made->bounds_.lower, made->bounds_.upper, edge);
  for (std::uint32_t i = 0; i < made->particles_.size(); ++i)
    made->bins_->add(made->particles_[i].position, i);
  return made;
}

std::vector<std::string> Points::account() const {
  const solids::PointList& list = read_->list;
  const Vector3 size = 1e3 * (bounds_.upper - bounds_.lower);
  const double total = std::accumulate(list.amounts.begin(), list.amounts.end(), 0.0);
  const auto [least, most] = std::ranges::minmax(particles_, {}, &GivenParticle::edge);
  std::vector<std::string> lines = {fmt::format(
      "points {}: {} particles, {}, {:.4g} x {:.4g} x {:.4g} mm, SHA-256 {}",
      read_->source.path.filename().string(), particles_.size(),
      list.are_masses ? fmt::format("{:.6g} g", 1e3 * total) : fmt::format("{:.6g} mm^3", 1e9 * total),
      size[0], size[1], is_planar_ ? 0.0 : size[2], read_->source.digest)};
  if (!is_settled_) return lines;
  double filled = 0.0;
  for (const GivenParticle& each : particles_)
    filled += is_planar_ ? each.edge * each.edge : std::pow(each.edge, 3);
  const double room = is_planar_ ? size[0] * size[1] * 1e-6 : size.prod() * 1e-9;
  lines.push_back(fmt::format("  {} of {:.4g} to {:.4g} mm, which fill {:.3g} % of the box around them",
                              is_planar_ ? "squares" : "cubes", 1e3 * least.edge, 1e3 * most.edge,
                              1e2 * filled / room));
  return lines;
}

std::string Points::toml() const { return shape_as_toml(keys_); }

}  // namespace whipple::cases
