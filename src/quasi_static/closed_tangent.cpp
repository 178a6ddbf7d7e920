// SPDX-License-Identifier: BSD-3-Clause
#include "src/quasi_static/closed_tangent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <vector>

#include "src/material/eos_strength/eos_strength.hpp"
#include "src/material/hyperelastic/model.hpp"
#include "src/material/hyperelastic/neo_hookean.hpp"
#include "src/material/strength/drucker_prager.hpp"
#include "src/material/strength/elastic.hpp"
#include "src/material/strength/von_mises.hpp"
#include "src/quasi_static/loops.hpp"

namespace whipple::quasi_static {
namespace {

Matrix3 deviator(const Matrix3& a) { return a - a.trace() / 3.0 * Matrix3::Identity(); }
Matrix3 symmetric(const Matrix3& a) { return 0.5 * (a + a.transpose()); }
double contracted(const Matrix3& a, const Matrix3& b) { return a.cwiseProduct(b).sum(); }

/// Holds the slopes of the equation of state of the points of a group at the end of the step.
struct PressureSlopes {
  std::vector<double> squared_speed;  ///< c^2, m^2/s^2
  std::vector<double> by_energy;      ///< dp/de at constant density, kg/m^3

  /// @param energy      of the equation of state, J/kg
  /// @param distension  of the points; empty: none
  PressureSlopes(const eos::EquationOfState& eos, const std::vector<double>& density,
                 std::vector<double> energy, const std::vector<double>& distension)
      : squared_speed(density.size()), by_energy(density.size()) {
    const std::size_t n = density.size();
    std::vector<double> pressure(n), moved(n), temperature(n), speed(n), distended;
    const auto evaluate = [&](std::vector<double>& p) {
      distended = distension;
      static_cast<void>(eos.evaluate({density, energy, p, temperature, speed, {}, {}, distended}));
    };
    evaluate(pressure);
    for (std::size_t i = 0; i < n; ++i) {
      squared_speed[i] = speed[i] * speed[i];
      energy[i] += step_of(i);
    }
    evaluate(moved);
    for (std::size_t i = 0; i < n; ++i) by_energy[i] = (moved[i] - pressure[i]) / step_of(i);
  }

 private:
  /// Returns the difference of energy for its slope: pressures are almost linear in it.
  [[nodiscard]] double step_of(std::size_t i) const { return 1e-4 * squared_speed[i] + 1e-30; }
};

/// Holds a point at both ends of the step.
struct Point {
  double mass, old_volume, volume;  // of the material, kg, m^3
  double old_pressure, pressure;    // Pa
  double squared_speed, by_energy;  // of the equation of state
  Matrix3 old_stress, stress;       // deviators, Pa
  bool open;                        // has a void: its pressure and volume stay
};

/// Strain increment e and rotation R of a step (eq. 2 to 4 of material.md) with their derivatives by f, which are products
/// of vectors: d(m) = (1 - m/2) df (1/2 (f + 1))^-1.
struct Motion {
  Matrix3 strain, rotation, left, right, turn, turned;

  explicit Motion(const Matrix3& f) {
    const Matrix3 identity = Matrix3::Identity();
    right = (0.5 * (f + identity)).inverse();
    const Matrix3 m = (f - identity) * right;
    left = identity - 0.5 * m;
    strain = symmetric(m);
    const Matrix3 half_spin = 0.25 * (m - m.transpose());
    turn = (identity - half_spin).inverse();
    rotation = turn * (identity + half_spin);
    turned = rotation + identity;
  }
  /// Returns the derivative of the strain increment by component (row, column) of f.
  [[nodiscard]] Matrix3 strain_by(int row, int column) const {
    return symmetric(left.col(row) * right.row(column));
  }
  /// Returns the derivative of R s R^T, from (R + 1) s R^T.
  [[nodiscard]] Matrix3 rotated_by(int row, int column, const Matrix3& turned_stress) const {
    const Vector3 a = turn * left.col(row), b = turn * right.row(column).transpose();
    const Vector3 on_a = turned_stress.transpose() * left.col(row),
                  on_b = turned_stress.transpose() * right.row(column).transpose();
    const Matrix3 half = 0.25 * (a * on_b.transpose() - b * on_a.transpose());
    return half + half.transpose();
  }
};

/// Returns the derivative of the pressure (eq. 12). The work of the pressure is that on the change of material and void,
/// V^n (J - 1), as in the update.
/// @param ratio       J of the step
/// @param log_volume  derivative of ln J
/// @param work        of the work that is not that of the pressure, J
double pressure_by(const Point& q, double ratio, double log_volume, double work) {
  const double density = q.mass / q.volume, half_change = 0.5 * q.old_volume * (ratio - 1.0) / q.mass;
  const double mean = 0.5 * (q.pressure + q.old_pressure) * q.old_volume * ratio;
  const double heat = (work + (q.pressure * q.volume - mean) * log_volume) / q.mass;
  return (q.by_energy * heat - q.squared_speed * density * log_volume) / (1.0 + half_change * q.by_energy);
}

/// Returns the derivative of the work of the deviators on the strain of the step, J (eq. 14 of material.md).
double work_by(const Point& q, const Motion& motion, const Matrix3& stress, double log_volume,
               const Matrix3& strain_by, const Matrix3& stress_by) {
  const Matrix3 mean = 0.5 * (q.old_stress + stress);
  const double rate = contracted(mean, strain_by) + 0.5 * contracted(stress_by, motion.strain);
  return 0.5 * (q.volume + q.old_volume) * rate +
         0.5 * q.volume * log_volume * contracted(mean, motion.strain);
}

/// Writes the column of dT/df of one component of f (eq. 13).
/// @param cauchy       sigma f^-T, Pa
/// @param by           derivative of sigma
void write(const Point& q, const Matrix3& inverse, const Matrix3& cauchy, double log_volume,
           const Matrix3& by, int strains, int k, double* tangent) {
  const auto [row, column] = component(strains, k);
  const Matrix3 change =
      log_volume * cauchy + by * inverse.transpose() - cauchy.col(column) * inverse.transpose().row(row);
  for (int i = 0; i < strains; ++i) {
    const auto [at, of] = component(strains, i);
    tangent[i * strains + k] = q.volume * change(at, of);
  }
}

/// Computes the tangent of a point of a law that returns the deviator to a strength (eq. 9 to 13).
/// @param returned  of the point, without trial and pressure
/// @param late      whether the law returns after the pressure is known: the work is that of the trial
template <class Law>
void tangent_of(const Law& law, strength::ReturnedPoint returned, bool late, const Point& q, const Matrix3& f,
                int strains, double* tangent) {
  const Motion motion(f);
  const Matrix3 turned = motion.turned * q.old_stress * motion.rotation.transpose();
  const Matrix3 trial = motion.rotation * q.old_stress * motion.rotation.transpose() +
                        2.0 * returned.modulus * deviator(motion.strain);
  returned.trial = std::sqrt(1.5 * trial.squaredNorm());
  returned.pressure = q.pressure;
  const strength::ReturnSlopes slopes = law.slopes(returned);
  const double kept = returned.flows ? std::sqrt(1.5 * q.stress.squaredNorm()) / returned.trial : 1.0;
  const Matrix3 inverse = f.inverse();
  const double ratio = f.determinant();
  Matrix3 sigma = q.stress;
  sigma.diagonal().array() -= q.pressure;
  const Matrix3 cauchy = sigma * inverse.transpose();
  for (int k = 0; k < strains; ++k) {
    const auto [row, column] = component(strains, k);
    const double log_volume = q.open ? 0.0 : inverse(column, row);
    const Matrix3 strain_by = motion.strain_by(row, column);
    const Matrix3 trial_by =
        motion.rotated_by(row, column, turned) + 2.0 * returned.modulus * deviator(strain_by);
    const double q_by = returned.trial > 0.0 ? 1.5 * contracted(trial, trial_by) / returned.trial : 0.0;
    const auto stress_by = [&](double pressure_by) -> Matrix3 {
      if (!returned.flows) return Matrix3(trial_by);
      const double by = slopes.stress_by_trial * q_by + slopes.stress_by_pressure * pressure_by;
      return kept * trial_by + (by - kept * q_by) / returned.trial * trial;
    };
    double p_by = 0.0;
    if (!q.open) {
      const Matrix3 working = late ? trial_by : stress_by(0.0);
      p_by = pressure_by(q, ratio, log_volume,
                         work_by(q, motion, late ? trial : q.stress, log_volume, strain_by, working));
      p_by += returned.stiffness * (slopes.growth_by_trial * q_by + slopes.growth_by_pressure * p_by);
    }
    Matrix3 by = stress_by(p_by);
    by.diagonal().array() -= p_by;
    write(q, inverse, cauchy, log_volume, by, strains, k, tangent);
  }
}

/// Returns the points of a group, with the slopes of their equation of state.
/// @param elastic  energy that the equation of state does not hold, J/kg, of the points of the group; empty: none
std::vector<Point> points_of(const Group& group, const Particles& before, const MaterialPoints& after,
                             std::span<const double> elastic, const std::vector<double>& distension) {
  std::vector<double> density(group.count), energy(group.count), distended;
  if (!distension.empty()) distended.resize(group.count);
  for (std::size_t i = 0; i < group.count; ++i) {
    const std::size_t p = group.first + i;
    density[i] = after.mass[p] / after.volume[p];
    energy[i] = after.specific_internal_energy[p] - (elastic.empty() ? 0.0 : elastic[i]);
    if (!distended.empty()) distended[i] = distension[p];
  }
  const PressureSlopes slopes(*group.material->eos, density, energy, distended);
  std::vector<Point> points(group.count);
  for (std::size_t i = 0; i < group.count; ++i) {
    const std::size_t p = group.first + i;
    points[i] = {.mass = after.mass[p],
                 .old_volume = before.volume[p],
                 .volume = after.volume[p],
                 .old_pressure = before.pressure[p],
                 .pressure = after.pressure[p],
                 .squared_speed = slopes.squared_speed[i],
                 .by_energy = slopes.by_energy[i],
                 .old_stress = before.deviatoric_stress[p].matrix(),
                 .stress = after.deviatoric_stress[p].matrix(),
                 .open = after.void_volume[p] > 0.0};
  }
  return points;
}

/// Computes the tangents of a group whose strength is a law.
template <class Law>
void of_strength(const Law& law, const Group& group, const Particles& before, const MaterialPoints& after,
                 std::span<const Matrix3> f, int strains, std::span<double> tangents) {
  const bool late = group.material->strength->brittle() != nullptr;
  const bool dilates = late && group.material->strength->brittle()->dilates();
  const std::vector<double> none;
  const std::vector<double>& distension = dilates ? after.history.scalar("distension") : none;
  const std::vector<double>& old_distension = dilates ? before.history.scalar("distension") : none;
  const std::vector<Point> points = points_of(group, before, after, {}, distension);
  const double modulus = law.stiffness();
  for_each(group.count, [&](std::size_t i) {
    const std::size_t p = group.first + i;
    const Point& q = points[i];
    strength::ReturnedPoint returned{
        .trial = 0.0,
        .plastic_strain = before.plastic_strain[p],
        .flows = after.plastic_strain[p] > before.plastic_strain[p],
        .modulus = modulus,
        .factor = before.strength_factor.empty() ? 1.0 : before.strength_factor[p],
        .pressure = 0.0};
    if (dilates) {
      const double density = q.mass / q.volume;
      const double by_density = q.squared_speed - q.pressure * q.by_energy / (density * density);
      returned.stiffness = density * by_density - q.pressure;
      returned.distension = old_distension[p];
      returned.growth = std::log(distension[p] / old_distension[p]);
    }
    const auto m = static_cast<std::size_t>(strains);
    tangent_of(law, returned, late, q, f[p], strains, &tangents[m * m * p]);
  });
}

/// Computes the tangents of a group of neo-Hookean rubber: s = G J^(-5/3) dev F F^T.
void of_rubber(const material::NeoHookean& law, const Group& group, const Particles& before,
               const MaterialPoints& after, std::span<const Matrix3> f, int strains,
               std::span<double> tangents) {
  const std::vector<Matrix3>& deformation = after.history.values<Matrix3>("deformation_gradient");
  const double undeformed = 1.0 / group.material->reference.density, shear = law.shear();
  const auto isochoric = [&](std::size_t p) -> Matrix3 {
    const double determinant = deformation[p].determinant();
    return deformation[p] * deformation[p].transpose() / std::cbrt(determinant * determinant);
  };
  std::vector<double> elastic(group.count);
  for (std::size_t i = 0; i < group.count; ++i) {
    elastic[i] = 0.5 * undeformed * shear * (isochoric(group.first + i).trace() - 3.0);
  }
  const std::vector<Point> points = points_of(group, before, after, elastic, {});
  for_each(group.count, [&](std::size_t i) {
    const std::size_t p = group.first + i;
    const Point& q = points[i];
    const Motion motion(f[p]);
    const Matrix3 b = isochoric(p), inverse = f[p].inverse();
    const double per_volume = undeformed * q.mass / q.volume;  // 1/J
    Matrix3 sigma = q.stress;
    sigma.diagonal().array() -= q.pressure;
    const Matrix3 cauchy = sigma * inverse.transpose();
    for (int k = 0; k < strains; ++k) {
      const auto [row, column] = component(strains, k);
      const double log_volume = inverse(column, row);
      Matrix3 b_by = Matrix3::Zero();  // l b + b l^T less 2/3 tr(l) b, l = df f^-1
      b_by.row(row) = inverse.row(column) * b;
      b_by = (b_by + b_by.transpose()).eval();
      b_by -= 2.0 / 3.0 * log_volume * b;
      Matrix3 by = per_volume * shear * deviator(b_by) - log_volume * q.stress;
      const double work = work_by(q, motion, q.stress, log_volume, motion.strain_by(row, column), by) -
                          0.5 * undeformed * shear * b_by.trace() * q.mass;
      by.diagonal().array() -= pressure_by(q, f[p].determinant(), log_volume, work);
      const auto m = static_cast<std::size_t>(strains);
      write(q, inverse, cauchy, log_volume, by, strains, k, &tangents[m * m * p]);
    }
  });
}

/// Returns whether all points of a group are solid and intact, and without voids unless those are allowed.
bool are_solid(const Group& group, const MaterialPoints& after, bool may_open) {
  for (std::size_t p = group.first; p < group.first + group.count; ++p) {
    if (after.failed[p] != 0 || after.melted_fraction[p] > 0.0) return false;
    if (!may_open && after.void_volume[p] > 0.0) return false;
  }
  return true;
}

}  // namespace

bool closed_tangents(const Group& group, const Particles& before, const MaterialPoints& after,
                     std::span<const Matrix3> f, int strains, std::span<double> tangents) {
  const Material& material = *group.material;
  if (const auto* rubber = dynamic_cast<const material::HyperelasticModel<material::NeoHookean>*>(
          material.constitutive.get())) {
    if (!rubber->law().relaxation.fractions.empty()) return false;
    of_rubber(rubber->law(), group, before, after, f, strains, tangents);
    return true;
  }
  if (dynamic_cast<const material::EosStrength*>(material.constitutive.get()) == nullptr ||
      !material.failure.empty() || material.eos->initial_distension() > 1.0 ||
      material.strength->kinematic_modulus() > 0.0 ||
      group.settings.rotation != material::StressRotation::hughes_winget)
    return false;
  const strength::Strength* const strength = material.strength.get();
  if (!are_solid(group, after, strength->brittle() != nullptr)) return false;
  const auto is = [&]<class Model>(std::type_identity<Model>) {
    const auto* model = dynamic_cast<const Model*>(strength);
    if (model != nullptr) of_strength(model->law(), group, before, after, f, strains, tangents);
    return model != nullptr;
  };
  return is(std::type_identity<strength::ElasticModel>{}) ||
         is(std::type_identity<strength::VonMisesModel>{}) ||
         is(std::type_identity<strength::DruckerPragerModel>{});
}

}  // namespace whipple::quasi_static
