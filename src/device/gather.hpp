// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "src/device/stencil.hpp"
#include "src/transfer/formulas.hpp"
#include "src/transfer/loss_formulas.hpp"

/// Transfer from the advanced nodes to the particles (docs/theory/mpm.md, 4.1 to 4.8), with the destination of the losses
/// (docs/theory/dissipation.md, 2).
namespace whipple::device {

/// Destination of the losses of the particles of each body.
struct LossConstants {
  double heat_share, allowance_length, collision_rate;  ///< as of transfer::formulas::LossRates
};

/// Moves the particle at a position of the order with its nodes; leaves its velocity gradient for the material.
template <class Lattice>
struct MoveParticles {
  Lattice lattice;
  Points points;
  const std::uint32_t* cell_of_ordered;
  const double* initial_density;  ///< of each body, kg/m^3
  LossConstants losses;
  Triple<double> acceleration;  ///< by loads, m/s^2
  double dt;                    ///< s

  WHIPPLE_POINT void operator()(std::size_t i) const {
    const std::uint32_t p = lattice.order[i];
    const std::int32_t* const nodes =
        lattice.nodes_of_cell + static_cast<std::size_t>(cell_of_ordered[i]) * Lattice::stencil_nodes;
    const Stress stress = stress_of(p);
    Sums sums = sum(p, nodes, stress);
    finish(p, sums, stress);
  }

 private:
  using Vector = Triple<double>;
  using Matrix = std::array<Vector, 3>;

  /// Columns of the total stress, Pa.
  struct Stress {
    Matrix column;
  };
  struct Sums {
    Vector v{}, change{}, loss{};                    ///< of N v', N (d - beta D), N times the losses
    Matrix gradient_v{}, change_r{};                 ///< columns: of v' S^T, of (d - beta D) N r^T
    double power_of_d = 0.0, divergence_of_d = 0.0;  ///< of stress : d S^T, tr d S^T
    double radial_d = 0.0;                           ///< of N d along the radius of rings, m/s
    double contact_heat = 0.0;
    double by_load = 0.0;  ///< power of the loads, W/kg
  };

  WHIPPLE_POINT Stress stress_of(std::size_t p) const {
    const material::formulas::Symmetric<double> s = points.symmetric(deviator, p);
    const double mean = -(points.at(pressure, p) + points.at(artificial_viscosity, p));
    return {{{{s.xx + mean, s.xy, s.zx}, {s.xy, s.yy + mean, s.yz}, {s.zx, s.yz, s.zz + mean}}}};
  }

  WHIPPLE_POINT Sums sum(std::size_t p, const std::int32_t* nodes, const Stress& stress) const {
    const auto weights = weights_at(lattice, points.vector(position, p), lattice.slope_smoothing);
    const Vector velocity_ = points.vector(velocity, p);
    const Matrix c = points.columns(affine, p);
    Sums sums;
    for_each_seen(weights, [&](int n, const SeenNode& at) {
      const Node& node = lattice.nodes[nodes[n]];
      const Vector v_i = node.velocity(), d_i = node.increment();
      const Vector difference = velocity_ + (at.r.x * c[0] + at.r.y * c[1] + at.r.z * c[2]) - v_i;
      const double beta = node.relaxation();
      using transfer::formulas::change_by_node;
      const auto x = change_by_node(difference.x, d_i.x, beta), y = change_by_node(difference.y, d_i.y, beta),
                 z = change_by_node(difference.z, d_i.z, beta);
      const Vector change_i = {x.velocity, y.velocity, z.velocity}, after = v_i + d_i;
      sums.loss += at.n * Vector{x.loss, y.loss, z.loss};
      sums.v += at.n * after;
      sums.by_load += at.n * dot(acceleration, after - 0.5 * d_i);
      sums.change += at.n * change_i;
      add_dyad(sums.gradient_v, after, at.gradient);
      add_dyad(sums.change_r, at.n * change_i, at.r);
      sums.power_of_d += dot(at.gradient.x * stress.column[0] + at.gradient.y * stress.column[1] +
                                 at.gradient.z * stress.column[2],
                             d_i);
      sums.divergence_of_d += dot(at.gradient, d_i);
      if constexpr (Lattice::planar) sums.radial_d += at.n * d_i.y;
      sums.contact_heat += at.n * node.n[7];
    });
    return sums;
  }
  static WHIPPLE_POINT void add_dyad(Matrix& m, const Vector& a, const Vector& b) {
    m[0] += b.x * a;
    m[1] += b.y * a;
    m[2] += b.z * a;
  }

  WHIPPLE_POINT void finish(std::size_t p, Sums& sums, const Stress& stress) const {
    using namespace transfer::formulas;
    double loss = heat_of_velocity(sums.loss.x, sums.change.x) +
                  heat_of_velocity(sums.loss.y, sums.change.y) + heat_of_velocity(sums.loss.z, sums.change.z);
    const double inertia = 0.25 * lattice.cell_size * lattice.cell_size, per_inertia = 1.0 / inertia;
    Matrix c = points.columns(affine, p);
    for (std::size_t a = 0; a < 3; ++a) {
      const auto x = change_of_field(sums.change_r[a].x, per_inertia),
                 y = change_of_field(sums.change_r[a].y, per_inertia),
                 z = change_of_field(sums.change_r[a].z, per_inertia);
      loss -= x.energy + y.energy + z.energy;
      c[a] += Vector{x.field, y.field, z.field};
    }
    loss += 0.5 * inertia * convect(c, sums.gradient_v, dt);
    for (std::uint32_t a = 0; a < 3; ++a) points.set(affine + 3 * a, p, c[a]);
    if constexpr (Lattice::planar) {
      if (lattice.has_rings) add_hoop(points.at(position + 1, p), sums, stress);
    }
    const Matrix& l = sums.gradient_v;
    for (std::uint32_t a = 0; a < 3; ++a) {
      points.at(gradient + a, p) = l[a].x;
      points.at(gradient + 3 + a, p) = l[a].y;
      points.at(gradient + 6 + a, p) = l[a].z;
    }
    points.set(velocity, p, points.vector(velocity, p) + sums.change);
    points.set(position, p, points.vector(position, p) + dt * sums.v);
    points.at(squared_change, p) = dot(sums.change, sums.change);
    book(p, loss, sums, stress);
  }

  /// Adds the rate of the hoop, v_y / r, as dv_z/dz.
  /// @param radius  of the ring before the step, m
  static WHIPPLE_POINT void add_hoop(double radius, Sums& sums, const Stress& stress) {
    const double of_d = sums.radial_d / radius;
    sums.gradient_v[2].z += sums.v.y / radius;
    sums.power_of_d += stress.column[2].z * of_d;
    sums.divergence_of_d += of_d;
  }
  /// Books the work of the stress (4.6) and divides the losses.
  WHIPPLE_POINT void book(std::size_t p, double loss, const Sums& sums, const Stress& stress) const {
    const Matrix& l = sums.gradient_v;
    const double m = points.at(mass, p), volume_and_time = points.at(volume, p) * dt;
    const double divergence = l[0].x + l[1].y + l[2].z;
    // The mean of old and new grid velocity makes the exact work identity.
    const double power = dot(stress.column[0], l[0]) + dot(stress.column[1], l[1]) +
                         dot(stress.column[2], l[2]) - 0.5 * sums.power_of_d;
    const double volume_rate = divergence - 0.5 * sums.divergence_of_d;
    const double done = power * volume_and_time;
    const double by_viscosity = -points.at(artificial_viscosity, p) * volume_rate * volume_and_time;
    const transfer::formulas::LossRates rates = {.heat_share = losses.heat_share,
                                                 .allowance_length = losses.allowance_length,
                                                 .collision_rate = losses.collision_rate,
                                                 .initial_density = initial_density[points.body[p]]};
    const transfer::formulas::LossyPoint point = {.mass = m,
                                                  .volume = points.at(volume, p),
                                                  .void_volume = points.at(void_volume, p),
                                                  .pressure = points.at(pressure, p),
                                                  .sound_speed = points.at(sound_speed, p),
                                                  .artificial_viscosity = points.at(artificial_viscosity, p),
                                                  .heating_viscosity = points.at(heating_viscosity, p),
                                                  .unresolved_energy = points.at(unresolved, p),
                                                  .heat_allowance = points.at(allowance, p),
                                                  .failed = points.at(failed, p) != 0.0};
    const transfer::formulas::LossyStep step = {.loss = loss,
                                                .contact = sums.contact_heat,
                                                .viscous_work = by_viscosity / m,
                                                .divergence = divergence,
                                                .dt = dt};
    const transfer::formulas::DividedLosses divided = transfer::formulas::divide_losses(rates, point, step);
    points.at(unresolved, p) += divided.kept - divided.returned;
    points.at(allowance, p) = divided.allowance;
    points.at(closing_rate, p) = std::fmax(-divergence, 0.0);
    points.at(energy, p) += done / m + divided.heat - divided.cooling + divided.returned + divided.of_contact;
    points.at(work, p) = done;
    points.at(external_work, p) = m * dt * sums.by_load;
    points.at(viscous_work, p) = by_viscosity - m * divided.cooling;
    points.at(heat, p) = m * divided.heat;
    points.at(kept, p) = m * divided.kept;
    points.at(returned, p) = m * divided.returned;
  }
};

}  // namespace whipple::device
