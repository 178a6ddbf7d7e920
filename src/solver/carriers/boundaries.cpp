// SPDX-License-Identifier: BSD-3-Clause
// Removal of particles: at the faces of the domain, and products of burnt explosives.
#include <array>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "src/core/base/gaps.hpp"
#include "src/core/base/vector_math.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/solver/carriers/explosives.hpp"
#include "src/solver/carriers/particle_carrier.hpp"

namespace whipple::solver {
namespace {

/// Returns the particles outside of the domain, ascending; inactive chunks are skipped, as they were inside before.
/// Tests four particles at once.
std::vector<std::uint32_t> outside_of(const grid::Geometry& g, std::span<const Vector3> position,
                                      const grid::BlockGrid& grid) {
  const Lanes lower = {g.lower[0], g.lower[1], g.lower[2], 0.0};
  const Lanes upper = {g.upper(0), g.upper(1), g.upper(2), 0.0};
  const auto turned = [](Lanes bound) {  // bounds in the order x y z x, y z x y, z x y z of four positions
    return std::array{Lanes{bound[0], bound[1], bound[2], bound[0]},
                      Lanes{bound[1], bound[2], bound[0], bound[1]},
                      Lanes{bound[2], bound[0], bound[1], bound[2]}};
  };
  const std::array<Lanes, 3> lowers = turned(lower), uppers = turned(upper);
  std::vector<std::vector<std::uint32_t>> found(parallel::chunk_count(position.size()));
  parallel::for_each_chunk(position.size(), [&](std::size_t begin, std::size_t end) {
    if (grid.chunk_rests(begin / parallel::chunk_size)) return;
    const auto look_at = [&](std::size_t p) {
      const Lanes at = load_vector(position[p].data());
      if (bits((at >= lower) & (at <= upper)) == all_lanes) return;
      found[begin / parallel::chunk_size].push_back(static_cast<std::uint32_t>(p));
    };
    std::size_t p = begin;
    for (; p + 4 <= end; p += 4) {
      const double* const from = position[p].data();
      LanesMask inside = (load(from) >= lowers[0]) & (load(from) <= uppers[0]);
      for (std::size_t i = 1; i < 3; ++i) {
        inside &= (load(from + 4 * i) >= lowers[i]) & (load(from + 4 * i) <= uppers[i]);
      }
      if (bits(inside) == all_lanes) continue;
      for (std::size_t k = p; k < p + 4; ++k) look_at(k);
    }
    for (; p < end; ++p) look_at(p);
  });
  std::vector<std::uint32_t> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// Mirrors the tensors of a particle and the vectors and tensors of its material history; velocity and affine field
/// depend on the kind of wall and are not included.
void mirror_tensors(Particles& particles, std::size_t p, const Matrix3& mirror) {
  for_each_field(particles, [&](const auto& field) {
    auto& values = field.of(particles);
    using Value = typename std::decay_t<decltype(values)>::value_type;
    if (values.empty()) return;  // optional, not in use
    if constexpr (std::is_same_v<Value, SymmetricTensor>) {
      values[p] = SymmetricTensor::from(mirror * values[p].matrix() * mirror);
    } else if constexpr (std::is_same_v<std::decay_t<decltype(field)>, HistoryOf<Value>>) {
      if constexpr (std::is_same_v<Value, Matrix3>) values[p] = (mirror * values[p] * mirror).eval();
      if constexpr (std::is_same_v<Value, Vector3>) values[p] = (mirror * values[p]).eval();
    }
  });
}

}  // namespace

/// Reflects particles at mirror planes and walls, and removes those beyond outflow faces.
void ParticleCarrier::remove_outside() {
  const grid::Geometry& g = state_.setup.geometry;
  const std::vector<std::uint32_t> outside = outside_of(g, state_.particles.position, state_.grid);
  std::vector<std::uint32_t> leaving;
  for (const std::uint32_t p : outside) {
    bool leaves = false;
    for (int a = 0; a < 3; ++a) {
      double& x = state_.particles.position[p][a];
      if (x >= g.lower[a] && x <= g.upper(a)) continue;
      const bool low = x < g.lower[a];
      const auto face = static_cast<std::size_t>(2 * a + (low ? 0 : 1));
      const grid::Boundary boundary = g.boundary[face];
      if (boundary == grid::Boundary::outflow) {
        leaves = true;
        continue;
      }
      // The interpolated normal velocity vanishes at a mirror plane, so that a particle crosses it only because of the
      // finite time step: it is replaced by its image.
      x = 2.0 * (low ? g.lower[a] : g.upper(a)) - x;
      Matrix3 mirror = Matrix3::Identity();
      mirror(a, a) = -1.0;
      // At a no-slip wall all components of the image's velocity are reversed, but its position along one axis only.
      const Matrix3 image = boundary == grid::Boundary::no_slip ? Matrix3(-Matrix3::Identity()) : mirror;
      const Vector3 velocity = image * state_.particles.velocity[p];
      const Vector3 impulse = state_.particles.mass[p] * (velocity - state_.particles.velocity[p]);
      state_.booked.wall_impulse += impulse;
      state_.force_gauges.book_point(state_.particles.body[p], face, state_.particles.position[p], impulse);
      state_.particles.velocity[p] = velocity;
      if (state_.carries_affine_fields()) {
        state_.particles.affine_velocity[p] = image * state_.particles.affine_velocity[p] * mirror;
      }
      mirror_tensors(state_.particles, p, mirror);
    }
    if (leaves) leaving.push_back(p);
  }
  remove_as_outflow(leaving);
}

void ParticleCarrier::retire_products() {
  const double least = state_.setup.burn.retire_below;
  if (!(least > 0.0)) return;
  const Particles& q = state_.particles;
  const Explosives explosives(state_);
  const std::vector<std::uint32_t> spent = parallel::where(q.size(), [&](std::size_t p) {
    return explosives.is_burnt(p) && q.pressure[p] + q.artificial_viscosity[p] < least;
  });
  for (const std::uint32_t p : spent) {
    const Totals own = totals_of(q, p, state_.inertia_of_particles());
    state_.booked.retired += {own.mass, own.momentum, own.energy()};
  }
  remove_as_outflow(spent);
}

void ParticleCarrier::remove_as_outflow(const std::vector<std::uint32_t>& leaving) {
  if (leaving.empty()) return;
  for (const std::uint32_t p : leaving) {
    state_.book_outflow(state_.particles.body[p],
                        totals_of(state_.particles, p, state_.inertia_of_particles()));
  }
  const std::vector<Move> moves = moves_into_gaps(state_.particles.body, leaving);
  const std::size_t size = state_.particles.size() - leaving.size();
  remove(state_.particles, moves, size);
  state_.grid.particles_removed(moves, size);
  state_.find_bodies();
}

}  // namespace whipple::solver
