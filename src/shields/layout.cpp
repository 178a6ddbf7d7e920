// SPDX-License-Identifier: BSD-3-Clause
#include "src/shields/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/core/base/error.hpp"
#include "src/shields/alloys.hpp"

namespace whipple::shields {
namespace {

constexpr double cells_per_sphere = 12.0, cells_per_bumper = 4.0, cells_per_wall = 6.0, least_cells = 2.0;
constexpr double density_of_layer = 189.0;  // kg/m^3, of the foam of the library
constexpr double cone = 0.5;  // tangent of the half-angle of the cone of debris that the wall covers

/// Chooses the cell size: the coarsest that gives sphere, bumpers and wall their cells, but not finer than the cap.
void choose_cells(const Impact& impact, const CaseOptions& options, Layout& layout) {
  const double d = impact.projectile.diameter;
  if (options.cell_size) {
    layout.cell_size = *options.cell_size;
    layout.chosen_by = "given";
    return;
  }
  layout.cell_size = d / cells_per_sphere;
  layout.chosen_by = fmt::format("{} cells across the sphere", cells_per_sphere);
  const auto need = [&](double thickness, double cells, const std::string& name) {
    if (!(thickness / cells < layout.cell_size)) return;
    layout.cell_size = thickness / cells;
    layout.chosen_by = fmt::format("{} cells across the {}", cells, name);
  };
  for (const Bumper& bumper : impact.shield.bumpers) need(bumper.sheet.thickness, cells_per_bumper, "bumper");
  need(impact.shield.wall.thickness, cells_per_wall, "wall");
  if (layout.cell_size < d / options.most_across) {
    layout.chosen_by =
        fmt::format("cap of {} cells across the sphere instead of {}", options.most_across, layout.chosen_by);
    layout.cell_size = d / options.most_across;
  }
}

/// Places the sheets: a bumper of three diameters and ten thicknesses about the point of impact, further sheets as wide
/// as the cone of debris from the first.
void place_sheets(const Impact& impact, Layout& layout) {
  const double d = impact.projectile.diameter, tangent = std::tan(impact.projectile.angle);
  const double across = d / std::cos(impact.projectile.angle);  // of the trace of the sphere on a sheet
  double front = 0.0;
  const auto place = [&](const std::string& name, double thickness, double reach) {
    Plate plate{.name = name, .front = front, .thickness = thickness, .radius = reach};
    plate.along = {-reach, reach + front * tangent + (tangent > 0.0 ? across : 0.0)};
    plate.cells = thickness / layout.cell_size;
    plate.resolved = plate.cells >= least_cells * (1.0 - 1e-9);
    layout.plates.push_back(plate);
  };
  const auto reach_of = [&](double thickness) {
    return front > 0.0 ? 0.5 * d + cone * front + thickness : 3.0 * d + 10.0 * thickness;
  };
  const std::vector<Bumper>& bumpers = impact.shield.bumpers;
  for (std::size_t k = 0; k < bumpers.size(); ++k) {
    const double thickness = bumpers[k].sheet.thickness;
    place(bumpers.size() == 1 ? "bumper" : fmt::format("bumper_{}", k + 1), thickness, reach_of(thickness));
    front += thickness + bumpers[k].spacing;
  }
  place("wall", impact.shield.wall.thickness, reach_of(impact.shield.wall.thickness));
}

/// Fills the spacing with foam, as wide as the bumper and, in an oblique flight, as long as the wall.
void place_foam(const Impact& impact, const CaseOptions& options, Layout& layout) {
  if (!(impact.shield.foam.density > 0.0)) return;
  const Plate &bumper = layout.plates.front(), &wall = layout.plates.back();
  layout.foam_model = options.foam;
  layout.seed = options.seed;
  layout.foam = bumper;
  layout.foam->name = "foam";
  layout.foam->front = bumper.thickness;
  layout.foam->thickness = wall.front - bumper.thickness;
  layout.foam->along[1] = std::max(bumper.along[1], wall.along[1]);
}

void place_domain(const Impact& impact, Layout& layout) {
  const double d = impact.projectile.diameter, h = layout.cell_size, margin = 4.0 * h;
  const Plate& wall = layout.plates.back();
  const bool oblique = impact.projectile.angle > 0.0;
  double lower = 0.0, upper = 0.0, side = 0.0;
  for (const Plate& plate : layout.plates) {
    lower = std::min(lower, plate.along[0]);
    upper = std::max(upper, plate.along[1]);
    side = std::max(side, plate.radius);
  }
  const auto to_cells = [h](double x) { return std::ceil(x / h - 1e-9) * h; };
  layout.lower = {oblique ? -to_cells(margin - lower) : 0.0, 0.0, -to_cells(4.0 * d)};
  const double behind = std::max(5.0 * wall.thickness, 4.0 * d);
  layout.upper = {to_cells(upper + margin), to_cells(side + margin),
                  to_cells(wall.front + wall.thickness + behind)};
}

/// Returns the part of the foam's volume that particles fill.
double filled(const Impact& impact, const Layout& layout) {
  const Foam& foam = impact.shield.foam;
  return layout.foam_model == FoamModel::struts ? foam.density / alloy_named(foam.alloy).density : 1.0;
}

/// Chooses the times: debris at a quarter of the impact speed has arrived, and the wall has then had the time in which
/// 66 m/s cover a diameter of the sphere; a snapshot in each time in which 1.5 km/s do.
void choose_times(const Impact& impact, Layout& layout) {
  const double d = impact.projectile.diameter;
  const double normal_speed = impact.projectile.velocity * std::cos(impact.projectile.angle);
  layout.end = layout.plates.back().front / (0.25 * normal_speed) + d / 66.0;
  layout.snapshot_every = d / 1500.0;
}

void count_particles(const Impact& impact, Layout& layout) {
  const double spacing = 0.5 * layout.cell_size, r = 0.5 * impact.projectile.diameter;
  const bool oblique = impact.projectile.angle > 0.0;
  double volume = 0.0;
  if (layout.model == Model::section) {
    volume = 0.5 * std::numbers::pi * r * r;
    for (const Plate& plate : layout.plates) volume += plate.radius * plate.thickness;
    if (layout.foam) volume += layout.foam->radius * layout.foam->thickness;
    layout.particles = volume / (spacing * spacing);
    return;
  }
  const double copies = oblique ? 2.0 : 4.0;
  volume = 4.0 / 3.0 * std::numbers::pi * r * r * r / copies;
  const auto volume_of = [&](const Plate& plate) {
    const double face = oblique ? (plate.along[1] - plate.along[0]) * plate.radius
                                : std::numbers::pi * plate.radius * plate.radius / copies;
    return face * plate.thickness;
  };
  for (const Plate& plate : layout.plates) volume += volume_of(plate);
  if (layout.foam) volume += volume_of(*layout.foam) * filled(impact, layout);
  layout.particles = volume / (spacing * spacing * spacing);
}

/// @throws InputError if no case is made of the foam
void check_foam(const Impact& impact, const CaseOptions& options) {
  const Foam& foam = impact.shield.foam;
  if (!(foam.density > 0.0)) return;
  const auto refuse = [&](const std::string& reason) {
    throw InputError(fmt::format("{}: {}", impact.name, reason));
  };
  if (impact.shield.bumpers.size() != 1)
    refuse(
        fmt::format("foam fills the spacing of one bumper, the shield has {}", impact.shield.bumpers.size()));
  if (options.foam == FoamModel::layer) {
    if (std::abs(foam.density - density_of_layer) > 0.05 * density_of_layer)
      refuse(fmt::format("the foam of the library has {:.4g} kg/m^3, this one {:.4g}: use --foam struts",
                         density_of_layer, foam.density));
    return;
  }
  if (options.model == Model::section) refuse("struts have no section: use --model space, or --foam layer");
  if (!(foam.cell > 0.0)) refuse("struts need the size of the foam's cells: shield.foam.cell");
  const double solid = alloy_named(foam.alloy).density;
  if (!(foam.density < solid))
    refuse(fmt::format("foam of {:.4g} kg/m^3 is denser than its alloy, {:.4g}", foam.density, solid));
}

}  // namespace

Layout layout_of(const Impact& impact, const CaseOptions& options) {
  if (options.model == Model::section && impact.projectile.angle > 0.0)
    throw InputError(
        fmt::format("{}: a section is for normal impact, the angle is {:.4g} degrees: use --model space",
                    impact.name, impact.projectile.angle * 180.0 / std::numbers::pi));
  if (impact.shield.stuffing.areal_density > 0.0)
    throw InputError(
        fmt::format("{}: no case is made of stuffing, which only the equations know", impact.name));
  check_foam(impact, options);
  Layout layout;
  layout.model = options.model;
  choose_cells(impact, options, layout);
  layout.cells_across = impact.projectile.diameter / layout.cell_size;
  place_sheets(impact, layout);
  place_foam(impact, options, layout);
  place_domain(impact, layout);
  choose_times(impact, layout);
  count_particles(impact, layout);
  double cells = 1.0;
  for (std::size_t a = 0; a < 3; ++a) {
    if (options.model == Model::space || a != 1)
      cells *= std::ceil((layout.upper[a] - layout.lower[a]) / layout.cell_size);
  }
  if (!(layout.cell_size > 0.0) || !std::isfinite(cells) || !std::isfinite(layout.particles) ||
      !std::isfinite(layout.end))
    throw InputError(
        fmt::format("{}: sphere, sheets and cells differ too much in size: {:.3g} cells, {:.3g} "
                    "particles, an end at {:.3g} s",
                    impact.name, cells, layout.particles, layout.end));
  return layout;
}

std::string not_resolved(const Layout& layout) {
  std::string text;
  for (const Plate& plate : layout.plates) {
    if (!plate.resolved)
      text += fmt::format("{}{} ({:.3g} cells)", text.empty() ? "" : ", ", plate.name, plate.cells);
  }
  return text;
}

}  // namespace whipple::shields
