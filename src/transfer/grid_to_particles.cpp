// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/grid_to_particles.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/core/parallel/threads.hpp"
#include "src/transfer/kernels.hpp"
#include "src/transfer/mixed_kernels.hpp"
#include "src/transfer/shape_function.hpp"
#include "src/transfer/stress_columns.hpp"
#include "src/transfer/transition_nodes.hpp"

namespace whipple::transfer {
namespace {

using grid::BlockGrid;

Vector3 vector(Lanes v) { return {v[0], v[1], v[2]}; }

/// Lanes 0 to 2 of three vectors, as the columns of a matrix.
[[gnu::always_inline]] inline void store_columns(Matrix3& m, const std::array<Lanes, 3>& columns) {
  store(m.data(), columns[0]);  // what is too much is overwritten
  store(m.data() + 3, columns[1]);
  store_vector(m.data() + 6, columns[2]);
}
Matrix3 matrix(const std::array<Lanes, 3>& columns) {
  Matrix3 m;
  store_columns(m, columns);
  return m;
}

/// C_p <- C_p R^T (equation 4.9): only the rotation of the step, so the energy of the affine field stays.
void turn_affine_field(std::array<Lanes, 3>& columns, const Matrix3& gradient, double dt) {
  const Matrix3 quarter = 0.25 * dt * (gradient - gradient.transpose());  // half of the spin's increment
  const Matrix3 identity = Matrix3::Identity();
  const Matrix3 turned = matrix(columns) * (identity + quarter).inverse() * (identity - quarter);
  for (int a = 0; a < 3; ++a) columns[static_cast<std::size_t>(a)] = load_vector(turned.col(a).data());
}

/// Work of an external force m b on the mean of the grid velocities before and after the forces.
double external_work(Lanes new_velocity, Lanes increment, double mass, const Vector3& b, double dt) {
  return mass * dt * b.dot(vector(new_velocity - 0.5 * increment));
}

/// New velocity and affine field of a point, and position (4.4).
template <bool affine, class Points>
[[gnu::always_inline]] inline void advance_point(Points& points, std::size_t p, double dt,
                                                 const Advance<>& advance, AffineField field) {
  store_vector(points.velocity[p].data(), advance.velocity);
  store_vector(points.position[p].data(),
               load_vector(points.position[p].data()) + dt * advance.grid_velocity.value);
  if constexpr (affine) {
    std::array<Lanes, 3> columns = advance.affine;
    if (field == AffineField::turned) {
      turn_affine_field(columns, matrix(advance.grid_velocity.gradient), dt);
    }
    store_columns(points.affine_velocity[p], columns);
  }
}

/// |dv|^2 of a particle in the step (m^2/s^2).
double squared_change(Lanes velocity, const Vector3& former) {
  const Lanes change = velocity - load_vector(former.data());
  return sum3(change * change);
}

/// Adds the rate of the hoop, v_y/r, to the gradient of a ring: dv_z/dz.
[[gnu::always_inline]] inline void add_hoop_rate(std::array<Lanes, 3>& gradient, double radial_velocity,
                                                 double radius) {
  gradient[2] += (radial_velocity / radius) * Lanes{0.0, 0.0, 1.0, 0.0};
}

/// @param radius  of a ring, where it was before the step (m); 0: not axisymmetric
/// @param volume_rate  of the mean of old and new grid velocity, 1/s
template <bool affine, bool planar>
[[gnu::always_inline]] inline TransferBalance update_particle(Particles& particles, std::size_t p, double dt,
                                                              const Advance<>& advance, AffineField field,
                                                              Matrix3& gradient, double& volume_rate,
                                                              const Losses& losses,
                                                              std::span<const Vector3> acceleration,
                                                              double radius) {
  const double mean_stress = -(particles.pressure[p] + particles.artificial_viscosity[p]);
  const std::array<Lanes, 3> stress = stress_columns<0>(particles.deviatoric_stress[p], mean_stress);
  const double change = squared_change(advance.velocity, particles.velocity[p]);
  advance_point<affine>(particles, p, dt, advance, field);
  // The mean of old and new grid velocity makes the exact work identity (4.6).
  const auto mean_gradient = [&](std::size_t a) {
    return advance.grid_velocity.gradient[a] - 0.5 * advance.increment.gradient[a];
  };
  std::array<Lanes, 3> mean = {mean_gradient(0), mean_gradient(1), mean_gradient(2)};
  std::array<Lanes, 3> l = advance.grid_velocity.gradient;
  if constexpr (planar) {
    if (radius > 0.0) {
      const double radial = advance.grid_velocity.value[1];
      add_hoop_rate(l, radial, radius);
      add_hoop_rate(mean, radial - 0.5 * advance.increment.value[1], radius);
    }
  }
  const Lanes power = stress[0] * mean[0] + stress[1] * mean[1] + stress[2] * mean[2];
  store_columns(gradient, l);
  const double mass = particles.mass[p], loss = advance.heat[0], volume_and_time = particles.volume[p] * dt;
  const double work = sum3(power) * volume_and_time;
  volume_rate = mean[0][0] + mean[1][1] + mean[2][2];
  const double viscous_work = -particles.artificial_viscosity[p] * volume_rate * volume_and_time;
  const double heat_of_contact = advance.increment.value[3];  // docs/theory/contact.md, 4.6
  DividedLosses divided{.heat = loss, .of_contact = heat_of_contact};
  if (losses.become == LossesBecome::unresolved_energy) {
    const double divergence = l[0][0] + l[1][1] + l[2][2];
    divided = divide_losses(losses, particles, p, loss, heat_of_contact, viscous_work / mass, divergence, dt);
    particles.unresolved_energy[p] += divided.kept - divided.returned;
    particles.heat_allowance[p] = divided.allowance;
    particles.closing_rate[p] = std::fmax(-divergence, 0.0);
  }
  particles.specific_internal_energy[p] +=
      work / mass + divided.heat - divided.cooling + divided.returned + divided.of_contact;
  TransferBalance balance{.work = work,
                          .viscous_work = viscous_work - mass * divided.cooling,
                          .heat = mass * divided.heat,
                          .kept = mass * divided.kept,
                          .returned = mass * divided.returned,
                          .squared_change = change};
  if (!acceleration.empty()) {
    balance.external_work =
        external_work(advance.grid_velocity.value, advance.increment.value, mass, acceleration[p], dt);
  }
  return balance;
}

constexpr auto particle_kind = BlockGrid::Points::particles;

/// Sums of velocities alone need so many registers with cubic functions that wide ones lose.
template <class Shape>
constexpr Widest widest_of_sums = std::is_same_v<Shape, CubicBSpline> ? Widest::narrow : Widest::wide;

/// Calls gather(kernels, slot, sum of the slot, place of its first particle in the stretch) for the slots of a stretch.
template <class Shape, Widest widest, class Gather>
void for_each_slot(const BlockGrid& grid, const Stretch& stretch, Gather&& gather) {
  with_kernels<Shape, widest>([&](auto kernels) {
    std::size_t first = 0;
    for (std::size_t i = 0; i < stretch.balances.size(); ++i) {
      const std::size_t slot = stretch.first_slot + i, size = grid.particles_in(slot).size();
      if (size == 0) continue;
      TransferBalance balance;  // of its own: slots of other threads share lines of the cache
      gather(kernels, slot, balance, first);
      stretch.balances[i] = balance;
      first += size;
    }
  });
}

/// Gives a point the affine field that fits the cells at its new position (docs/theory/levels.md, 8).
/// @param before, after  edges of the cells at the positions before and after the step, m
template <class Shape>
void fit_affine_field(Advance<>& advance, double before, double after) {
  if (before == after) return;
  const auto [factor, loss] =
      formulas::fit_field(Shape::second_moment * before * before, Shape::second_moment * after * after);
  advance.heat += loss * squared_norm(advance.affine);
  for (Lanes& column : advance.affine) column *= factor;
}

/// Updates a particle of a grid of two levels, whose cells may change on its way.
template <class Shape, bool affine>
[[gnu::noinline]] TransferBalance update_between_levels(const ExactUpdate& update, Particles& particles,
                                                        const BlockGrid& grid, std::size_t p,
                                                        Advance<> advance, Matrix3& gradient,
                                                        double& volume_rate, double radius) {
  const grid::Geometry& geometry = grid.geometry();
  const double before = is_mixed(grid, p) ? geometry.cell_size_at(grid.mixed()[grid.mixed_number()[p]].blend)
                                          : grid.cell_size_of(p);
  if constexpr (affine) {
    const Vector3 moved = particles.position[p] + update.dt * vector(advance.grid_velocity.value);
    fit_affine_field<Shape>(advance, before, geometry.cell_size_at(moved));
  }
  Losses losses = update.losses;
  losses.allowance_length *= before / geometry.cell_size;
  return update_particle<affine, Planar<Shape>>(particles, p, update.dt, advance, update.affine, gradient,
                                                volume_rate, losses, update.acceleration, radius);
}

template <class Shape, bool affine>
void update_exactly(const ExactUpdate& update, Particles& particles, BlockGrid& grid,
                    const Stretch& stretch) {
  const auto& [functions, dt, field, losses, acceleration] = update;
  const bool radial = Planar<Shape> && grid.geometry().is_axisymmetric();
  const bool two_levels = grid.has_two_levels();
  for_each_slot<Shape, Widest::wide>(
      grid, stretch,
      [&]<class Kernels>(Kernels, std::size_t slot, TransferBalance& balance, std::size_t first) {
        const auto take = [&](std::size_t place, std::size_t p, const Advance<>& advance,
                              const auto&... sums) WHIPPLE_INLINE {
          if (prefetches(p)) {
            prefetch_state(particles, p + prefetch_distance);  // most of it for the material
            prefetch(p + prefetch_distance, particles.position, particles.velocity);
            if (!particles.extent.empty()) prefetch(p + prefetch_distance, particles.extent);
            if constexpr (affine) {
              prefetch(p + prefetch_distance, particles.affine_velocity);
            }
          }
          const double radius = radial ? particles.position[p][1] : 0.0;
          if (two_levels) {
            // The sums are read here, in the registers of the kernel.
            balance += update_between_levels<Shape, affine>(
                update, particles, grid, p,
                is_mixed(grid, p) ? advance_mixed<Shape, affine>(
                                        particles, grid, p, functions.slope_smoothing, field, dt, sums()...)
                                  : advance,
                stretch.gradients[first + place], stretch.volume_rates[first + place], radius);
            return;
          }
          balance += update_particle<affine, Planar<Shape>>(
              particles, p, dt, advance, field, stretch.gradients[first + place],
              stretch.volume_rates[first + place], losses, acceleration, radius);
        };
        Kernels::template gather<Shape>(particles, grid, particle_kind, slot, functions.slope_smoothing,
                                        typename Kernels::template Transfer<affine>{field, dt}, take);
      });
}

template <class Shape>
void update_velocities(const RelaxedUpdate& update, Particles& particles, BlockGrid& grid,
                       const Stretch& stretch) {
  const auto& [functions, dt, relaxation, wanted, acceleration] = update;
  const bool with_gradient = wanted == Gradients::of_grid_velocity;
  const bool radial = Planar<Shape> && grid.geometry().is_axisymmetric();
  for_each_slot<Shape, widest_of_sums<Shape>>(
      grid, stretch,
      [&]<class Kernels>(Kernels, std::size_t slot, TransferBalance& balance, std::size_t first) {
        const auto take = [&](std::size_t place, std::size_t p,
                              const VelocityUpdate<>& of_level) WHIPPLE_INLINE {
          const VelocityUpdate<> sums =
              is_mixed(grid, p)
                  ? sums_of_mixed<Shape>(particles, grid, p, functions.slope_smoothing, plain::Update{})
                  : of_level;
          const Lanes after = sums.after.value, increment = sums.increment, before = after - increment;
          double* const velocity = particles.velocity[p].data();
          const Lanes old = load_vector(velocity), updated = old + increment - relaxation * (old - before);
          balance.squared_change =
              std::max(balance.squared_change, squared_change(updated, particles.velocity[p]));
          store_vector(velocity, updated);
          double* const position = particles.position[p].data();
          const double radius = position[1];
          store_vector(position, load_vector(position) + dt * after);
          particles.specific_internal_energy[p] += increment[3];  // of contact
          if (with_gradient) {
            if (prefetches(p)) prefetch_state(particles, p);  // for the material
            std::array<Lanes, 3> l = sums.after.gradient;
            if (radial) add_hoop_rate(l, after[1], radius);
            stretch.gradients[first + place] = matrix(l);
          }
          if (!acceleration.empty()) {
            balance.external_work += external_work(after, increment, particles.mass[p], acceleration[p], dt);
          }
        };
        Kernels::template gather<Shape>(particles, grid, particle_kind, slot, functions.slope_smoothing,
                                        typename Kernels::Update{}, take);
      });
}

}  // namespace

void grid_to_particles(const ExactUpdate& update, Particles& particles, BlockGrid& grid,
                       const Stretch& stretch) {
  with_shape(update.functions.kind, [&]<class Shape>(Shape) {
    if (update.affine == AffineField::none) {
      return update_exactly<Shape, false>(update, particles, grid, stretch);
    }
    if constexpr (CarriesAffineField<Shape>) {
      update_exactly<Shape, true>(update, particles, grid, stretch);
    } else {
      throw InternalError("the affine transfer needs B-splines");
    }
  });
}

void TransitionNodes::resize(std::size_t n) {
  for (auto* values : {&mass, &sound_speed, &heat, &contact_heat}) values->resize(n);
  for (auto* values : {&position, &velocity, &force, &mean_velocity, &new_velocity}) values->resize(n);
  affine_velocity.resize(n);
}

namespace {

template <class Shape, bool affine>
void move_nodes(double slope_smoothing, TransitionNodes& nodes, BlockGrid& grid, double dt,
                AffineField field) {
  constexpr auto kind = BlockGrid::Points::guests;
  with_kernels<Shape>([&]<class Kernels>(Kernels) {
    parallel::for_each_uneven(grid.slots(), [&](std::size_t slot) {
      if (grid.guests_in(slot).empty()) return;
      const auto take = [&](std::size_t, std::size_t p, const Advance<>& advance, const auto&...)
                            WHIPPLE_INLINE {
                              advance_point<affine>(nodes, p, dt, advance, field);
                              store_vector(nodes.mean_velocity[p].data(),
                                           advance.grid_velocity.value - 0.5 * advance.increment.value);
                              store_vector(nodes.new_velocity[p].data(), advance.grid_velocity.value);
                              nodes.heat[p] = nodes.mass[p] * advance.heat[0];
                              nodes.contact_heat[p] = nodes.mass[p] * advance.increment.value[3];
                            };
      Kernels::template gather<Shape>(nodes, grid, kind, slot, slope_smoothing,
                                      typename Kernels::template Transfer<affine>{field, dt}, take);
    });
  });
}

}  // namespace

void grid_to_nodes(const ShapeFunctions& functions, TransitionNodes& nodes, BlockGrid& grid, double dt,
                   AffineField affine) {
  using enum AffineField;
  const double smoothing = functions.slope_smoothing;
  with_shape(functions.kind, [&]<class Shape>(Shape) {
    if constexpr (CarriesAffineField<Shape>) {
      if (affine == none) return move_nodes<Shape, false>(smoothing, nodes, grid, dt, none);
      return move_nodes<Shape, true>(smoothing, nodes, grid, dt, affine);
    } else {
      throw InternalError("nodes of elements need B-splines");
    }
  });
}

void update_velocity(const RelaxedUpdate& update, Particles& particles, BlockGrid& grid,
                     const Stretch& stretch) {
  with_shape(update.functions.kind,
             [&]<class Shape>(Shape) { update_velocities<Shape>(update, particles, grid, stretch); });
}

namespace {

/// Sums of the nodes' velocities that a gather is for; one kernel serves both.
enum class Wanted : std::uint8_t { velocity, gradient };

/// Gathers the nodes' velocities for the particles of a stretch, or their gradients.
/// @param velocity  m/s, of all particles, if it is wanted
void gather_first(Wanted wanted, const ShapeFunctions& functions, const Particles& particles, BlockGrid& grid,
                  const Stretch& stretch, std::span<Vector3> velocity) {
  const bool radial = grid.geometry().is_axisymmetric();
  with_shape(functions.kind, [&]<class Shape>(Shape) {
    for_each_slot<Shape, widest_of_sums<Shape>>(
        grid, stretch, [&]<class Kernels>(Kernels, std::size_t slot, TransferBalance&, std::size_t first) {
          const auto take = [&](std::size_t place, std::size_t p,
                                const ValueAndGradient<>& of_level) WHIPPLE_INLINE {
            const ValueAndGradient<> sums =
                is_mixed(grid, p)
                    ? sums_of_mixed<Shape>(particles, grid, p, functions.slope_smoothing, plain::First{})
                    : of_level;
            if (wanted == Wanted::velocity) return store_vector(velocity[p].data(), sums.value);
            if (prefetches(p)) prefetch_state(particles, p);  // for the material
            std::array<Lanes, 3> l = sums.gradient;
            if (radial) add_hoop_rate(l, sums.value[1], grid.radius_at_bin(p));
            stretch.gradients[first + place] = matrix(l);
          };
          Kernels::template gather<Shape>(particles, grid, particle_kind, slot, functions.slope_smoothing,
                                          typename Kernels::First{}, take);
        });
  });
}

}  // namespace

void gather_velocity_gradient(const ShapeFunctions& functions, const Particles& particles, BlockGrid& grid,
                              const Stretch& stretch) {
  gather_first(Wanted::gradient, functions, particles, grid, stretch, {});
}

void gather_velocity(ShapeFunction shape, const Particles& particles, BlockGrid& grid,
                     std::span<Vector3> velocity) {
  Sweep sweep(grid);
  for (const Region region : {Region::interior, Region::border}) {
    sweep.for_each_stretch(region, [&](const Stretch& stretch) {
      gather_first(Wanted::velocity, shape, particles, grid, stretch, velocity);
    });
  }
}

}  // namespace whipple::transfer
