// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/ledger.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "src/core/base/vector_math.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/solver/accounts.hpp"

namespace whipple::solver {

Totals totals_of(const Particles& particles, std::size_t p, const AffineInertia& of_field) {
  const double affine_inertia = of_field.at(particles.position[p]);
  const double m = particles.mass[p];
  const Vector3& v = particles.velocity[p];
  const double speed2 = v.squaredNorm();
  const bool is_affine = affine_inertia > 0.0;
  const double affine = is_affine ? particles.affine_velocity[p].squaredNorm() : 0.0;
  Vector3 per_mass = particles.position[p].cross(v);
  if (is_affine) per_mass += affine_inertia * rotation_of(particles.affine_velocity[p]);
  return {
      .mass = m,
      .momentum = m * v,
      .momentum_scale = m * std::sqrt(speed2),
      .angular_momentum = m * per_mass,
      .kinetic_energy = 0.5 * m * speed2,
      .affine_kinetic_energy = 0.5 * m * affine_inertia * affine,
      .internal_energy = m * particles.specific_internal_energy[p],
      .unresolved_energy = particles.unresolved_energy.empty() ? 0.0 : m * particles.unresolved_energy[p]};
}

namespace {

/// Holds sums over affine fields: of m |C|^2, and of the mass times twice the axial vector.
struct AffineSum {
  double square = 0.0;
  Vector3 rotation = Vector3::Zero();
};

/// Sums the affine fields of a range of particles one after the other, in a few registers.
AffineSum affine_sum(const Particles& particles, std::size_t begin, std::size_t end,
                     const AffineInertia& of_field) {
  Lanes sum{};
  double rest = 0.0;
  Vector3 rotation = Vector3::Zero();
  for (std::size_t p = begin; p < end; ++p) {
    const double m = particles.mass[p] * of_field.relative(particles.position[p]);
    const double* c = particles.affine_velocity[p].data();
    const Lanes first = load(c), second = load(c + 4);
    sum += m * (first * first + second * second);
    rest += m * c[8] * c[8];
    rotation += m * rotation_of(particles.affine_velocity[p]);
  }
  return {sum4(sum) + rest, rotation};
}

/// Sums the totals of a range of particles, four at a time.
Totals totals_of_range(const Particles& particles, std::size_t begin, std::size_t end,
                       const AffineInertia& of_field) {
  Lanes mass{}, x{}, y{}, z{}, scale{}, twice_kinetic{}, internal{};
  Lanes about_x{}, about_y{}, about_z{};
  std::size_t p = begin;
  for (; p + 4 <= end; p += 4) {
    const Lanes m = load(&particles.mass[p]);
    const Triple<Lanes> v = load_vectors(particles.velocity[p].data());
    const Lanes speed2 = v.x * v.x + v.y * v.y + v.z * v.z;
    mass += m;
    x += m * v.x;
    y += m * v.y;
    z += m * v.z;
    const Triple<Lanes> at = load_vectors(particles.position[p].data());
    about_x += m * (at.y * v.z - at.z * v.y);
    about_y += m * (at.z * v.x - at.x * v.z);
    about_z += m * (at.x * v.y - at.y * v.x);
    scale += m * sqrt(speed2);
    twice_kinetic += m * speed2;
    internal += m * load(&particles.specific_internal_energy[p]);
  }
  Totals sum = {.mass = sum4(mass),
                .momentum = Vector3(sum4(x), sum4(y), sum4(z)),
                .momentum_scale = sum4(scale),
                .angular_momentum = Vector3(sum4(about_x), sum4(about_y), sum4(about_z)),
                .kinetic_energy = 0.5 * sum4(twice_kinetic),
                .internal_energy = sum4(internal)};
  for (; p < end; ++p) sum += totals_of(particles, p, 0.0);
  if (!particles.unresolved_energy.empty()) {
    Lanes unresolved{};  // of those before `p`, four at a time
    for (std::size_t i = begin; i + 4 <= end; i += 4) {
      unresolved += load(&particles.mass[i]) * load(&particles.unresolved_energy[i]);
    }
    sum.unresolved_energy += sum4(unresolved);
  }
  if (const double affine_inertia = of_field.of_fine(); affine_inertia > 0.0) {
    const AffineSum fields = affine_sum(particles, begin, end, of_field);
    sum.affine_kinetic_energy = 0.5 * affine_inertia * fields.square;
    sum.angular_momentum += affine_inertia * fields.rotation;
  }
  return sum;
}

}  // namespace

Totals totals_of(const Particles& particles, const AffineInertia& of_field, std::vector<Totals>& of_chunk,
                 std::span<const std::uint8_t> stays) {
  parallel::update_chunks(
      particles.size(), of_chunk, [&](std::size_t chunk) { return stays[chunk] != 0; },
      [&](std::size_t begin, std::size_t end) { return totals_of_range(particles, begin, end, of_field); });
  Totals sum;
  for (const Totals& part : of_chunk) sum += part;
  return sum;
}

Totals totals_of(const Particles& particles, const AffineInertia& of_field) {
  std::vector<Totals> of_chunk;
  const std::vector<std::uint8_t> none(parallel::chunk_count(particles.size()), 0);
  return totals_of(particles, of_field, of_chunk, none);
}

void Ledger::add(const Ledger& step) {
  outflow += step.outflow;
  retired += step.retired;
  wall_impulse += step.wall_impulse;
  external_impulse += step.external_impulse;
  for (const Account& account : accounts) this->*account.sum += step.*account.sum;
}

namespace {

double moving_energy(const Totals& totals) {
  return totals.kinetic_energy + totals.affine_kinetic_energy + totals.unresolved_energy +
         totals.hourglass_energy;
}

// The round-off of an internal energy at rest is no error of the small energy that such a run exchanges.
constexpr double round_off_of_internal_energy = 1e-10;

}  // namespace

void Ledger::observe(const Totals& now) {
  largest_kinetic_energy = std::max(largest_kinetic_energy, moving_energy(now) + moving_energy(outflow));
  largest_heating = std::max(
      largest_heating, std::abs(now.internal_energy + outflow.internal_energy - initial.internal_energy));
  largest_momentum = std::max(largest_momentum, now.momentum_scale + outflow.momentum_scale);
}

double Ledger::energy_error(const Totals& now) const {
  Ledger so_far = *this;
  so_far.observe(now);
  const double scale = std::max(
      std::max(so_far.largest_kinetic_energy, moving_energy(initial)) + so_far.largest_heating +
          std::abs(external_work) + std::abs(damping_work),
      round_off_of_internal_energy * (std::abs(initial.internal_energy) + std::abs(now.internal_energy)));
  return (now.energy() + outflow.energy() - initial.energy() - external_work - damping_work) /
         std::max(scale, 1e-300);
}

double Ledger::momentum_error(const Totals& now) const {
  const Vector3 error = now.momentum + outflow.momentum - wall_impulse - external_impulse - initial.momentum;
  const double scale =
      std::max({largest_momentum, initial.momentum_scale, now.momentum_scale + outflow.momentum_scale}) +
      external_impulse.norm();
  return error.norm() / std::max(scale, 1e-300);
}

}  // namespace whipple::solver
