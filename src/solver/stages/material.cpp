// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/stages/material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "src/core/base/simd.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/solver/carriers/domains.hpp"

namespace whipple::solver {

UpdateSettings update_settings(const State& state, std::size_t body) {
  const cases::ArtificialViscosity& viscosity = state.setup.viscosity_of(body);
  return {.time_step = state.run.time_step,
          .cell_size = state.setup.domain.cell_size,
          .linear_viscosity = viscosity.linear,
          .quadratic_viscosity = viscosity.quadratic,
          .expansion_viscosity = viscosity.expansion,
          .affine_gain = state.setup.dissipation.affine_gain,
          .affine_compression = state.setup.dissipation.affine_compression,
          .initial_density = state.initial_density[body],
          .rotation = state.setup.time.stress_rotation,
          .time = state.run.time + state.run.time_step,
          .burn = state.setup.burn.settings(state.setup.domain.cell_size)};
}

HeatingViscosity heating_viscosity(const State& state) {
  using enum HeatingViscosity;
  if (!state.keeps_losses()) return not_distinguished;
  const bool by_field =
      state.particle_affine_inertia() > 0.0 && state.setup.dissipation.affine_compression > 0.0;
  return by_field ? of_affine_field : whole;
}

namespace {

/// Returns tr C of the listed particles, 1/s.
std::span<const double> affine_divergence(const Particles& particles, std::span<const std::uint32_t> list) {
  thread_local std::vector<double> divergence;
  divergence.resize(std::max(divergence.size(), list.size()));
  for (std::size_t k = 0; k < list.size(); ++k) divergence[k] = particles.affine_velocity[list[k]].trace();
  return std::span(divergence).first(list.size());
}

}  // namespace

std::string book(State& state, const MaterialReport& report, const Material& material,
                 const DescribePoint& describe) {
  state.booked.below_cold_curve += static_cast<double>(report.equation_of_state.below_cold_curve);
  state.booked.at_pressure_floor += static_cast<double>(report.equation_of_state.at_pressure_floor);
  state.booked.plastic_work += report.plastic_work;
  state.booked.dissipation += report.dissipation;
  state.booked.plastic_heat += report.plastic_heat;
  state.booked.material_viscous_heat += report.viscous_heat;
  state.booked.limited_volume_changes += static_cast<double>(report.limited_volume_changes);
  state.booked.limited_densities += static_cast<double>(report.limited_densities);
  state.booked.limited_compressions += static_cast<double>(report.squeezed);
  state.booked.limited_void_steps += static_cast<double>(report.limited_void_steps);
  state.booked.limited_bulking += static_cast<double>(report.limited_bulking);
  if (report.undefined != 0) {
    return describe(report.first_undefined,
                    "the state is not defined (NaN, or a volume that is not positive)");
  }
  if (report.equation_of_state.out_of_range == 0) return {};
  return describe(report.equation_of_state.first,
                  fmt::format("the equation of state of {} is out of range: {}", material.name,
                              report.equation_of_state.bound));
}

void SqueezedPoints::add(std::size_t body, const MaterialReport& report, const DescribePoint& describe) {
  counts_[4 * body] += static_cast<double>(report.squeezed);
  counts_[4 * body + 1] += static_cast<double>(report.points);
  counts_[4 * body + 2] += report.squeezed_mass;
  counts_[4 * body + 3] += report.mass;
  if (report.squeezed == 0 || first_[body]) return;
  first_[body] = [describe, point = report.first_squeezed](const std::string& reason) {
    return describe(point, reason);
  };
}

std::string SqueezedPoints::fault(MPI_Comm communicator,
                                  std::span<const std::shared_ptr<const Material>> materials) {
  parallel::sum(communicator, counts_);
  for (std::size_t b = 0; b < first_.size(); ++b) {
    const double squeezed = counts_[4 * b], points = counts_[4 * b + 1];
    if (!first_[b] || !MaterialReport::is_too_dense(counts_[4 * b + 2], counts_[4 * b + 3])) continue;
    const Material& material = *materials[b];
    const std::string products =
        material.burns()
            ? fmt::format(" (its products: {:.6g})", material.burning_explosive().products->maximum_density())
            : "";
    return first_[b](
        fmt::format("the equation of state of {} is out of range: {:.0f} of {:.0f} points would be denser "
                    "than the {:.6g} "
                    "kg/m^3{} at which it ends",
                    material.name, squeezed, points, material.eos->maximum_density(), products));
  }
  return {};
}

MaterialStage::MaterialStage(State& state, const Activity& activity) : state_(state), activity_(activity) {}

void MaterialStage::begin(Energy energy, std::size_t stretches) {
  energy_ = energy;
  of_body_.clear();
  if (state_.grid.has_two_levels()) lengths_.resize(state_.particles.size());
  for (std::size_t b = 0; b < state_.bodies.size(); ++b) {
    UpdateSettings settings = update_settings(state_, b);
    settings.heating = heating_viscosity(state_);
    settings.lengths = lengths_;
    of_body_.push_back({.settings = settings, .deforms_domains = domains::follow_deformation(state_, b)});
  }
  sums_ = {};
  sums_.reports.resize(state_.bodies.size());
  sums_.plastic_work.resize(stretches);
}

void MaterialStage::update(const transfer::Stretch& stretch) {
  // The reference kernels process single points only.
  const std::size_t size = stretch.particles.size(), batch = kernel_set() == KernelSet::plain ? 1 : size;
  double plastic_work = 0.0;
  for (std::size_t first = 0; first < size; first += batch) {
    plastic_work += update(stretch.particles.subspan(first, batch), stretch.gradients.subspan(first, batch));
  }
  sums_.plastic_work[stretch.number] = plastic_work;
}

/// Updates the material of a list of particles, body by body.
/// @returns their plastic work (J), which is not part of the reports, since threads add to these in any order
double MaterialStage::update(std::span<const std::uint32_t> particles, std::span<const Matrix3> gradients) {
  const Clock::time_point begin = Clock::now();
  std::size_t limited = 0, held = 0;
  double plastic_work = 0.0;
  for (std::size_t first = 0, end = 0; first < particles.size(); first = end) {
    const std::uint32_t body = state_.particles.body[particles[first]];
    for (end = first + 1; end < particles.size() && state_.particles.body[particles[end]] == body;) ++end;
    const auto list = particles.subspan(first, end - first);
    const auto of_list = gradients.subspan(first, end - first);
    const Material& material = *state_.setup.materials[body];
    const bool deforms_domains = of_body_[body].deforms_domains;
    if (deforms_domains) limited += domains::deform(state_, list, of_list);
    UpdateSettings settings = of_body_[body].settings;
    if (!lengths_.empty()) {
      for (const std::uint32_t p : list) lengths_[p] = state_.cell_size_at(p);
    }
    if (settings.heating == HeatingViscosity::of_affine_field) {
      settings.affine_divergence = affine_divergence(state_.particles, list);
    }
    MaterialReport report =
        energy_ == Energy::by_work_identity
            ? whipple::update_material(material, state_.particles, list, of_list, settings)
            : update_material_and_energy(material, state_.particles, list, of_list, settings);
    // Only the work identity accounts for the work of a stress that the constitutive model did not compute.
    if (deforms_domains && energy_ == Energy::by_work_identity) {
      held += domains::hold_back_pressure(state_.particles, list, state_, body);
    }
    plastic_work += std::exchange(report.plastic_work, 0.0);
    const Irreversible irreversible = {list.front(), std::exchange(report.dissipation, 0.0),
                                       std::exchange(report.plastic_heat, 0.0),
                                       std::exchange(report.viscous_heat, 0.0)};
    const std::lock_guard lock(mutex_);
    sums_.reports[body].merge(report);
    if (irreversible.dissipation != 0.0 || irreversible.plastic_heat != 0.0) {
      sums_.irreversible.push_back(irreversible);
    }
  }
  const std::lock_guard lock(mutex_);
  sums_.limited_domains += limited;
  sums_.held_pressures += held;
  sums_.in_material += Clock::now() - begin;
  return plastic_work;
}

void MaterialStage::end(std::string_view stage) {
  const std::vector<std::uint32_t>& flying = activity_.flying();
  parallel::for_each_chunk(flying.size(), [&](std::size_t begin, std::size_t end) {
    const std::vector<Matrix3> none(end - begin, Matrix3::Zero());
    update(std::span(flying).subspan(begin, end - begin), none);  // no strain, hence no plastic work
  });
  const std::string error = account();
  state_.profile.reassign(stage, "material",
                          std::chrono::duration<double>(sums_.in_material).count() / parallel::threads());
  parallel::throw_together(state_.communicator, error);
}

/// Adds the sums of an update to the contributions of the step. Collective.
/// @returns an error that ends the run, or nothing
std::string MaterialStage::account() {
  state_.booked.plastic_work += std::accumulate(sums_.plastic_work.begin(), sums_.plastic_work.end(), 0.0);
  state_.booked.limited_domains += static_cast<double>(sums_.limited_domains);
  state_.booked.held_pressures += static_cast<double>(sums_.held_pressures);
  // Sorted, the sums are independent of the order of the threads.
  std::ranges::sort(sums_.irreversible, {}, &Irreversible::first);
  for (const Irreversible& list : sums_.irreversible) {
    state_.booked.dissipation += list.dissipation;
    state_.booked.plastic_heat += list.plastic_heat;
    state_.booked.material_viscous_heat += list.viscous_heat;
  }
  SqueezedPoints squeezed(state_.bodies.size());
  const auto describe = [&](std::size_t p, const std::string& reason) {
    return state_.describe_particle(p, state_.run.time + state_.run.time_step, reason);
  };
  std::string error;
  for (std::size_t b = 0; b < state_.bodies.size(); ++b) {
    const MaterialReport& report = sums_.reports[b];
    state_.rates.compression = std::max(state_.rates.compression, report.compression_rate);
    const std::string of_body = book(state_, report, *state_.setup.materials[b], describe);
    if (error.empty()) error = of_body;
    squeezed.add(b, report, describe);
  }
  const std::string too_dense = squeezed.fault(state_.communicator, state_.setup.materials);
  return error.empty() ? too_dense : error;
}

}  // namespace whipple::solver
