// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/refinement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "src/case/case.hpp"

namespace whipple::cases {

ParameterTable<Refinement> Refinement::parameters() {
  return {
      vector("lower", &Refinement::lower, "m", range::any(),
             "lower corner of the region; moved outwards to cells of twice the size")
          .optional("none"),
      vector("upper", &Refinement::upper, "m", range::any(), "upper corner of the region, likewise")
          .optional("none"),
      text("body", &Refinement::body, "body whose bounding box the region is, instead of corners").optional(),
      real("margin", &Refinement::margin, "m", range::non_negative(), "around the bounding box").optional()};
}

namespace {

std::optional<std::size_t> find_body(const Case& setup, const std::string& name) {
  const auto found = std::ranges::find(setup.bodies, name, &Body::name);
  if (found == setup.bodies.end()) return std::nullopt;
  return static_cast<std::size_t>(found - setup.bodies.begin());
}

/// Returns the corners of a region; nothing if its body has no shape yet.
std::optional<Shape::Bounds> box_of(const Case& setup, const Refinement& region) {
  if (region.body.empty()) return Shape::Bounds{region.lower, region.upper};
  const std::optional<std::size_t> body = find_body(setup, region.body);
  if (!body || setup.bodies[*body].shape == nullptr) return std::nullopt;
  Shape::Bounds bounds = setup.bodies[*body].shape->bounds();
  bounds.lower.array() -= region.margin;
  bounds.upper.array() += region.margin;
  return bounds;
}

/// Returns a box in coarse cells.
grid::RefinedBox in_coarse_cells(const grid::Geometry& geometry, const Shape::Bounds& box) {
  constexpr double round_off = 1e-6, none = grid::RefinedBox::no_end;
  const double edge = 2.0 * geometry.cell_size;
  grid::RefinedBox cells{};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto axis = static_cast<Eigen::Index>(a);
    const double first = std::floor((box.lower[axis] - geometry.lower[axis]) / edge + round_off);
    const double last = std::ceil((box.upper[axis] - geometry.lower[axis]) / edge - round_off);
    const bool across = geometry.is_planar() && a == 2;
    cells.from[a] = across || !(first > 0.0) ? -none : first;
    cells.to[a] = across || !(last < 0.5 * geometry.cells[a]) ? none : last;
  }
  return cells;
}

bool is_empty(const grid::RefinedBox& box, const grid::Geometry& geometry) {
  for (std::size_t a = 0; a < 3; ++a) {
    if (!(box.from[a] < box.to[a]) || box.to[a] <= 0.0) return true;
    if (box.from[a] >= 0.5 * geometry.cells[a]) return true;
  }
  return false;
}

}  // namespace

void Refinement::check(const Case& setup, const Faults& faults) const {
  const bool has_corners = lower != upper;
  if (body.empty()) {
    if (!has_corners) return faults.add("lower", "a region needs corners, 'lower' and 'upper', or a 'body'");
    if (margin > 0.0) faults.add("margin", "'margin' is around the box of a 'body'");
  } else {
    if (has_corners) faults.add("body", "a region is the box of a 'body' or has corners, not both");
    if (!find_body(setup, body)) return faults.add("body", fmt::format("there is no body \"{}\"", body));
  }
  const std::optional<Shape::Bounds> box = box_of(setup, *this);
  if (!box || !(setup.geometry.cell_size > 0.0)) return;  // reported elsewhere
  const grid::RefinedBox cells = in_coarse_cells(setup.geometry, *box);
  const char* const key = body.empty() ? "upper" : "body";
  if (is_empty(cells, setup.geometry)) {
    return faults.add(key, "the region holds no cell of the domain");
  }
  for (std::size_t a = 0; a < 3; ++a) {
    const double edge = cells.to[a] - cells.from[a];
    if (edge >= grid::RefinedBox::least_edge) continue;
    faults.add(key,
               fmt::format("the region is {} cells of {} m thick along {}: expected at least {}, since the "
                           "cells change their size within two of them on each side",
                           edge, 2.0 * setup.geometry.cell_size, "xyz"[a], grid::RefinedBox::least_edge));
  }
}

grid::Levels levels_of(const Case& setup) {
  std::vector<grid::RefinedBox> boxes;
  for (const Refinement& region : setup.domain.refinement) {
    const std::optional<Shape::Bounds> box = box_of(setup, region);
    if (!box || !box->lower.allFinite() || !box->upper.allFinite()) continue;
    const grid::RefinedBox cells = in_coarse_cells(setup.geometry, *box);
    if (!is_empty(cells, setup.geometry)) boxes.push_back(cells);
  }
  return grid::Levels(std::move(boxes));
}

void check_two_levels(const Case& setup, const Faults& faults) {
  if (setup.domain.refinement.empty()) return;
  const Faults here = faults.in("domain");
  const auto refuse = [&](bool refused, const char* what) {
    if (refused) here.add("refinement", fmt::format("a grid of two cell sizes has no {}", what));
  };
  const auto any_body = [&](auto&& has) { return std::ranges::any_of(setup.bodies, has); };
  refuse(!has_inertia(setup.time.scheme), "load steps: scheme = \"quasi_static\" wants one size");
  refuse(setup.transfer.particle_update == ParticleUpdate::fmpm,
         "full mass matrix: particle_update = \"fmpm\" wants one size");
  refuse(setup.transfer.random_shift, "random shift: it would move the regions");
  refuse(setup.heat.conduction, "heat conduction, [heat] conduction");
  refuse(any_body([](const Body& body) { return body.volumetric == Volumetric::cell; }),
         "means over cells: expected volumetric = \"point\"");
  refuse(!setup.contact_fields.cracked.empty(),
         "fields of cracks: expected failure.cracks other than \"fields\"");
}

}  // namespace whipple::cases
