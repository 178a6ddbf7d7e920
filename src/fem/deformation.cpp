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

struct Fields {
  Modes<Lanes> position, mean_velocity, end_velocity;
};

template <class T>
Columns<T> scaled(const Columns<T>& m, const T& factor) {
  return {factor * m.x, factor * m.y, factor * m.z};
}

/// The gradient whose volume ratio det(I + dt L) is `ratio` (eq. 2.8).
Columns<Lanes> with_volume_ratio(const Columns<Lanes>& gradient, const Lanes& ratio, double dt) {
  Columns<Lanes> f = scaled(gradient, broadcast(dt));
  add_to_diagonal(f, broadcast(1.0));
  const Lanes stretch = cube_root_near_one(ratio / determinant(f));
  // (stretch F - I)/dt without the difference of large numbers
  Columns<Lanes> result = scaled(gradient, stretch);
  add_to_diagonal(result, (stretch - 1.0) / dt);
  return result;
}

void store_gradient(const Step& step, const FourElements& four, const Rows& rows, const Columns<Lanes>& l) {
  const auto place = [&](std::size_t k) { return step.gradient[rows[k]].data(); };
  scatter_columns<3>(four, {l.x, l.y, l.z}, {place(0), place(1), place(2), place(3)});
}

/// Turns vectors by the incremental rotation of the step, that of update_material (docs/theory/material.md,
/// eq. 3 and 4): r = (I - W/2)^-1 (I + W/2), W = dt skw L (I + dt/2 L)^-1.
std::array<Triple<Lanes>, 4> turned(const std::array<Triple<Lanes>, 4>& q, const Columns<Lanes>& l,
                                    double dt) {
  Columns<Lanes> middle = scaled(l, broadcast(0.5 * dt));
  add_to_diagonal(middle, broadcast(1.0));
  const Columns<Lanes> inverse_transposed = cofactors(middle);  // times the determinant
  // dt L (I + dt/2 L)^-1 = 2 (I - (I + dt/2 L)^-1): half of the axial vector of W from the inverse alone.
  const Lanes factor = 0.5 / determinant(middle);
  const Columns<Lanes>& c = inverse_transposed;
  const Triple<Lanes> w = factor * Triple<Lanes>{c.y.z - c.z.y, c.z.x - c.x.z, c.x.y - c.y.x};
  const Lanes scale = 2.0 / (1.0 + dot(w, w));
  std::array<Triple<Lanes>, 4> result;
  for (std::size_t m = 0; m < 4; ++m) {
    const Triple<Lanes> t = cross(w, q[m]);
    result[m] = q[m] + scale * (t + cross(w, t));
  }
  return result;
}

std::array<Triple<Lanes>, 4> hourglass_modes(const Modes<Lanes>& u) {
  return {u.eta_zeta, u.zeta_xi, u.xi_eta, u.xi_eta_zeta};
}

void count_inverted(const FourElements& four, unsigned inverted, DeformationReport& report) {
  for (std::size_t l = 0; l < four.count && inverted != 0; ++l) {
    if ((inverted >> l & 1U) == 0) continue;
    ++report.inverted;
    report.first_inverted = std::min(report.first_inverted, four.index[l]);
  }
}

DeformationReport deform_one_point(const Step& step, const FourElements& four, const Fields& fields) {
  const Modes<Lanes>& x = fields.position;
  GaussPoints& points = step.mesh.points;
  Elements& elements = step.mesh.elements;
  const double dt = step.dt;
  const VolumeGradient<Lanes> beta = volume_gradient(x);
  const Lanes per_volume = 1.0 / beta.volume;
  const Columns<Lanes> l = scaled(mean_gradient_times_volume(fields.end_velocity, beta), per_volume);
  const Columns<Lanes> mean = mean_gradient_times_volume(fields.mean_velocity, beta);
  const VolumeGradient<Lanes> end = volume_gradient(x + dt * fields.end_velocity);
  const Lanes length = one_point_length(end);

  // Work of the stress (eq. 2.7) and of the hourglass forces (eq. 3.6), on the mean velocity.
  Columns<Lanes> stress = deviator_at(points, four.index);
  add_to_diagonal(stress, mean_stress_at(points, four.index));
  const Lanes work = dt * contraction(stress, mean);
  auto q = hourglass_forces_of(elements, four);
  const auto shape = hourglass_modes(x), rate = hourglass_modes(fields.end_velocity),
             mean_rate = hourglass_modes(fields.mean_velocity);
  Lanes hourglass_work{};
  const Columns<Lanes> mean_gradient = scaled(mean, per_volume);
  for (std::size_t m = 0; m < 4; ++m) hourglass_work += dot(q[m], mean_rate[m] - mean_gradient * shape[m]);
  hourglass_work = (root8 * dt) * hourglass_work;

  // Hourglass forces of the next step (eq. 3.3, 3.4).
  const Lanes mass = gather(four, [&](std::size_t e) { return points.mass[e]; });
  const Lanes sound = gather(four, [&](std::size_t e) { return points.sound_speed[e]; });
  const Lanes frequency = root8 * sound * sqrt(beta.squared_norm()) * per_volume;  // bound, eq. (5.1)
  const bool viscous = step.hourglass.kind == HourglassControl::Kind::viscous;
  const Lanes resistance = 0.125 * mass *
                           (viscous ? 2.0 * step.hourglass.coefficient * frequency
                                    : step.hourglass.coefficient * dt * frequency * frequency);
  if (!viscous) q = turned(q, l, dt);
  for (std::size_t m = 0; m < 4; ++m) {
    const Triple<Lanes> increment = (root8 * resistance) * (rate[m] - l * shape[m]);
    q[m] = viscous ? increment : q[m] + increment;
  }

  const auto place = [&](std::size_t k) { return elements.hourglass_force[four.index[k]].data(); };
  scatter_columns<4>(four, q, {place(0), place(1), place(2), place(3)});
  store_gradient(step, four, four.index, with_volume_ratio(l, end.volume * per_volume, dt));
  DeformationReport report;
  for (std::size_t k = 0; k < four.count; ++k) {
    const std::size_t e = four.index[k];
    points.length[e] = length[k];
    points.specific_internal_energy[e] += (work[k] + (viscous ? hourglass_work[k] : 0.0)) / points.mass[e];
    if (!viscous) elements.hourglass_energy[e] += hourglass_work[k];
    report.work += work[k];
    report.hourglass_work += hourglass_work[k];
  }
  count_inverted(four, all_lanes & ~bits(end.volume > 0.0), report);
  return report;
}

DeformationReport deform_b_bar(const Step& step, const FourElements& four, const Fields& fields) {
  const Modes<Lanes>& x = fields.position;
  GaussPoints& points = step.mesh.points;
  const double dt = step.dt;
  const VolumeGradient<Lanes> beta = volume_gradient(x);
  const Modes<Lanes> end_position = x + dt * fields.end_velocity;
  const VolumeGradient<Lanes> end = volume_gradient(end_position);
  const Lanes ratio = end.volume / beta.volume;
  const Columns<Lanes> mean = mean_gradient_times_volume(fields.mean_velocity, beta);
  const Lanes mean_divergence = (mean.x.x + mean.y.y + mean.z.z) / beta.volume;
  DeformationReport report;
  for (std::size_t g = 0; g < 8; ++g) {
    const GaussPoint at(g);
    const Rows rows = at.rows(four);
    const Columns<Lanes> jacobian = at.gradient(x), cofactor = cofactors(jacobian);
    const Lanes det = determinant(jacobian);
    // Velocity gradients: du/dxi J^-1, with rows of the inverse in the columns of the cofactors.
    const auto in_space = [&](const Modes<Lanes>& u) {
      const Columns<Lanes> natural = at.gradient(u);
      Columns<Lanes> l{};
      add_dyad(l, natural.x, cofactor.x);
      add_dyad(l, natural.y, cofactor.y);
      add_dyad(l, natural.z, cofactor.z);
      return l;  // times the determinant
    };
    const Columns<Lanes> mean_gradient = in_space(fields.mean_velocity);
    const Lanes work = dt * (contraction(deviator_at(points, rows), mean_gradient) +
                             det * mean_stress_at(points, rows) * mean_divergence);
    store_gradient(step, four, rows,
                   with_volume_ratio(scaled(in_space(fields.end_velocity), 1.0 / det), ratio, dt));
    for (std::size_t k = 0; k < four.count; ++k) {
      points.specific_internal_energy[rows[k]] += work[k] / points.mass[rows[k]];
      report.work += work[k];
    }
  }
  const auto [length, least_jacobian] = eight_point_size(end_position, end);
  for (std::size_t k = 0; k < four.count; ++k) {
    std::fill_n(points.length.begin() + static_cast<std::ptrdiff_t>(8 * four.index[k]), 8, length[k]);
  }
  count_inverted(four, all_lanes & ~bits(least_jacobian > 0.0), report);
  return report;
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
                         std::span<Matrix3> velocity_gradient) {
  if (velocity_gradient.size() != mesh.points.size() || motion.end.size() != mesh.nodes.size() ||
      motion.mean.size() != mesh.nodes.size()) {
    throw InternalError("fem::deform: velocities or gradients do not fit the mesh");
  }
  const Step step{mesh, dt, hourglass, velocity_gradient};
  const std::size_t elements = mesh.elements.size();
  return parallel::sum<DeformationReport>(FourElements::groups(elements), [&](std::size_t group) {
    const FourElements four(group, elements);
    const auto& corners = mesh.elements.corners;
    const Fields fields = {gather_modes(four, corners, mesh.nodes.position),
                           gather_modes(four, corners, motion.mean), gather_modes(four, corners, motion.end)};
    return mesh.quadrature == Quadrature::one_point ? deform_one_point(step, four, fields)
                                                    : deform_b_bar(step, four, fields);
  });
}

}  // namespace whipple::fem
