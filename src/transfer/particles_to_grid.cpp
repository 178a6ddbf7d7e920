// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/particles_to_grid.hpp"

#include "src/core/base/prefetch.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/transfer/kernels.hpp"
#include "src/transfer/mixed_kernels.hpp"
#include "src/transfer/shape_function.hpp"
#include "src/transfer/stress_columns.hpp"
#include "src/transfer/transition_nodes.hpp"

namespace whipple::transfer {
namespace {

/// Lane 0, then a vector: the lanes of mass and momentum, or of a force.
[[gnu::always_inline]] inline Lanes beside(Lanes first, const double* v) {
  return __builtin_shufflevector(first, load_vector(v), 0, 4, 5, 6);
}
/// Mass times a vector, in the lanes of a momentum or force.
[[gnu::always_inline]] inline Lanes times(double mass, const double* v) { return mass * beside(Lanes{}, v); }
/// Mass and momentum.
[[gnu::always_inline]] inline Lanes with_momentum(double mass, const double* v) {
  return mass * beside(broadcast(1.0), v);
}

/// Mass and momentum, with the sound speed and no force; b_a is left open. (Clearing the whole payload would
/// cost more than the rest of it.)
template <bool affine, class Points>
[[gnu::always_inline]] inline Payload inertia(const Points& points, std::size_t p) {
  const double m = points.mass[p];
  Payload out;
  const double* v = points.velocity[p].data();
  out.a0 = with_momentum(m, v);
  if constexpr (affine) {
    const double* c = points.affine_velocity[p].data();
    out.ax = times(m, c);
    out.ay = times(m, c + 3);
    out.az = times(m, c + 6);
  } else {
    out.ax = out.ay = out.az = Lanes{};
  }
  out.b0 = Lanes{m * points.sound_speed[p], 0.0, 0.0, 0.0};
  return out;
}

/// Mean stress of a particle, Pa.
/// @param averaged  of all particles, or empty
[[gnu::always_inline]] inline double mean_stress_of(const Particles& particles, std::size_t p,
                                                    std::span<const double> averaged) {
  return averaged.empty() ? -(particles.pressure[p] + particles.artificial_viscosity[p]) : averaged[p];
}

/// Contributions of the points in the form that the kernel requires, with their inputs prefetched: all
/// quantities of particles, mass and momentum of particles with given velocities, or all quantities of
/// element nodes.
struct OfParticles {
  const Particles& points;
  const grid::BlockGrid& grid;
  static constexpr auto kind = grid::BlockGrid::Points::particles;
};
template <bool planar>
struct Everything : OfParticles {
  using Content = grid::Node;
  std::span<const Vector3> acceleration;
  std::span<const double> mean_stress;  ///< Pa, averaged; empty: of the own pressure
  bool rings;                           ///< of axisymmetry
  WHIPPLE_INLINE void prefetch_from(std::size_t p) const {
    prefetch(p, points.mass, points.velocity, points.sound_speed, points.volume, points.pressure,
             points.artificial_viscosity, points.deviatoric_stress);
    if (!points.affine_velocity.empty()) prefetch(p, points.affine_velocity);
  }
  /// The internal force on node i is -V sigma . grad N_i, sigma = s - (p + q) I; of a ring of radius r also
  /// -V sigma_zz N_i / r towards the axis.
  template <bool affine>
  [[nodiscard, gnu::always_inline]] Payload load(std::size_t p) const {
    return in_pass(grid, p, payload<affine>(p));
  }
  template <bool affine>
  [[nodiscard, gnu::always_inline]] Payload payload(std::size_t p) const {
    const double mean = mean_stress_of(points, p, mean_stress);
    const std::array<Lanes, 3> stress = stress_columns<1>(points.deviatoric_stress[p], mean);
    const Lanes minus_volume = -points.volume[p] * Lanes{0.0, 1.0, 1.0, 1.0};
    Payload out = inertia<affine>(points, p);
    if (!acceleration.empty()) out.b0 += times(points.mass[p], acceleration[p].data());
    if constexpr (planar) {
      const double hoop = points.deviatoric_stress[p].zz + mean;
      if (rings) out.b0[2] -= points.volume[p] * hoop / points.position[p][1];
    }
    out.bx = minus_volume * stress[0];
    out.by = minus_volume * stress[1];
    out.bz = minus_volume * stress[2];
    return out;
  }
};
struct OfNodes {
  /// In the place of the sound speed: no sum that it enters is positive, and beta vanishes there.
  static constexpr double holds_relaxation = -1e40;  // m/s
  using Content = grid::Node;
  const TransitionNodes& points;
  static constexpr auto kind = grid::BlockGrid::Points::guests;
  void prefetch_from(std::size_t) const {}
  template <bool affine>
  [[nodiscard]] Payload load(std::size_t p) const {
    Payload out = inertia<affine>(points, p);
    out.b0 += times(1.0, points.force[p].data());
    if (p < points.unrelaxed) out.b0[0] = holds_relaxation * points.mass[p];
    out.bx = out.by = out.bz = Lanes{};
    return out;
  }
};
struct Momentum : OfParticles {
  using Content = Lanes;
  std::span<const Vector3> velocity;
  WHIPPLE_INLINE void prefetch_from(std::size_t p) const { prefetch(p, points.mass, velocity); }
  template <bool affine>
  [[nodiscard, gnu::always_inline]] Lanes load(std::size_t p) const {
    return in_pass(grid, p, payload<affine>(p));
  }
  template <bool affine>
  [[nodiscard, gnu::always_inline]] Lanes payload(std::size_t p) const {
    return with_momentum(points.mass[p], velocity[p].data());
  }
};

/// Adds the contributions of the parts of mixed particles in a region to the nodes, where the particles of their blocks
/// have not done so.
template <class Shape, class What>
void scatter_parts(const What& what, const Particles& particles, grid::BlockGrid& grid, Region region,
                   double slope_smoothing) {
  for_each_part_apart(grid, region, [&](std::uint32_t part) {
    if (is_in_pass(grid::BlockGrid::level_of_part(part))) return;
    const auto load = what.template payload<CarriesAffineField<Shape>>(grid.mixed_of_part(part).particle);
    add_part<Shape>(particles, grid, part, slope_smoothing, load);
  });
}

/// Adds the contributions of the points of a region to the nodes.
template <class Shape, class What>
void scatter_region(const What& what, grid::BlockGrid& grid, Region region, double slope_smoothing) {
  grid.for_each_apart(region, [&](std::size_t slot) {
    grid.progress();
    if (grid.members(What::kind, slot).empty()) return;
    with_kernels<Shape>(
        [&]<class Kernels>(Kernels) { Kernels::template scatter<Shape>(what, grid, slot, slope_smoothing); });
  });
}

}  // namespace

void particles_to_grid(const ShapeFunctions& functions, const Particles& particles, grid::BlockGrid& grid,
                       Region region, std::span<const Vector3> acceleration,
                       std::span<const double> mean_stress) {
  with_shape(functions.kind, [&]<class Shape>(Shape) {
    const bool rings = grid.geometry().is_axisymmetric();
    const Everything<Planar<Shape>> everything{{particles, grid}, acceleration, mean_stress, rings};
    scatter_region<Shape>(everything, grid, region, functions.slope_smoothing);
    scatter_parts<Shape>(everything, particles, grid, region, functions.slope_smoothing);
  });
}

double hoop_force(const Particles& particles, const grid::BlockGrid& grid,
                  std::span<const double> mean_stress) {
  const std::span<const std::uint32_t> inside = grid.particles_by_block();
  return parallel::sum<double>(inside.size(), [&](std::size_t k) {
    const std::size_t p = inside[k];
    const double mean = mean_stress_of(particles, p, mean_stress);
    return particles.volume[p] * (particles.deviatoric_stress[p].zz + mean) / particles.position[p][1];
  });
}

void nodes_to_grid(ShapeFunction shape, const TransitionNodes& nodes, grid::BlockGrid& grid, Region region) {
  with_shape(shape, [&]<class Shape>(Shape) {
    if constexpr (CarriesAffineField<Shape>) scatter_region<Shape>(OfNodes{nodes}, grid, region, no_slopes);
  });
}

void clear_momentum(grid::BlockGrid& grid) {
  const std::span<grid::Node> nodes = grid.all_nodes();
  parallel::for_each(nodes.size(), [&](std::size_t i) { nodes[i].sums.mass_and_momentum = broadcast(0.0); });
}

void momentum_to_grid(ShapeFunction shape, const Particles& particles, std::span<const Vector3> velocity,
                      grid::BlockGrid& grid, Region region) {
  with_shape(shape, [&]<class Shape>(Shape) {
    const Momentum momentum{{particles, grid}, velocity};
    scatter_region<Shape>(momentum, grid, region, no_slopes);
    scatter_parts<Shape>(momentum, particles, grid, region, no_slopes);
  });
}

}  // namespace whipple::transfer
