// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/state.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "src/transfer/grid_to_particles.hpp"
#include "src/transfer/shape_function.hpp"

namespace whipple::solver {

State::State(const cases::Case& of_run, MPI_Comm of_ranks, const RunState& of_start)
    : setup(of_run),
      shape(of_run.domain.is_planar() ? transfer::in_plane(of_run.transfer.shape_function)
                                      : of_run.transfer.shape_function),
      communicator(of_ranks),
      grid(of_run.geometry, of_ranks),
      bodies(of_run.bodies.size()),
      run(of_start),
      booked_outflow(of_run.bodies.size()),
      force_gauges(of_run) {
  run.gauged.resize(of_run.force_gauges.size());
  run.outflow_of_body.resize(bodies.size());
  run.driven.resize(bodies.size());
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    initial_density.push_back(setup.bodies[b].initial.of(*setup.materials[b]).density);
  }
}

double State::affine_inertia() const { return transfer::affine_inertia(shape, setup.domain.cell_size); }

double State::particle_affine_inertia() const {
  return cases::is_affine(setup.transfer.particle_update) ? affine_inertia() : 0.0;
}

void State::find_bodies() {
  for (std::uint32_t b = 0; b < bodies.size(); ++b) {
    const auto own = std::ranges::equal_range(particles.body, b);
    bodies[b].count = own.size();
    bodies[b].first = own.empty() ? 0 : static_cast<std::size_t>(own.begin() - particles.body.begin());
  }
}

void State::book_outflow(std::size_t body, const Totals& outflow) {
  booked.outflow += outflow;
  booked_outflow[body] += {outflow.mass, outflow.momentum, outflow.energy()};
}

void State::book_outflow(std::size_t body, const Totals& before, Totals after) {
  for_each_number(after, [](const std::string&, double& x) { x = -x; });
  after += before;
  book_outflow(body, after);
}

std::string State::describe_particle(std::size_t p, double time, const std::string& reason) const {
  const Vector3& x = particles.position[p];
  const Vector3& v = particles.velocity[p];
  return fmt::format(
      "step {}, t = {} s, body \"{}\", particle {}: {}\n  position ({}, {}, {}) m, velocity ({}, "
      "{}, {}) m/s\n  density "
      "{} kg/m^3, specific internal energy {} J/kg, pressure {} Pa, temperature {} K, failed {}",
      run.step + 1, time, setup.bodies[particles.body[p]].name, particles.id[p], reason, x[0], x[1], x[2],
      v[0], v[1], v[2], particles.mass[p] / particles.volume[p], particles.specific_internal_energy[p],
      particles.pressure[p], particles.temperature[p], particles.failed[p]);
}

}  // namespace whipple::solver
