// SPDX-License-Identifier: BSD-3-Clause
// The constitutive half of the step (docs/theory/material.md), of particles and of elements.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <utility>
#include <vector>

#include "src/material/update.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::solver {

UpdateSettings Simulation::update_settings(std::size_t body) const {
  const cases::ArtificialViscosity& viscosity = setup_.viscosity_of(body);
  return {.time_step = state_.time_step,
          .cell_size = setup_.domain.cell_size,
          .linear_viscosity = viscosity.linear,
          .quadratic_viscosity = viscosity.quadratic,
          .expansion_viscosity = viscosity.expansion,
          .affine_gain = setup_.dissipation.affine_gain,
          .affine_compression = setup_.dissipation.affine_compression,
          .initial_density = initial_density_[body],
          .rotation = setup_.time.stress_rotation,
          .time = state_.time + state_.time_step};
}

namespace {

/// tr C of the particles of a list, 1/s.
std::span<const double> affine_divergence(const Particles& particles, std::span<const std::uint32_t> list) {
  thread_local std::vector<double> divergence;
  divergence.resize(std::max(divergence.size(), list.size()));
  for (std::size_t k = 0; k < list.size(); ++k) divergence[k] = particles.affine_velocity[list[k]].trace();
  return std::span(divergence).first(list.size());
}

}  // namespace

/// Counts what an update met. @returns an error that ends the run, or nothing; `describe` tells of its point
std::string Simulation::book(const MaterialReport& report, const Material& material,
                             const std::function<std::string(std::size_t, const std::string&)>& describe) {
  step_.clamped_to_cold_curve += static_cast<double>(report.equation_of_state.below_cold_curve);
  step_.held_at_pressure_floor += static_cast<double>(report.equation_of_state.at_pressure_floor);
  step_.plastic_work += report.plastic_work;
  step_.limited_volume_changes += static_cast<double>(report.limited_volume_changes);
  step_.limited_densities += static_cast<double>(report.limited_densities);
  step_.limited_void_steps += static_cast<double>(report.limited_void_steps);
  step_.limited_bulking += static_cast<double>(report.limited_bulking);
  if (report.undefined != 0) {
    return describe(report.first_undefined,
                    "the state is not defined (NaN, or a volume that is not positive)");
  }
  if (report.equation_of_state.out_of_range == 0) return {};
  return describe(report.equation_of_state.first,
                  fmt::format("the equation of state of {} is out of range: {}", material.name,
                              report.equation_of_state.bound));
}

/// The material of all particles, each as soon as it has its velocity gradient.
/// @param stage   what the time of the gather belongs to
/// @param gather  gather(take) hands the gradients on
void Simulation::update_material_with(std::string_view stage, EnergyUpdate energy,
                                      const std::function<void(const transfer::TakeGradients&)>& gather) {
  using Clock = std::chrono::steady_clock;
  std::vector<UpdateSettings> settings;
  for (std::size_t b = 0; b < bodies_.size(); ++b) settings.push_back(update_settings(b));
  std::vector<MaterialReport> reports(bodies_.size());
  std::size_t limited_domains = 0;
  Clock::duration in_material{};  // of all threads
  std::mutex mutex;
  const bool has_affine_field = losses_.kept && particle_affine_inertia() > 0.0;
  const auto take = [&](std::span<const std::uint32_t> particles,
                        std::span<const Matrix3> gradients) -> double {
    const Clock::time_point begin = Clock::now();
    const std::size_t limited = follows_domains() ? deform_domains(particles, gradients) : 0;
    double plastic_work = 0.0;  // apart from the report, which other threads add to in any order
    for (std::size_t first = 0, end = 0; first < particles.size(); first = end) {
      const std::uint32_t body = particles_.body[particles[first]];
      for (end = first + 1; end < particles.size() && particles_.body[particles[end]] == body;) ++end;
      const auto list = particles.subspan(first, end - first);
      const auto of_list = gradients.subspan(first, end - first);
      const Material& material = *setup_.materials[body];
      UpdateSettings of_body = settings[body];
      if (has_affine_field) of_body.affine_divergence = affine_divergence(particles_, list);
      MaterialReport report = energy == EnergyUpdate::by_work_identity
                                  ? whipple::update_material(material, particles_, list, of_list, of_body)
                                  : update_material_and_energy(material, particles_, list, of_list, of_body);
      plastic_work += std::exchange(report.plastic_work, 0.0);
      const std::lock_guard lock(mutex);
      reports[body].merge(report);
    }
    const std::lock_guard lock(mutex);
    limited_domains += limited;
    in_material += Clock::now() - begin;
    return plastic_work;
  };
  std::string error;
  profile_.time(stage, [&] {
    gather(take);
    parallel::for_each_chunk(flying_.size(), [&](std::size_t begin, std::size_t end) {
      const std::vector<Matrix3> none(end - begin, Matrix3::Zero());
      take(std::span(flying_).subspan(begin, end - begin), none);  // without strain, so without plastic work
    });
    step_.limited_domains += static_cast<double>(limited_domains);
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      compression_rate_ = std::max(compression_rate_, reports[b].compression_rate);
      const std::string of_body =
          book(reports[b], *setup_.materials[b], [&](std::size_t p, const std::string& reason) {
            return describe_state(p, state_.time + state_.time_step, reason);
          });
      if (error.empty()) error = of_body;
    }
  });
  profile_.reassign(stage, "material",
                    std::chrono::duration<double>(in_material).count() / parallel::threads());
  parallel::throw_together(communicator_, error);
}

}  // namespace whipple::solver
