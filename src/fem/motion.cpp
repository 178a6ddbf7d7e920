// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "src/core/base/error.hpp"
#include "src/core/base/marks.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/fem/element_kernels/element_registers.hpp"
#include "src/fem/step.hpp"

namespace whipple::fem {

namespace {

/// Returns the inverse of the stable time step bound of the element of a Gauss point, 1/s.
double rate_at(const GaussPoints& points, std::size_t i, const ViscosityCoefficients& viscosity) {
  const double c = points.sound_speed[i], length = points.length[i];
  const double density = points.mass[i] / points.volume[i];
  // q/(l |D|) rho from q (eq. 5.3), with the linear part whether the element is compressed or not
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
  const auto rate_of_chunk = [&](std::size_t chunk) {
    double most = 0.0;
    const std::size_t end = std::min(n, (chunk + 1) * parallel::chunk_size);
    for (std::size_t i = chunk * parallel::chunk_size; i < end; i += 4) {
      const auto load4 = [&](const std::vector<double>& v) {
        return load(&v[i], std::min<std::size_t>(4, end - i), v[i]);
      };
      const Lanes c = load4(points.sound_speed), length = load4(points.length), mass = load4(points.mass);
      const Lanes linear = viscosity.linear * c;
      // q/(rho l |D|) from q, with the linear part whether the element is compressed or not (eq. 5.3)
      const Lanes q = load4(points.artificial_viscosity);
      const Lanes closing = (q > 0.0 ? q : Lanes{}) * load4(points.volume);
      // Most elements are below the maximum rate so far, which can be tested without roots and divisions: with r = most
      // l and the linear and quadratic parts a and b of the viscosity, the rate is smaller if 0 < N = r^2 - 3 c^2 and b
      // q V (6 r)^2 < m N (N - 6 r a).
      const Lanes r = most * length, six_r = 6.0 * r, excess = (1.0 - 1e-12) * r * r - 3.0 * (c * c);
      const LanesMask less = (excess > 0.0) & (viscosity.quadratic * closing * six_r * six_r <
                                               mass * excess * (excess - six_r * linear));
      if (bits(less) == all_lanes) continue;
      const Lanes speed =
          0.5 * (linear + sqrt(linear * linear + (4.0 * viscosity.quadratic) * (closing / mass)));
      const Lanes rates = (sqrt(3.0 * (c * c + 3.0 * speed * speed)) + 3.0 * speed) / length;
      most = std::max({most, rates[0], rates[1], rates[2], rates[3]});
    }
    return most;
  };
  // Maximum of 1/dt: an infinite time step without elements. 1/(sqrt(1 + xi^2) - xi) = sqrt(1 + xi^2) + xi.
  return 1.0 / parallel::maximum(parallel::chunk_count(n), 0.0, rate_of_chunk);
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

/// Advances a node from the velocity before the forces to that after the forces.
void advance_to(Nodes& nodes, std::size_t a, Lanes after, double path, Motion& motion,
                ConstraintBalance& balance) {
  const Lanes before = load_vector(nodes.velocity[a].data());
  if (nodes.constrained[a] != constraint::none) {
    for (int i = 0; i < 3; ++i) {
      if ((nodes.constrained[a] & constraint::axis(i)) == 0) continue;
      const double prescribed = path * nodes.prescribed[a][i];
      const double impulse = nodes.mass[a] * (prescribed - after[i]);
      after[i] = prescribed;
      balance.impulse[i] += impulse;
      balance.work += impulse * 0.5 * (before[i] + after[i]);
    }
  }
  store_vector(nodes.velocity[a].data(), after);
  store_vector(motion.mean[a].data(), 0.5 * (before + after));
  store_vector(motion.end[a].data(), after);
}

}  // namespace

namespace {

/// Implements `advance_to` for four unconstrained nodes, given the accelerations per force dt/m.
void advance_four(Nodes& nodes, std::size_t first, Lanes per_force, Motion& motion) {
  double* const velocity = nodes.velocity[first].data();
  const double* const force = nodes.force[first].data();
  const std::array<Lanes, 3> factor = beside_components(per_force);
  for (std::size_t j = 0; j < 3; ++j) {
    const Lanes before = load(velocity + 4 * j), after = before + factor[j] * load(force + 4 * j);
    store(velocity + 4 * j, after);
    store(motion.mean[first].data() + 4 * j, 0.5 * (before + after));
    store(motion.end[first].data() + 4 * j, after);
  }
}

}  // namespace

ConstraintBalance advance_velocities(Nodes& nodes, double dt, Motion& motion,
                                     std::span<const std::uint8_t> elsewhere, double path) {
  motion.mean.resize(nodes.size());
  motion.end.resize(nodes.size());
  return parallel::sum_of_chunks<ConstraintBalance>(nodes.size(), [&](std::size_t begin, std::size_t end) {
    ConstraintBalance balance;
    for (std::size_t first = begin; first < end; first += 4) {
      const std::size_t count = std::min<std::size_t>(4, end - first);
      const Lanes per_force = dt / load(&nodes.mass[first], count, 1.0);
      if (count == 4 && none_of_four(nodes.constrained, first) &&
          (elsewhere.empty() || none_of_four(elsewhere, first))) {
        advance_four(nodes, first, per_force, motion);
        continue;
      }
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t a = first + k;
        if (!elsewhere.empty() && elsewhere[a] != 0) continue;
        const Lanes velocity = load_vector(nodes.velocity[a].data()),
                    force = load_vector(nodes.force[a].data());
        advance_to(nodes, a, velocity + per_force[k] * force, path, motion, balance);
      }
    }
    return balance;
  });
}

ConstraintBalance advance_velocity(Nodes& nodes, std::size_t node, const Vector3& acceleration, double dt,
                                   Motion& motion, double path) {
  ConstraintBalance balance;
  const Lanes velocity = load_vector(nodes.velocity[node].data());
  advance_to(nodes, node, velocity + dt * load_vector(acceleration.data()), path, motion, balance);
  return balance;
}

void move_nodes(Nodes& nodes, const Motion& motion, double dt) {
  parallel::for_each_chunk(nodes.size(), [&](std::size_t begin, std::size_t end) {
    double* const position = nodes.position[begin].data();
    const double* const velocity = motion.end[begin].data();
    for (std::size_t i = 0; i < 3 * (end - begin); ++i) position[i] = std::fma(dt, velocity[i], position[i]);
  });
}

void add_heat(Mesh& mesh, std::span<const double> node_heat, std::size_t block) {
  const Blocks& blocks = mesh.blocks;
  const auto nodes =
      std::span(blocks.slot_node)
          .subspan(blocks.first_slot[block], blocks.first_slot[block + 1] - blocks.first_slot[block]);
  // Only few nodes have heat: those that move with the grid.
  if (std::ranges::none_of(nodes, [&](std::uint32_t a) { return node_heat[a] != 0.0; })) return;
  const std::size_t n = points_per_element(mesh.quadrature), begin = block * Blocks::size;
  for (std::size_t e = begin; e < std::min(begin + Blocks::size, mesh.elements.size()); ++e) {
    double heat = 0.0;  // of the contributions of the element to its nodes
    for (std::size_t a = 0; a < 8; ++a) {
      const std::uint32_t node = mesh.elements.corners[e][a];
      if (node_heat[node] != 0.0) heat += node_heat[node] * corner_mass(mesh, e, a) / mesh.nodes.mass[node];
    }
    if (heat == 0.0) continue;
    const double per_mass = heat / mass(mesh, e);
    for (std::size_t q = 0; q < n; ++q) mesh.points.specific_internal_energy[n * e + q] += per_mass;
  }
}

void add_heat(Mesh& mesh, std::span<const double> node_heat) {
  if (node_heat.size() != mesh.nodes.size()) throw InternalError("fem::add_heat: one heat per node");
  parallel::for_each(mesh.blocks.count(), [&](std::size_t block) { add_heat(mesh, node_heat, block); });
}

}  // namespace whipple::fem
