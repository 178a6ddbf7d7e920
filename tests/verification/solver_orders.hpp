// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "src/transfer/shape_function.hpp"
#include "tests/verification/exact_motions.hpp"

/// Errors of the exact motions and their orders of convergence. docs/theory/mpm.md, section 7.5.
namespace whipple::verification {

/// Returns a case with a grid of n cells and one body that fills it.
inline cases::Case motion_case(const ExactMotion& motion, const Method& method, int n,
                               const std::string& discretization = {}) {
  const double dx = 1.0 / n;
  char text[2048];
  const bool plane = motion.dimensions() == 2;
  std::snprintf(text, sizeof text, R"(
[output]
maximum_energy_error = 1e9
[domain]
lower = [0, 0, 0]
upper = [1, %.17g, %.17g]
cell_size = %.17g
boundary = { x_lower = "symmetry", x_upper = "symmetry", y_lower = "symmetry", y_upper = "symmetry", z_lower = "symmetry", z_upper = "symmetry" }
[[body]]
name = "body"
material = "%s"
shape = { box = { lower = [0, 0, 0], upper = [1, %.17g, %.17g] } }
%s)",
                plane ? 1.0 : dx, dx, dx, barotropic_material(motion.solid()).c_str(), plane ? 1.0 : dx, dx,
                discretization.c_str());
  Method chosen = method;
  chosen.courant = chosen.first_step = 1.0;  // the caller sets the time step
  chosen.linear_viscosity = chosen.quadratic_viscosity = 0;
  return cases::read_case_text(chosen.time_toml(motion.end()) + chosen.toml() + text, "motion.toml");
}

/// Returns the number of steps of a run on n cells.
inline long motion_steps(const ExactMotion& motion, int n) {
  return static_cast<long>(std::ceil(motion.end() * motion.largest_speed() * n / 0.4));
}

/// Returns the relative error (rms over the mass) of velocity and displacement of a motion on a grid of n cells.
inline double motion_error(const ExactMotion& motion, const Method& method, int n) {
  const double dx = 1.0 / n;
  const cases::Case setup = motion_case(motion, method, n);
  const long steps = motion_steps(motion, n);
  const double dt = motion.end() / static_cast<double>(steps);
  // Velocities are half a step before the positions (leapfrog); with stresses updated first, stresses a whole step.
  const double stress_time = method.scheme == "usf" ? -dt : 0.0;
  Particles particles = cases::seed(setup).particles;
  std::vector<Vector3> start(particles.size());
  for (std::size_t p = 0; p < particles.size(); ++p) {
    const Vector3 X = start[particles.id[p]] = particles.position[p];
    const Vector3 f = motion.stretch(X, stress_time);
    const double j = f.prod();
    const Vector3 s = 2 * Barotropic::shear * (f.array().log() - std::log(j) / 3);
    particles.volume[p] *= j;
    particles.pressure[p] = Barotropic::pressure(j);
    if (motion.solid()) particles.deviatoric_stress[p] = {s[0], s[1], s[2], 0, 0, 0};
    const Vector3 half = std::sqrt(particles.extent[p].xx) * motion.stretch(X, 0);
    particles.extent[p] = {half[0] * half[0], half[1] * half[1], half[2] * half[2], 0, 0, 0};
    particles.position[p] = motion.position(X, 0);
    particles.velocity[p] = motion.velocity(X, -0.5 * dt);
    const Vector3 rate =
        (motion.stretch(X, 0) - motion.stretch(X, -dt)).cwiseQuotient(dt * motion.stretch(X, -0.5 * dt));
    const bool affine = method.particle_update == "relaxed_affine" || method.particle_update == "apic";
    particles.affine_velocity[p] = affine ? Matrix3(rate.asDiagonal()) : Matrix3::Zero();
  }
  solver::RunState state;
  state.ledger.initial =
      solver::totals_of(particles, transfer::affine_inertia(setup.transfer.shape_function, dx));
  solver::Simulation simulation(setup, std::move(particles), state, parallel::world());
  if (const auto acceleration = motion.acceleration()) {
    simulation.add_load(
        {.name = "manufactured",
         .add = [&start, acceleration](const solver::LoadedPoints& points, double t, std::span<Vector3> sum) {
           for (std::size_t p = 0; p < sum.size(); ++p) sum[p] += acceleration(start[points.id[p]], t);
         }});
  }
  for (long i = 1; i <= steps; ++i) simulation.advance(static_cast<double>(i) * dt);

  const Particles& q = simulation.particles();
  double sum = 0;
  for (std::size_t p = 0; p < q.size(); ++p) {
    const Vector3& X = start[q.id[p]];
    const Vector3 v = q.velocity[p] - motion.velocity(X, motion.end() - 0.5 * dt);
    const Vector3 u = motion.frequency() * (q.position[p] - motion.position(X, motion.end()));
    sum += (v.squaredNorm() + u.squaredNorm()) / static_cast<double>(q.size());
  }
  return std::sqrt(sum) / motion.velocity_scale();
}

/// Returns the order between two resolutions that differ by a factor of two.
inline double order_of(double coarse, double fine) { return std::log2(coarse / fine); }

}  // namespace whipple::verification
