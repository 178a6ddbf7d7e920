// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/ledger.hpp"

#include <algorithm>
#include <cmath>

#include "src/base/vector_math.hpp"
#include "src/io/output_fields.hpp"
#include "src/parallel/threads.hpp"

namespace whipple::solver {

Totals& Totals::operator+=(const Totals& other) {
  mass += other.mass;
  momentum += other.momentum;
  momentum_scale += other.momentum_scale;
  kinetic_energy += other.kinetic_energy;
  affine_kinetic_energy += other.affine_kinetic_energy;
  internal_energy += other.internal_energy;
  return *this;
}

Totals totals_of(const Particles& particles, std::size_t p, double affine_inertia) {
  const double m = particles.mass[p];
  const Vector3& v = particles.velocity[p];
  const double speed2 = v.squaredNorm();
  return {.mass = m,
          .momentum = m * v,
          .momentum_scale = m * std::sqrt(speed2),
          .kinetic_energy = 0.5 * m * speed2,
          .affine_kinetic_energy = 0.5 * m * affine_inertia * particles.affine_velocity[p].squaredNorm(),
          .internal_energy = m * particles.specific_internal_energy[p]};
}

namespace {

/// Sums of particles one after the other, in a few registers.
Totals totals_of_range(const Particles& particles, std::size_t begin, std::size_t end,
                       double affine_inertia) {
  Lanes momentum{}, affine{};
  double mass = 0.0, scale = 0.0, twice_kinetic = 0.0, internal = 0.0, affine_rest = 0.0;
  for (std::size_t p = begin; p < end; ++p) {
    const double m = particles.mass[p];
    const Lanes v = load_vector(particles.velocity[p].data());
    const double speed2 = sum3(v * v);
    mass += m;
    momentum += m * v;
    scale += m * std::sqrt(speed2);
    twice_kinetic += m * speed2;
    internal += m * particles.specific_internal_energy[p];
    if (affine_inertia == 0.0) continue;
    const double* c = particles.affine_velocity[p].data();
    const Lanes first = load(c), second = load(c + 4);
    affine += m * (first * first + second * second);
    affine_rest += m * c[8] * c[8];
  }
  return {.mass = mass,
          .momentum = Vector3(momentum[0], momentum[1], momentum[2]),
          .momentum_scale = scale,
          .kinetic_energy = 0.5 * twice_kinetic,
          .affine_kinetic_energy = 0.5 * affine_inertia * (sum3(affine) + affine[3] + affine_rest),
          .internal_energy = internal};
}

}  // namespace

Totals totals_of(const Particles& particles, double affine_inertia) {
  return parallel::sum_of_chunks<Totals>(particles.size(), [&](std::size_t begin, std::size_t end) {
    return totals_of_range(particles, begin, end, affine_inertia);
  });
}

void Ledger::add(const Ledger& step) {
  outflow += step.outflow;
  wall_impulse += step.wall_impulse;
  external_impulse += step.external_impulse;
  external_work += step.external_work;
  work += step.work;
  transfer_heat += step.transfer_heat;
  contact_heat += step.contact_heat;
  friction_heat += step.friction_heat;
  contact_impulse += step.contact_impulse;
  friction_impulse += step.friction_impulse;
  clamped_to_cold_curve += step.clamped_to_cold_curve;
  limited_volume_changes += step.limited_volume_changes;
  limited_domains += step.limited_domains;
}

double Ledger::energy_error(const Totals& now) const {
  const double scale = std::abs(initial.kinetic_energy) + std::abs(initial.affine_kinetic_energy) +
                       std::abs(initial.internal_energy);
  return (now.energy() + outflow.energy() - initial.energy() - external_work) / std::max(scale, 1e-300);
}

double Ledger::momentum_error(const Totals& now) const {
  const Vector3 error = now.momentum + outflow.momentum - wall_impulse - external_impulse - initial.momentum;
  return error.norm() / std::max(initial.momentum_scale, 1e-300);
}

PhaseMasses& PhaseMasses::operator+=(const PhaseMasses& other) {
  for (std::size_t i = 0; i < mass.size(); ++i) mass[i] += other.mass[i];
  failed += other.failed;
  return *this;
}

std::vector<PhaseMasses> phase_masses(const Particles& particles, std::size_t bodies) {
  std::vector<PhaseMasses> result(bodies);
  for (std::size_t p = 0; p < particles.size(); ++p) {
    PhaseMasses& of_body = result[particles.body[p]];
    const io::Phase phase = io::phase(particles.melted_fraction[p], particles.vaporised_fraction[p]);
    of_body.mass[static_cast<std::size_t>(phase)] += particles.mass[p];
    if (particles.failed[p] != 0) of_body.failed += particles.mass[p];
  }
  return result;
}

void sum_over_ranks(MPI_Comm communicator, std::vector<PhaseMasses>& by_body) {
  std::vector<double> numbers;
  for (const PhaseMasses& body : by_body) {
    numbers.insert(numbers.end(), body.mass.begin(), body.mass.end());
    numbers.push_back(body.failed);
  }
  parallel::sum(communicator, numbers);
  auto next = numbers.begin();
  for (PhaseMasses& body : by_body) {
    for (double& mass : body.mass) mass = *next++;
    body.failed = *next++;
  }
}

}  // namespace whipple::solver
