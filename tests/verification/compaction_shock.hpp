// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "src/material/material.hpp"
#include "src/material/update.hpp"

/// Reference of the compaction shock in foam: one-dimensional, with zones that move with the material.
namespace whipple::verification {

/// Block of unit area that is thrown on a rigid wall.
struct ThrownBlock {
  double length = 0.1;             ///< m
  double speed = 100.0;            ///< m/s
  double end = 500e-6;             ///< s
  double half = 100e-6;            ///< s, when `momentum` is taken
  double linear_viscosity = 0.02;  ///< c1 of the artificial viscosity; c2 = 1
};

/// What both methods find, and the locking formula predicts.
struct ThrownBlockResult {
  double length = 0.0;    ///< m, between the wall and the last per cent of the mass, at the end
  double momentum = 0.0;  ///< share of the initial momentum that is left at `half`
  double energy_error = 0.0;
};

/// Returns the motion of a block that is rigid before the front and locked behind it (docs/theory/foam.md, eq. 4).
/// @param plateau  sigma_p, Pa
/// @param density  of the foam, kg/m^3
/// @param locking  strain behind the front, 1 - density/(density of the solid)
inline ThrownBlockResult locking_block(const ThrownBlock& block, double plateau, double density,
                                       double locking) {
  const double stop =
      1.0 - std::exp(-density * block.speed * block.speed / (2.0 * plateau * locking));  // X_f/L
  ThrownBlockResult result;
  result.length = block.length * (1.0 - locking * stop - 0.01);  // the last per cent is not crushed
  const auto speed = [&](double x) {
    return std::sqrt(std::max(0.0, block.speed * block.speed +
                                       2.0 * plateau * locking / density * std::log(1.0 - x / block.length)));
  };
  // dX/dt = v/eps by the midpoint rule
  const int steps = 20000;
  const double dt = block.half / steps;
  double x = 0.0;
  for (int n = 0; n < steps; ++n) {
    const double middle = x + 0.5 * dt * speed(x) / locking;
    x = std::min(x + dt * speed(middle) / locking, stop * block.length);
  }
  result.momentum = (1.0 - x / block.length) * speed(x) / block.speed;
  return result;
}

/// Throws the block in zones. Staggered in space; the energy of a zone changes by the work of its old stress on the mean
/// of the velocities before and after, so that the total energy is exact; the stress is that of `update_material`.
inline ThrownBlockResult throw_in_zones(const Material& material, const ThrownBlock& block,
                                        std::size_t zones) {
  const double density = body_density(material, material.reference);
  const double width = block.length / static_cast<double>(zones);
  MaterialPoints points;
  resize(points, zones);
  std::ranges::fill(points.mass, density * width);
  initialise(material, points, 0, zones);
  std::vector<double> x(zones + 1), u(zones + 1, -block.speed), before, lengths(zones),
      node_mass(zones + 1, density * width);
  for (std::size_t i = 0; i <= zones; ++i) x[i] = width * static_cast<double>(i);
  node_mass.front() = node_mass.back() = 0.5 * density * width;
  u[0] = 0.0;
  std::vector<Matrix3> gradient(zones, Matrix3::Zero());
  std::vector<double> stress(zones);
  const auto energy = [&] {
    double sum = 0.0;
    for (std::size_t i = 0; i <= zones; ++i) sum += 0.5 * node_mass[i] * u[i] * u[i];
    for (std::size_t i = 0; i < zones; ++i) sum += points.mass[i] * points.specific_internal_energy[i];
    return sum;
  };
  const auto momentum = [&] {
    double sum = 0.0;
    for (std::size_t i = 0; i <= zones; ++i) sum -= node_mass[i] * u[i];
    return sum / (density * block.length * block.speed);
  };
  const double start = energy();
  ThrownBlockResult result;
  for (double now = 0.0; now < block.end;) {
    const double next = now < block.half ? block.half : block.end;
    double dt = next - now;
    for (std::size_t i = 0; i < zones; ++i) {
      lengths[i] = x[i + 1] - x[i];
      stress[i] =
          points.deviatoric_stress[i].matrix()(0, 0) - points.pressure[i] - points.artificial_viscosity[i];
      dt = std::min(dt, 0.3 * lengths[i] / (points.sound_speed[i] + 2.0 * std::abs(u[i + 1] - u[i])));
    }
    before = u;
    for (std::size_t i = 1; i <= zones; ++i) {
      const double beyond = i < zones ? stress[i] : 0.0;
      u[i] += dt * (beyond - stress[i - 1]) / node_mass[i];
    }
    for (std::size_t i = 0; i < zones; ++i) {
      const double mean = 0.5 * (u[i + 1] + before[i + 1] - u[i] - before[i]);
      points.specific_internal_energy[i] += dt * stress[i] * mean / points.mass[i];
      gradient[i](0, 0) = (u[i + 1] - u[i]) / lengths[i];
    }
    for (std::size_t i = 1; i <= zones; ++i) x[i] += dt * u[i];
    update_material(material, points, 0, zones, gradient,
                    {.time_step = dt,
                     .lengths = lengths,
                     .linear_viscosity = block.linear_viscosity,
                     .quadratic_viscosity = 1.0});
    now = dt == next - now ? next : now + dt;
    if (now == block.half) result.momentum = momentum();
  }
  // place beyond which a hundredth of the mass is
  const double node = 0.99 * static_cast<double>(zones);
  const auto below = static_cast<std::size_t>(node);
  result.length = x[below] + (node - static_cast<double>(below)) * (x[std::min(below + 1, zones)] - x[below]);
  result.energy_error = (energy() - start) / start;
  return result;
}

}  // namespace whipple::verification
