// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "src/core/base/error.hpp"
#include "src/material/material.hpp"
#include "src/material/strength/johnson_cook.hpp"
#include "src/material/strength/none.hpp"
#include "src/material/strength/von_mises.hpp"
#include "src/material/update.hpp"

/// What the tests of the material share: an equation of state simple enough to be known in closed form,
/// materials on it, and points.
namespace whipple::material_test {

/// p = A(rho) + B(rho) e on a linear Hugoniot, with a melted fraction that rises linearly between two
/// energies: a stand-in whose pressure, sound speed and melting are known in closed form (written down here
/// independently of eos/models).
struct LinearInEnergy : eos::EquationOfState {
  double rho0 = 8930.0, c0 = 3940.0, s = 1.49, gamma = 1.96, heat_capacity = 383.0;
  double melting_starts = 1e30, melting_ends = 2e30;  // J/kg
  double boiling_starts = 1e30;                       // J/kg; a tenth of the material is vapour from there on

  void coefficients(double rho, double& a, double& b, double& da) const {
    const double mu = 1.0 - rho0 / rho;
    if (mu > 0.0) {
      const double k = std::max(1.0 - s * mu, 0.05);
      const double hugoniot = rho0 * c0 * c0 * mu / (k * k);
      const double slope = rho0 * c0 * c0 * (1.0 + s * mu) / (k * k * k);
      a = hugoniot * (1.0 - 0.5 * gamma * mu);
      b = gamma * rho0;
      da = rho0 / (rho * rho) * (slope * (1.0 - 0.5 * gamma * mu) - 0.5 * gamma * hugoniot);
    } else {
      a = c0 * c0 * (rho - rho0);
      b = gamma * rho;
      da = c0 * c0;
    }
  }
  [[nodiscard]] double pressure(double rho, double e) const {
    double a, b, da;
    coefficients(rho, a, b, da);
    return a + b * e;
  }
  [[nodiscard]] double sound_squared(double rho, double e) const {
    double a, b, da;
    coefficients(rho, a, b, da);
    const double db = rho < rho0 ? gamma : 0.0;
    return da + db * e + b * std::max(a + b * e, 0.0) / (rho * rho);
  }
  [[nodiscard]] double melted(double e) const {
    return std::clamp((e - melting_starts) / (melting_ends - melting_starts), 0.0, 1.0);
  }

  [[nodiscard]] double vaporised(double e) const { return e < boiling_starts ? 0.0 : 0.1; }

  [[nodiscard]] std::string_view model() const override { return "linear_in_energy"; }
  [[nodiscard]] double reference_density() const override { return rho0; }
  [[nodiscard]] double reference_temperature() const override { return 300.0; }
  [[nodiscard]] double minimum_energy(double) const override { return -heat_capacity * 300.0; }
  [[nodiscard]] double least_temperature() const override { return 0.0; }
  [[nodiscard]] double reference_energy() const override { return 0.0; }
  [[nodiscard]] double maximum_density() const override { return 2.0 * rho0; }
  eos::RangeReport evaluate(const eos::Batch& batch) const override {
    eos::RangeReport report;
    for (std::size_t i = 0; i < batch.density.size(); ++i) {
      const double rho = batch.density[i];
      const double e = batch.specific_internal_energy[i];
      if (!(rho > 0.0 && rho < maximum_density())) {
        if (report.first == eos::RangeReport::none) report.first = i;
        ++report.out_of_range;
        report.bound = "density";
      }
      batch.pressure[i] = pressure(rho, e);
      batch.temperature[i] = 300.0 + e / heat_capacity;
      batch.sound_speed[i] = std::sqrt(std::max(sound_squared(rho, e), 1.0));
      batch.melted_fraction[i] = melted(e);
      batch.vaporised_fraction[i] = vaporised(e);
    }
    return report;
  }
  [[nodiscard]] eos::State state(double density, double e) const override {
    eos::State result;
    result.density = density;
    result.specific_internal_energy = e;
    result.temperature = 300.0 + e / heat_capacity;
    result.pressure = pressure(density, e);
    result.sound_speed = std::sqrt(sound_squared(density, e));
    result.melted_fraction = melted(e);
    result.vaporised_fraction = vaporised(e);
    return result;
  }
  [[nodiscard]] eos::State state_at_temperature(double density, double temperature) const override {
    return state(density, (temperature - 300.0) * heat_capacity);
  }
  [[nodiscard]] std::string constants() const override { return ""; }
};

inline strength::VonMises taylor_copper() {
  strength::VonMises constants;
  constants.shear_modulus = 117e9 / 2.7;
  constants.yield_stress = 157e6;
  constants.hardening_modulus = 425e6;
  return constants;
}

inline strength::JohnsonCook ofhc_copper() {
  strength::JohnsonCook constants;
  constants.shear_modulus = 47.7e9;
  constants.yield_stress = 90e6;
  constants.hardening_coefficient = 292e6;
  constants.hardening_exponent = 0.31;
  constants.rate_coefficient = 0.025;
  constants.reference_rate = 1.0;
  constants.thermal_exponent = 1.09;
  constants.reference_temperature = 294.0;
  constants.melting_temperature = 1356.0;
  return constants;
}

inline Material with(const strength::VonMises& constants,
                     std::vector<std::shared_ptr<const failure::Criterion>> failure = {},
                     const LinearInEnergy& eos = {}) {
  return make_material("test", std::make_shared<LinearInEnergy>(eos),
                       std::make_shared<strength::VonMisesModel>(constants), std::move(failure));
}

/// n points of 1 mm^3 at the reference state of the material.
inline MaterialPoints points_of(const Material& material, std::size_t n) {
  MaterialPoints points;
  resize(points, n);
  for (double& mass : points.mass) mass = material.reference.density * 1e-9;
  initialise(material, points, 0, n);
  return points;
}

/// Settings of a step without artificial viscosity.
constexpr UpdateSettings without_viscosity(double dt) {
  return {.time_step = dt, .cell_size = 1e-3, .linear_viscosity = 0.0, .quadratic_viscosity = 0.0};
}

/// Velocity gradient that takes the configuration F0 to F1 in dt: x1 = (I + dt L) x0.
inline Matrix3 gradient_between(const Matrix3& f0, const Matrix3& f1, double dt) {
  return (f1 * f0.inverse() - Matrix3::Identity()) / dt;
}

/// Volume ratio of a step.
inline double volume_ratio(const Matrix3& gradient, double dt) {
  return (Matrix3::Identity() + dt * gradient).determinant();
}

/// von Mises stress of a deviator.
inline double equivalent_stress(const SymmetricTensor& deviator) {
  return std::sqrt(1.5 * deviator.squared_norm());
}

inline Matrix3 random_matrix(std::mt19937_64& generator, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  Matrix3 m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) m(i, j) = uniform(generator);
  }
  return m;
}

/// One step of one point under the exact work identity of a homogeneous body, as the symplectic scheme does:
/// the energy changes by the work of the stress at the beginning of the step on the mean of the velocities
/// before and after the forces of the step, so the gradient of the step before counts half.
inline MaterialReport step_with_work(const Material& material, MaterialPoints& points,
                                     const Matrix3& gradient, const UpdateSettings& settings,
                                     const Matrix3& gradient_before) {
  const SymmetricTensor& s = points.deviatoric_stress[0];
  const Matrix3 stress =
      s.matrix() - (points.pressure[0] + points.artificial_viscosity[0]) * Matrix3::Identity();
  const Matrix3 mean = 0.5 * (gradient + gradient_before);
  points.specific_internal_energy[0] +=
      settings.time_step * points.volume[0] / points.mass[0] * stress.cwiseProduct(mean).sum();
  return update_material(material, points, 0, 1, std::span(&gradient, 1), settings);
}
/// The same in a steady motion.
inline MaterialReport step_with_work(const Material& material, MaterialPoints& points,
                                     const Matrix3& gradient, const UpdateSettings& settings) {
  return step_with_work(material, points, gradient, settings, gradient);
}

}  // namespace whipple::material_test
