// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/device/problem.hpp"

#include <algorithm>
#include <cmath>

#include "src/device/material/describe.hpp"
#include "src/material/fluid.hpp"
#include "src/solver/carriers/domains.hpp"
#include "src/solver/stages/fill.hpp"
#include "src/solver/stages/material.hpp"

namespace whipple::solver {
namespace {

device::FaceKind face_kind(grid::Boundary boundary) {
  switch (boundary) {
    case grid::Boundary::outflow:
      return device::FaceKind::outflow;
    case grid::Boundary::no_slip:
      return device::FaceKind::mirror_point;
    default:
      return device::FaceKind::mirror;
  }
}

device::Dimension dimension_of(const grid::Geometry& geometry) {
  using enum device::Dimension;
  if (!geometry.is_planar()) return space;
  return geometry.is_axisymmetric() ? axisymmetric : plane_strain;
}

device::WallKind wall_kind(grid::Boundary boundary) {
  using enum device::WallKind;
  switch (boundary) {
    case grid::Boundary::symmetry:
      return symmetry;
    case grid::Boundary::no_slip:
      return no_slip;
    case grid::Boundary::separating:
      return separating;
    case grid::Boundary::friction:
      return friction;
    case grid::Boundary::outflow:
      break;
  }
  return none;
}

}  // namespace

device::Problem device_problem(const State& state, const ContactStage& contact) {
  const cases::Case& setup = state.setup;
  const grid::Geometry& geometry = setup.geometry;
  device::Problem problem;
  problem.dimension = dimension_of(geometry);
  problem.cell_size = geometry.cell_size;
  problem.lower = {geometry.lower[0], geometry.lower[1], geometry.lower[2]};
  for (std::size_t a = 0; a < 3; ++a) problem.cells[a] = geometry.cells[a];
  for (std::size_t face = 0; face < 6; ++face) {
    problem.faces[face] = face_kind(geometry.boundary[face]);
    problem.mirrors[face] = {.active = geometry.mirrors(face),
                             .reverses_all = geometry.boundary[face] == grid::Boundary::no_slip,
                             .fields = 0};
    problem.walls.kind[face] = wall_kind(geometry.boundary[face]);
  }
  problem.walls.friction = geometry.friction;
  problem.slope_smoothing = setup.transfer.slope_smoothing;
  problem.kappa = setup.transfer.kappa;
  const cases::Dissipation& dissipation = setup.dissipation;
  problem.losses = {.heat_share = dissipation.heat_share,
                    .allowance_length = dissipation.allowance_time * setup.domain.cell_size,
                    .collision_rate = dissipation.collision_rate};
  problem.shock_conduction = dissipation.shock_conduction;
  problem.conduction_onset = dissipation.conduction_onset;
  problem.conduction_rise = dissipation.conduction_rise;
  const double size = geometry.cell_size, length = setup.splitting.length;
  problem.domain_limits = {.longest = 0.25 * length * length * size * size,
                           .parted = domains::parted_square(setup, setup.domain.cell_size),
                           .generations = static_cast<double>(setup.splitting.maximum_generations),
                           .divides_all = setup.splitting.of == cases::Divided::all,
                           .planar = geometry.is_planar()};
  problem.strong_pressure = FillWatch::strong;
  problem.filled = FillWatch::filled;
  problem.initial_density = state.initial_density;
  problem.fields = 1;
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const cases::ArtificialViscosity& viscosity = setup.viscosity_of(b);
    problem.conducting.push_back({.heat_capacity = std::max(setup.materials[b]->reference.heat_capacity, 0.0),
                                  .linear_viscosity = viscosity.linear,
                                  .quadratic_viscosity = viscosity.quadratic});
    const std::vector<std::uint8_t>& fields = setup.contact_fields.of_body;
    problem.field_of_body.push_back(setup.contact_fields.several() ? fields[b] : 0);
    const std::uint32_t field = problem.field_of_body.back();
    problem.fields = std::max(problem.fields, field + 1);
    for (std::size_t face = 0; face < 6; ++face) {
      if (geometry.boundary[face] == grid::Boundary::outflow) continue;
      if (contact.is_one_with_image(b, face)) {
        problem.mirrors[face].fields |= 1U << field;
      } else {
        problem.walls.apart |= 1U << face;
      }
    }
    const Fluidity fluid = fluidity(*setup.materials[b]);
    problem.domains.push_back({.deform = domains::follow_deformation(state, b),
                               .hold = domains::may_divide(setup) && fluid != Fluidity::never,
                               .fluidity = fluid,
                               .initial_density = state.initial_density[b]});
    UpdateSettings settings = update_settings(state, b);
    settings.heating = heating_viscosity(state);
    problem.materials.push_back(device::describe(*setup.materials[b], settings, problem.tables));
  }
  if (problem.fields > 1) problem.contact = contact.constants_for_device();
  return problem;
}

device::ContactConstants ContactStage::constants_for_device() const {
  const cases::ContactControl& control = state_.setup.contact;
  device::ContactConstants constants;
  const bool common = control.method == cases::ContactMethod::automatic;
  constants.response = common ? device::ContactResponse::common_field : device::ContactResponse::impulses;
  constants.normal = control.normal == contact::Normal::collinear ? device::ContactNormal::collinear
                                                                  : device::ContactNormal::separating;
  constants.gap_test = control.gap_test;
  constants.gap = control.gap;
  constants.friction.fill(control.friction);
  const std::vector<double> least = least_relaxation_rates();
  std::ranges::copy(least, constants.least_relaxation_rate.begin());
  for (std::size_t face = 0; face < 6; ++face) {
    if (state_.setup.geometry.boundary[face] != grid::Boundary::outflow)
      constants.reflecting_faces |= 1U << face;
  }
  return constants;
}

void ContactStage::see_face(std::size_t face, const device::DecidingApproaches& of_face) {
  for (const device::Approach& approach : {of_face.soonest, of_face.hardest}) {
    first_touches_->see_face(face, approach.open, approach.closing);
  }
}

void ContactStage::see(const device::DecidingApproaches& of_pair) {
  for (const device::Approach& approach : {of_pair.soonest, of_pair.hardest}) {
    std::uint32_t second = 1;
    while (device::pair_of_fields(0, second + 1) <= approach.pair) ++second;
    first_touches_->see(approach.pair - device::pair_of_fields(0, second), second, approach.open,
                        approach.closing);
  }
}

}  // namespace whipple::solver
