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
    // The nodes are visited twice: fewer sums and weights live at a time, which registers can hold.
    const Flow flow = strain(p, nodes);
    finish(p, flow, change(p, nodes));
  }

 private:
  using Vector = Triple<double>;
  using Matrix = std::array<Vector, 3>;

  /// Columns of the total stress, Pa.
  struct Stress {
    Matrix column;
  };
  /// Sums over the advanced nodes.
  struct Flow {
    Vector v{};                 ///< of N v'
    double power = 0.0;         ///< of the stress, with the mean of old and new grid velocity, W/m^3
    double volume_rate = 0.0;   ///< with the same, 1/s
    double divergence = 0.0;    ///< of v', 1/s
    double contact_heat = 0.0;  ///< J/kg
    double by_load = 0.0;       ///< power of the loads, W/kg
  };
  /// Sums over the changes that the nodes make.
  struct Changes {
    Vector change{}, loss{};  ///< of N (d - beta D), N times the losses
    Matrix moment{};          ///< columns: of (d - beta D) N r^T
  };

  WHIPPLE_POINT Stress stress_of(std::size_t p) const {
    const material::formulas::Symmetric<double> s = points.symmetric(deviator, p);
    const double mean = -(points.at(pressure, p) + points.at(artificial_viscosity, p));
    return {{{{s.xx + mean, s.xy, s.zx}, {s.xy, s.yy + mean, s.yz}, {s.zx, s.yz, s.zz + mean}}}};
  }

  /// Sums motion and velocity gradient, and stores the gradient.
  WHIPPLE_POINT Flow strain(std::size_t p, const std::int32_t* nodes) const {
    const auto weights = weights_at(lattice, points.vector(position, p), lattice.slope_smoothing);
    const Stress stress = stress_of(p);
    Flow flow;
    Matrix l{};                                      // columns: of v' S^T
    double power_of_d = 0.0, divergence_of_d = 0.0;  // of stress : d S^T, tr d S^T
    double radial_d = 0.0;                           // of N d along the radius of rings, m/s
    for_each_seen(weights, [&](int n, const SeenNode& at) {
      const Node& node = lattice.nodes[nodes[n]];
      const Vector d_i = node.increment(), after = node.velocity() + d_i;
      flow.v += at.n * after;
      add_dyad(l, after, at.gradient);
      power_of_d += dot(at.gradient.x * stress.column[0] + at.gradient.y * stress.column[1] +
                            at.gradient.z * stress.column[2],
                        d_i);
      divergence_of_d += dot(at.gradient, d_i);
      if constexpr (Lattice::planar) radial_d += at.n * d_i.y;
      flow.contact_heat += at.n * node.n[7];
      flow.by_load += at.n * dot(acceleration, after - 0.5 * d_i);
    });
    if constexpr (Lattice::planar) {
      if (lattice.has_rings) {  // the rate of the hoop, v_y / r, is dv_z/dz
        const double radius = points.at(position + 1, p), of_d = radial_d / radius;
        l[2].z += flow.v.y / radius;
        power_of_d += stress.column[2].z * of_d;
        divergence_of_d += of_d;
      }
    }
    // The mean of old and new grid velocity makes the exact work identity.
    flow.power = dot(stress.column[0], l[0]) + dot(stress.column[1], l[1]) + dot(stress.column[2], l[2]) -
                 0.5 * power_of_d;
    flow.divergence = l[0].x + l[1].y + l[2].z;
    flow.volume_rate = flow.divergence - 0.5 * divergence_of_d;
    for (std::uint32_t a = 0; a < 3; ++a) {
      points.at(gradient + a, p) = l[a].x;
      points.at(gradient + 3 + a, p) = l[a].y;
      points.at(gradient + 6 + a, p) = l[a].z;
    }
    return flow;
  }

  WHIPPLE_POINT Changes change(std::size_t p, const std::int32_t* nodes) const {
    const auto weights = weights_at(lattice, points.vector(position, p), lattice.slope_smoothing);
    const Vector velocity_ = points.vector(velocity, p);
    const Matrix c = points.columns(affine, p);
    Changes sums;
    for_each_seen(weights, [&](int n, const SeenNode& at) {
      const Node& node = lattice.nodes[nodes[n]];
      const Vector d_i = node.increment();
      const Vector difference = velocity_ + (at.r.x * c[0] + at.r.y * c[1] + at.r.z * c[2]) - node.velocity();
      const double beta = node.relaxation();
      using transfer::formulas::change_by_node;
      const auto x = change_by_node(difference.x, d_i.x, beta), y = change_by_node(difference.y, d_i.y, beta),
                 z = change_by_node(difference.z, d_i.z, beta);
      const Vector weighted = at.n * Vector{x.velocity, y.velocity, z.velocity};
      sums.loss += at.n * Vector{x.loss, y.loss, z.loss};
      sums.change += weighted;
      add_dyad(sums.moment, weighted, at.r);
    });
    return sums;
  }
  static WHIPPLE_POINT void add_dyad(Matrix& m, const Vector& a, const Vector& b) {
    m[0] += b.x * a;
    m[1] += b.y * a;
    m[2] += b.z * a;
  }

  WHIPPLE_POINT void finish(std::size_t p, const Flow& flow, const Changes& sums) const {
    using namespace transfer::formulas;
    double loss = heat_of_velocity(sums.loss.x, sums.change.x) +
                  heat_of_velocity(sums.loss.y, sums.change.y) + heat_of_velocity(sums.loss.z, sums.change.z);
    const double inertia = 0.25 * lattice.cell_size * lattice.cell_size, per_inertia = 1.0 / inertia;
    Matrix c = points.columns(affine, p), l;
    for (std::uint32_t a = 0; a < 3; ++a) {
      const auto x = change_of_field(sums.moment[a].x, per_inertia),
                 y = change_of_field(sums.moment[a].y, per_inertia),
                 z = change_of_field(sums.moment[a].z, per_inertia);
      loss -= x.energy + y.energy + z.energy;
      c[a] += Vector{x.field, y.field, z.field};
      l[a] = {points.at(gradient + a, p), points.at(gradient + 3 + a, p), points.at(gradient + 6 + a, p)};
    }
    if constexpr (Lattice::planar) l[2] = {};  // hoops do not carry the field
    loss += 0.5 * inertia * convect(c, l, dt);
    for (std::uint32_t a = 0; a < 3; ++a) points.set(affine + 3 * a, p, c[a]);
    points.set(velocity, p, points.vector(velocity, p) + sums.change);
    points.set(position, p, points.vector(position, p) + dt * flow.v);
    points.at(squared_change, p) = dot(sums.change, sums.change);
    book(p, loss, flow);
  }

  /// Books the work of the stress (4.6) and divides the losses.
  WHIPPLE_POINT void book(std::size_t p, double loss, const Flow& flow) const {
    const double m = points.at(mass, p), volume_and_time = points.at(volume, p) * dt;
    const double done = flow.power * volume_and_time;
    const double by_viscosity = -points.at(artificial_viscosity, p) * flow.volume_rate * volume_and_time;
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
                                                .contact = flow.contact_heat,
                                                .viscous_work = by_viscosity / m,
                                                .divergence = flow.divergence,
                                                .dt = dt};
    const transfer::formulas::DividedLosses divided = transfer::formulas::divide_losses(rates, point, step);
    points.at(unresolved, p) += divided.kept - divided.returned;
    points.at(allowance, p) = divided.allowance;
    points.at(closing_rate, p) = std::fmax(-flow.divergence, 0.0);
    points.at(energy, p) += done / m + divided.heat - divided.cooling + divided.returned + divided.of_contact;
    points.at(work, p) = done;
    points.at(external_work, p) = m * dt * flow.by_load;
    points.at(viscous_work, p) = by_viscosity - m * divided.cooling;
    points.at(heat, p) = m * divided.heat;
    points.at(kept, p) = m * divided.kept;
    points.at(returned, p) = m * divided.returned;
  }
};

}  // namespace whipple::device
