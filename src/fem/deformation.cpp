// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "src/base/error.hpp"
#include "src/fem/four_elements.hpp"
#include "src/fem/gauss_points.hpp"
#include "src/fem/step.hpp"
#include "src/parallel/threads.hpp"

namespace whipple::fem {
namespace {

/// What does not change from one group of elements to the next.
struct Step {
  Mesh& mesh;
  double dt;
  const HourglassControl& hourglass;
  std::span<Matrix3> gradient;
};

template <class T>
[[gnu::always_inline]] inline Columns<T> scaled(const Columns<T>& m, const T& factor) {
  return {factor * m.x, factor * m.y, factor * m.z};
}

/// The gradient whose volume ratio det(I + dt L) is `ratio` (eq. 2.8).
[[gnu::always_inline]] inline Columns<Lanes> with_volume_ratio(const Columns<Lanes>& gradient,
                                                               const Lanes& ratio, double dt) {
  Columns<Lanes> f = scaled(gradient, broadcast(dt));
  add_to_diagonal(f, broadcast(1.0));
  const Lanes stretch = cube_root_near_one(ratio / determinant(f));
  // (stretch F - I)/dt without the difference of large numbers
  Columns<Lanes> result = scaled(gradient, stretch);
  add_to_diagonal(result, (stretch - 1.0) / dt);
  return result;
}

[[gnu::always_inline]] inline void store_gradient(const Step& step, const FourElements& four,
                                                  const Rows& rows, const Columns<Lanes>& l) {
  const auto place = [&](std::size_t k) { return step.gradient[rows[k]].data(); };
  scatter_columns<3>(four, {l.x, l.y, l.z}, {place(0), place(1), place(2), place(3)});
}

/// The four modes that the mean gradient does not see.
constexpr std::array<Triple<Lanes> Modes<Lanes>::*, 4> hourglass_modes = {
    &Modes<Lanes>::eta_zeta, &Modes<Lanes>::zeta_xi, &Modes<Lanes>::xi_eta, &Modes<Lanes>::xi_eta_zeta};

void count_inverted(const FourElements& four, unsigned positive, DeformationReport& report) {
  if (positive == all_lanes) return;
  for (std::size_t l = 0; l < four.count; ++l) {
    if ((positive >> l & 1U) != 0) continue;
    ++report.inverted;
    report.first_inverted = std::min(report.first_inverted, four.index[l]);
  }
}

/// What the plastic strain since the last step leaves of the hourglass forces (eq. 3.7); marks it as done.
/// @param modulus  rho c^2
Lanes return_factor(const FourElements& four, Elements& elements, const GaussPoints& points,
                    const Columns<Lanes>& deviator, const Lanes& modulus) {
  const Lanes strain = four.load(points.plastic_strain);
  const Lanes increment = strain - four.load(elements.returned_plastic_strain);
  four.store(elements.returned_plastic_strain, strain);
  const Lanes overshoot = 0.8 * modulus * maximum(increment, Lanes{});  // 3 G dep of metals
  const Lanes equivalent = sqrt(1.5 * contraction(deviator, deviator));
  return select(overshoot > Lanes{}, equivalent / (equivalent + overshoot), broadcast(1.0));
}

template <HourglassControl::Kind kind>
struct OnePoint {
  static constexpr bool viscous = kind == HourglassControl::Kind::viscous;

  [[gnu::always_inline]] void operator()(const Step& step, const FourElements& four, const Modes<Lanes>& x,
                                         const Modes<Lanes>& mean_velocity, const Modes<Lanes>& end_velocity,
                                         DeformationReport& report) const {
    GaussPoints& points = step.mesh.points;
    Elements& elements = step.mesh.elements;
    const double dt = step.dt;
    const VolumeGradient<Lanes> beta = volume_gradient(x);
    const Lanes per_volume = 1.0 / beta.volume;
    const Lanes mass = four.load(points.mass);

    // Work of the stress (eq. 2.7) and of the hourglass forces (eq. 3.6), on the mean velocity.
    Columns<Lanes> mean = mean_gradient_times_volume(mean_velocity, beta);
    const Columns<Lanes> deviator = deviator_at(points, four.index);
    Columns<Lanes> stress = deviator;
    add_to_diagonal(stress, mean_stress_at(points, four.index));
    const Lanes work = dt * contraction(stress, mean);
    mean = scaled(mean, per_volume);
    auto q = hourglass_forces_of(elements, four);
    Lanes hourglass_work{};
    for (std::size_t m = 0; m < 4; ++m) {
      const auto mode = hourglass_modes[m];
      hourglass_work += dot(q[m], mean_velocity.*mode - mean * (x.*mode));
    }
    hourglass_work = (root8 * dt) * hourglass_work;

    // Hourglass forces of the next step (eq. 3.3, 3.4).
    const Columns<Lanes> l = scaled(mean_gradient_times_volume(end_velocity, beta), per_volume);
    const Lanes sound_speed = four.load(points.sound_speed);
    const Lanes frequency = root8 * sound_speed * sqrt(beta.squared_norm()) * per_volume;
    const double coefficient = 0.125 * root8 * step.hourglass.coefficient;
    const Lanes resistance =
        mass * frequency * (viscous ? broadcast(2.0 * coefficient) : (coefficient * dt) * frequency);
    Lanes heat = hourglass_work;
    if constexpr (!viscous) {
      const Lanes returned =
          return_factor(four, elements, points, deviator, mass * per_volume * sound_speed * sound_speed);
      const Lanes stored = four.load(elements.hourglass_energy) + hourglass_work;
      heat = (1.0 - returned * returned) * maximum(stored, Lanes{});
      four.store(elements.hourglass_energy, stored - heat);
      for (Triple<Lanes>& force : q) force = returned * force;
    }
    for (std::size_t m = 0; m < 4; ++m) {
      const auto mode = hourglass_modes[m];
      if constexpr (viscous) {
        q[m] = resistance * (end_velocity.*mode - l * (x.*mode));
      } else {
        q[m] += resistance * (end_velocity.*mode) + l * (dt * q[m] - resistance * (x.*mode));
      }
    }
    const auto place = [&](std::size_t k) { return elements.hourglass_force[four.index[k]].data(); };
    scatter_columns<4>(four, q, {place(0), place(1), place(2), place(3)});

    const VolumeGradient<Lanes> end = volume_gradient(x + dt * end_velocity);
    four.store(points.length, one_point_length(end));
    store_gradient(step, four, four.index, with_volume_ratio(l, end.volume * per_volume, dt));
    four.store(points.specific_internal_energy,
               four.load(points.specific_internal_energy) + (work + heat) / mass);
    report.work += four.sum(work);
    report.hourglass_work += four.sum(hourglass_work);
    count_inverted(four, bits(end.volume > 0.0), report);
  }
};

struct EightPoints {
  void operator()(const Step& step, const FourElements& four, const Modes<Lanes>& x,
                  const Modes<Lanes>& mean_velocity, const Modes<Lanes>& end_velocity,
                  DeformationReport& report) const {
    GaussPoints& points = step.mesh.points;
    const double dt = step.dt;
    const VolumeGradient<Lanes> beta = volume_gradient(x);
    const Modes<Lanes> end_position = x + dt * end_velocity;
    const VolumeGradient<Lanes> end = volume_gradient(end_position);
    const Lanes ratio = end.volume / beta.volume;
    const Columns<Lanes> mean = mean_gradient_times_volume(mean_velocity, beta);
    const Lanes mean_divergence = (mean.x.x + mean.y.y + mean.z.z) / beta.volume;
    const auto [length, least_jacobian] = eight_point_size(end_position, end);
    for (std::size_t g = 0; g < 8; ++g) {
      const GaussPoint at(g);
      const Rows rows = at.rows(four);
      const Columns<Lanes> jacobian = at.gradient(x), cofactor = cofactors(jacobian);
      const Lanes det = determinant(jacobian);
      // du/dxi J^-1 times det J: the rows of the inverse are the columns of the cofactors
      const auto in_space = [&](const Modes<Lanes>& u) {
        const Columns<Lanes> natural = at.gradient(u);
        Columns<Lanes> l{};
        add_dyad(l, natural.x, cofactor.x);
        add_dyad(l, natural.y, cofactor.y);
        add_dyad(l, natural.z, cofactor.z);
        return l;
      };
      // Work (eq. 4.3), velocity gradient (eq. 4.4)
      const Lanes work = dt * (contraction(deviator_at(points, rows), in_space(mean_velocity)) +
                               det * mean_stress_at(points, rows) * mean_divergence);
      store_gradient(step, four, rows,
                     with_volume_ratio(scaled(in_space(end_velocity), 1.0 / det), ratio, dt));
      for (std::size_t k = 0; k < four.count; ++k) {
        points.specific_internal_energy[rows[k]] += work[k] / points.mass[rows[k]];
        points.length[rows[k]] = length[k];
      }
      report.work += four.sum(work);
    }
    count_inverted(four, bits(least_jacobian > 0.0), report);
  }
};

template <class Kernel>
WHIPPLE_KERNEL void deform_block(const Step& step, const Motion& motion, std::size_t block,
                                 const Kernel& kernel, DeformationReport& report) {
  BlockField position, mean, end;
  position.copy(step.mesh, block, step.mesh.nodes.position);
  mean.copy(step.mesh, block, motion.mean);
  end.copy(step.mesh, block, motion.end);
  for_each_four(block, step.mesh.elements.size(), [&](const FourElements& four) {
    const Modes<Lanes> x = position.modes(step.mesh, four), mean_velocity = mean.modes(step.mesh, four),
                       end_velocity = end.modes(step.mesh, four);
    kernel(step, four, x, mean_velocity, end_velocity, report);
  });
}

}  // namespace

DeformationReport& DeformationReport::operator+=(const DeformationReport& other) {
  work += other.work;
  hourglass_work += other.hourglass_work;
  inverted += other.inverted;
  first_inverted = std::min(first_inverted, other.first_inverted);
  return *this;
}

DeformationReport deform(Mesh& mesh, const Motion& motion, double dt, const HourglassControl& hourglass,
                         std::span<Matrix3> velocity_gradient, const AfterBlock& after_block) {
  if (velocity_gradient.size() != mesh.points.size() || motion.end.size() != mesh.nodes.size() ||
      motion.mean.size() != mesh.nodes.size()) {
    throw InternalError("fem::deform: velocities or gradients do not fit the mesh");
  }
  using enum HourglassControl::Kind;
  const Step step{mesh, dt, hourglass, velocity_gradient};
  std::vector<DeformationReport> reports(block_count(mesh));
  parallel::for_each(block_count(mesh), [&](std::size_t block) {
    if (mesh.quadrature == Quadrature::b_bar) {
      deform_block(step, motion, block, EightPoints{}, reports[block]);
    } else if (hourglass.kind == viscous) {
      deform_block(step, motion, block, OnePoint<viscous>{}, reports[block]);
    } else {
      deform_block(step, motion, block, OnePoint<stiffness>{}, reports[block]);
    }
    if (after_block) {
      const std::size_t rows = Blocks::size * points_per_element(mesh.quadrature);
      after_block(block * rows, std::min((block + 1) * rows, mesh.points.size()));
    }
  });
  DeformationReport sum;
  for (const DeformationReport& report : reports) sum += report;
  return sum;
}

}  // namespace whipple::fem
