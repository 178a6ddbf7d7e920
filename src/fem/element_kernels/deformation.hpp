// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "src/core/base/prefetch.hpp"
#include "src/fem/element_kernels/formulas.hpp"
#include "src/fem/quadrilateral.hpp"

/// Deformation of elements.
namespace whipple::fem {

inline constexpr double negligible_cut = 0.02;  ///< energy fraction cut from hourglass forces, not counted
inline constexpr double negligible_energy = 1e-12;  ///< of m c^2, likewise not counted as a limit

/// Holds the quantities common to all groups of elements.
struct DeformationStep {
  Mesh& mesh;
  double dt;
  const HourglassControl& hourglass;
  VelocityGradients& gradient;
};

/// Deforms elements of one point: hexahedra, or quadrilaterals of a section.
template <class Vector, HourglassControl::Kind kind, Quadrature quadrature>
struct OnePoint {
  static constexpr bool viscous = kind == HourglassControl::Kind::viscous;
  static constexpr bool is_ring = quadrature == Quadrature::ring;

  WHIPPLE_INLINE void operator()(const DeformationStep& step, const Group<Vector>& group,
                                 const Fields<Vector>& fields, Tally<Vector>& tally) const {
    GaussPoints& points = step.mesh.points;
    Elements& elements = step.mesh.elements;
    if (const std::size_t first = group.first; group.lane == 0) {
      prefetch(first + prefetch_distance, points.mass, points.pressure, points.artificial_viscosity,
               points.deviatoric_stress, points.sound_speed, points.plastic_strain, points.length,
               points.specific_internal_energy, elements.hourglass_energy, elements.hourglass_lead,
               elements.returned_plastic_strain);
      for (const auto component : Elements::hourglass_components()) {
        prefetch(first + prefetch_distance, elements.*component);
      }
    }
    const double dt = step.dt;
    const Modes<Vector> x = fields.position.modes();
    Vector radius{}, end_radius{};
    if constexpr (is_ring) {
      radius = fields.position.mean(1);
      end_radius = radius + dt * fields.end_velocity.mean(1);
    }
    const VolumeGradient<Vector> beta = volume_gradient_of<quadrature>(x, radius);
    const Vector per_volume = 1.0 / beta.volume, per_eighth = 8.0 * per_volume;

    // Component by component, each a row of a gradient, as the registers do not hold a complete field.
    using Axis = Vector Triple<Vector>::*;
    std::array<Triple<Vector>, 4> end_modes;
    Modes<Vector> moved = x;
    const auto end_row = [&](std::size_t i, Axis axis) WHIPPLE_INLINE {
      const std::array<Vector, 7> u = fields.end_velocity.component(i);
      moved.xi.*axis += dt * u[0];
      moved.eta.*axis += dt * u[1];
      moved.zeta.*axis += dt * u[2];
      moved.eta_zeta.*axis += dt * u[3];
      moved.zeta_xi.*axis += dt * u[4];
      moved.xi_eta.*axis += dt * u[5];
      for (std::size_t m = 0; m < 4; ++m) end_modes[m].*axis = u[3 + m];
      return per_eighth * mean_gradient_times_eighth(u, beta);
    };
    Columns<Vector> l = by_rows<Vector>(end_row);
    if constexpr (is_ring) l.z.z = fields.end_velocity.mean(1) / radius;

    // Velocity gradient of the step. Computed first because of its chain of slow divisions.
    const VolumeGradient<Vector> end = volume_gradient_of<quadrature>(moved, end_radius);
    const auto store_gradient = [&](const Vector& value, std::size_t k)
                                    WHIPPLE_INLINE { group.store(step.gradient.component[k], value); };
    if constexpr (is_flat(quadrature)) {  // det(I + dt L) is the ratio of the volumes
      for_each_component(l, store_gradient);
    } else {
      for_each_component(with_volume_ratio(l, end.volume * per_volume, dt), store_gradient);
    }
    group.store(points.length, length_of<quadrature>(end, end_radius));

    // Work of the stress (eq. 2.7) and of the hourglass forces (eq. 3.6), on the mean velocity.
    auto q = hourglass_forces_of(elements, group);
    Vector hourglass_rate{};
    Columns<Vector> mean = by_rows<Vector>([&](std::size_t i, Axis axis) WHIPPLE_INLINE {
      const std::array<Vector, 7> u = fields.mean_velocity.component(i);
      for (std::size_t m = 0; m < 4; ++m) hourglass_rate += q[m].*axis * u[3 + m];
      return mean_gradient_times_eighth(u, beta);
    });
    if constexpr (is_ring) mean.z.z = 0.125 * beta.volume * (fields.mean_velocity.mean(1) / radius);
    const Columns<Vector> deviator = deviator_at<Vector>(points, group);
    Columns<Vector> stress = deviator;
    add_to_diagonal(stress, -(group.load(points.pressure) + group.load(points.artificial_viscosity)));
    const Vector work = (8.0 * dt) * contraction(stress, mean);
    Columns<Vector> carried{};  // sum_k Q_k x_k^T
    for (std::size_t m = 0; m < 4; ++m) add_dyad(carried, q[m], x.*hourglass_modes<Vector>[m]);
    const Vector hourglass_work = (root8 * dt) * (hourglass_rate - per_eighth * contraction(carried, mean));

    // Hourglass forces of the next step (eq. 3.3 to 3.9).
    const Vector sound_speed = group.load(points.sound_speed), rate = sound_speed * per_volume;
    const Vector frequency_squared = 8.0 * stiffness_of<quadrature>(beta, radius) * rate * rate;  // eq. 5.1
    const double coefficient = 0.125 * root8 * step.hourglass.coefficient;
    const Vector mass = group.load(points.mass);
    const Vector resistance = mass * (viscous ? 2.0 * coefficient * sqrt(frequency_squared)
                                              : (coefficient * dt) * frequency_squared);
    const auto end_rate = [&](std::size_t m)
                              WHIPPLE_INLINE { return end_modes[m] - l * (x.*hourglass_modes<Vector>[m]); };
    Vector heat = hourglass_work;
    if constexpr (viscous) {
      for (std::size_t m = 0; m < 4; ++m) q[m] = resistance * end_rate(m);
    } else {
      const Vector returned =
          return_factor(group, elements, points, deviator, mass * per_volume * sound_speed * sound_speed);
      const Vector half = 0.5 * resistance;
      Vector rate_squared{}, force_squared{};
      std::array<Triple<Vector>, 4> advance;  // of half a step
      for (std::size_t m = 0; m < 4; ++m) {
        const Triple<Vector> mode_rate = end_rate(m);
        rate_squared += dot(mode_rate, mode_rate);
        advance[m] = half * mode_rate;
        q[m] = returned * (q[m] + dt * (l * q[m]) + advance[m]);
        force_squared += dot(q[m], q[m]);
      }
      const Vector before = group.load(elements.hourglass_energy);
      const Vector lead = (dt / root8) * resistance * rate_squared;
      const Vector booked = before + hourglass_work + (lead - group.load(elements.hourglass_lead));
      const Vector stored = returned * returned * maximum(booked, Vector{});
      heat = hourglass_work - (stored - before);
      group.store(elements.hourglass_energy, stored);
      group.store(elements.hourglass_lead, lead);
      // The spring energy is limited to the stored energy.
      const Vector most = (2.0 / (root8 * dt)) * resistance * stored;
      const Vector kept = most < force_squared ? sqrt(most / force_squared) : broadcast<Vector>(1.0);
      for (std::size_t m = 0; m < 4; ++m) q[m] = kept * q[m] + advance[m];
      const Vector round_off =
          (negligible_energy * 2.0 / (root8 * dt)) * resistance * mass * sound_speed * sound_speed;
      tally.add_limits(
          group, maximum(-booked, Vector{}),
          (1.0 - negligible_cut) * force_squared > most + round_off ? broadcast<Vector>(1.0) : Vector{});
    }
    for_each_hourglass_component(q, [&](const Vector& force, const auto component)
                                        WHIPPLE_INLINE { group.store(elements.*component, force); });

    group.store(points.specific_internal_energy,
                group.load(points.specific_internal_energy) + (work + heat) / mass);
    tally.add(group, work, hourglass_work);
    tally.count_inverted(group, end.volume);
  }
};

template <class Vector>
struct DeformEightPoints {
  WHIPPLE_INLINE void operator()(const DeformationStep& step, const Group<Vector>& group,
                                 const Fields<Vector>& fields, Tally<Vector>& tally) const {
    const Modes<Vector> x = fields.position.modes(), mean_velocity = fields.mean_velocity.modes(),
                        end_velocity = fields.end_velocity.modes();
    GaussPoints& points = step.mesh.points;
    const double dt = step.dt;
    const VolumeGradient<Vector> beta = volume_gradient(x);
    const Modes<Vector> end_position = x + dt * end_velocity;
    const VolumeGradient<Vector> end = volume_gradient(end_position);
    const Vector ratio = end.volume / beta.volume;
    const auto along = [&](std::size_t i) WHIPPLE_INLINE {
      return mean_gradient_times_eighth(fields.mean_velocity.component(i), beta);
    };
    const Vector mean_divergence = 8.0 * (along(0).x + along(1).y + along(2).z) / beta.volume;
    const auto [length, least_jacobian] = eight_point_size(end_position, end);
    Vector total{};  // work
    for (std::size_t g = 0; g < 8; ++g) {
      const GaussPoint at(g);
      const Rows<Vector> rows = at.rows(group);
      const Columns<Vector> jacobian = at.gradient(x), cofactor = cofactors(jacobian);
      const Vector det = determinant(jacobian);
      // du/dxi J^-1 times det J: the rows of the inverse are the columns of the cofactors
      const auto in_space = [&](const Modes<Vector>& u) WHIPPLE_INLINE {
        const Columns<Vector> natural = at.gradient(u);
        Columns<Vector> l{};
        add_dyad(l, natural.x, cofactor.x);
        add_dyad(l, natural.y, cofactor.y);
        add_dyad(l, natural.z, cofactor.z);
        return l;
      };
      // Work (eq. 4.3), velocity gradient (eq. 4.4)
      const Vector work = dt * (contraction(deviator_at<Vector>(points, rows), in_space(mean_velocity)) +
                                det * mean_stress_at<Vector>(points, rows) * mean_divergence);
      const Columns<Vector> l = with_volume_ratio(scaled(in_space(end_velocity), 1.0 / det), ratio, dt);
      for_each_component(l, [&](const Vector& value, std::size_t c) WHIPPLE_INLINE {
        for (std::size_t k = 0; k < group.count; ++k) step.gradient.component[c][rows[k]] = value[k];
      });
      for (std::size_t k = 0; k < group.count; ++k) {
        points.specific_internal_energy[rows[k]] += work[k] / points.mass[rows[k]];
        points.length[rows[k]] = length[k];
      }
      total += work;
    }
    tally.add(group, total, Vector{});
    tally.count_inverted(group, least_jacobian);
  }
};

}  // namespace whipple::fem
