// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "src/base/error.hpp"
#include "src/base/vector_math.hpp"
#include "src/fem/step.hpp"
#include "src/parallel/threads.hpp"

namespace whipple::fem {

namespace {

/// Inverse of the bound of the stable time step of a Gauss point's element, 1/s.
double rate_at(const GaussPoints& points, std::size_t i, const ViscosityCoefficients& viscosity) {
  const double c = points.sound_speed[i], length = points.length[i];
  const double density = points.mass[i] / points.volume[i];
  // q/(l |D|) rho from q itself (eq. 5.3), with the linear part whether the element closes or not
  const double linear = viscosity.linear * c;
  const double speed =
      0.5 *
      (linear + std::sqrt(linear * linear + 4.0 * viscosity.quadratic *
                                                std::fmax(points.artificial_viscosity[i], 0.0) / density));
  const double xi = std::sqrt(3.0) * speed / c;
  // 1/(sqrt(1 + xi^2) - xi) = sqrt(1 + xi^2) + xi
  return std::sqrt(3.0) * c / length * (std::sqrt(1.0 + xi * xi) + xi);
}

}  // namespace

double critical_time_step(const Mesh& mesh, const ViscosityCoefficients& viscosity) {
  const GaussPoints& points = mesh.points;
  const std::size_t n = points.size();
  // The greatest of 1/dt: an infinite time step without elements. 1/(sqrt(1 + xi^2) - xi) = sqrt(1 + xi^2) +
  // xi.
  const double rate = parallel::maximum((n + 3) / 4, 0.0, [&](std::size_t group) {
    const std::size_t i = 4 * group, count = std::min<std::size_t>(4, n - i);
    const auto load4 = [&](const std::vector<double>& v) { return load(&v[i], count, v[i]); };
    const Lanes c = load4(points.sound_speed), linear = viscosity.linear * c;
    // q/(rho l |D|) from q itself, with the linear part whether the element closes or not (eq. 5.3)
    const Lanes q = load4(points.artificial_viscosity) * load4(points.volume) / load4(points.mass);
    const Lanes closing = q > 0.0 ? q : Lanes{};
    const Lanes speed = 0.5 * (linear + sqrt(linear * linear + (4.0 * viscosity.quadratic) * closing));
    const Lanes rates = (sqrt(3.0 * (c * c + 3.0 * speed * speed)) + 3.0 * speed) / load4(points.length);
    return std::max(std::max(rates[0], rates[1]), std::max(rates[2], rates[3]));
  });
  return 1.0 / rate;
}

double critical_time_step(const Mesh& mesh, std::size_t element, const ViscosityCoefficients& viscosity) {
  const std::size_t n = points_per_element(mesh.quadrature);
  double rate = 0.0;
  for (std::size_t i = n * element; i < n * (element + 1); ++i) {
    rate = std::max(rate, rate_at(mesh.points, i, viscosity));
  }
  return 1.0 / rate;
}

ConstraintBalance& ConstraintBalance::operator+=(const ConstraintBalance& other) {
  impulse += other.impulse;
  work += other.work;
  return *this;
}

namespace {

/// From the velocity before to that after the forces.
void advance_to(Nodes& nodes, std::size_t a, Lanes after, Motion& motion, ConstraintBalance& balance) {
  const Lanes before = load_vector(nodes.velocity[a].data());
  if (nodes.constrained[a] != constraint::none) {
    for (int i = 0; i < 3; ++i) {
      if ((nodes.constrained[a] & constraint::axis(i)) == 0) continue;
      const double impulse = nodes.mass[a] * (nodes.prescribed[a][i] - after[i]);
      after[i] = nodes.prescribed[a][i];
      balance.impulse[i] += impulse;
      balance.work += impulse * 0.5 * (before[i] + after[i]);
    }
  }
  store_vector(nodes.velocity[a].data(), after);
  store_vector(motion.mean[a].data(), 0.5 * (before + after));
  store_vector(motion.end[a].data(), after);
}

}  // namespace

ConstraintBalance advance_velocities(Nodes& nodes, double dt, Motion& motion,
                                     std::span<const std::uint8_t> elsewhere) {
  motion.mean.resize(nodes.size());
  motion.end.resize(nodes.size());
  return parallel::sum_of_chunks<ConstraintBalance>(nodes.size(), [&](std::size_t begin, std::size_t end) {
    ConstraintBalance balance;
    for (std::size_t a = begin; a < end; ++a) {
      if (!elsewhere.empty() && elsewhere[a] != 0) continue;
      const Lanes velocity = load_vector(nodes.velocity[a].data()),
                  force = load_vector(nodes.force[a].data());
      advance_to(nodes, a, velocity + dt / nodes.mass[a] * force, motion, balance);
    }
    return balance;
  });
}

ConstraintBalance advance_velocity(Nodes& nodes, std::size_t node, const Vector3& acceleration, double dt,
                                   Motion& motion) {
  ConstraintBalance balance;
  const Lanes velocity = load_vector(nodes.velocity[node].data());
  advance_to(nodes, node, velocity + dt * load_vector(acceleration.data()), motion, balance);
  return balance;
}

void move_nodes(Nodes& nodes, const Motion& motion, double dt) {
  parallel::for_each(nodes.size(), [&](std::size_t a) { nodes.position[a] += dt * motion.end[a]; });
}

void add_heat(Mesh& mesh, std::span<const double> node_heat) {
  if (node_heat.size() != mesh.nodes.size()) throw InternalError("fem::add_heat: one heat per node");
  const std::size_t n = points_per_element(mesh.quadrature);
  const auto add_to = [&](std::size_t e) {
    double heat = 0.0;  // of the shares of the element in its nodes
    for (std::size_t a = 0; a < 8; ++a) {
      const std::uint32_t node = mesh.elements.corners[e][a];
      if (node_heat[node] != 0.0) heat += node_heat[node] * corner_mass(mesh, e, a) / mesh.nodes.mass[node];
    }
    if (heat == 0.0) return;
    const double per_mass = heat / mass(mesh, e);
    for (std::size_t q = 0; q < n; ++q) mesh.points.specific_internal_energy[n * e + q] += per_mass;
  };
  // Few nodes have heat: those that move with the grid.
  const Blocks& blocks = mesh.blocks;
  parallel::for_each(blocks.first_slot.size() - 1, [&](std::size_t block) {
    const auto nodes =
        std::span(blocks.slot_node)
            .subspan(blocks.first_slot[block], blocks.first_slot[block + 1] - blocks.first_slot[block]);
    if (std::ranges::none_of(nodes, [&](std::uint32_t a) { return node_heat[a] != 0.0; })) return;
    const std::size_t end = std::min((block + 1) * Blocks::size, mesh.elements.size());
    for (std::size_t e = block * Blocks::size; e < end; ++e) add_to(e);
  });
}

}  // namespace whipple::fem
