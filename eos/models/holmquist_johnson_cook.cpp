// SPDX-License-Identifier: BSD-3-Clause
// Equation numbers: docs/theory/concrete_and_ceramics.md.
#include "eos/models/holmquist_johnson_cook.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "eos/model_equation_of_state.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr double greatest_grain_compression = 1.0;  ///< m; the fits end far below

}  // namespace

ParameterTable<HolmquistJohnsonCookConstants> HolmquistJohnsonCook::parameters() {
  using C = HolmquistJohnsonCookConstants;
  return {
      real("reference_density", &C::reference_density, "kg/m^3", range::positive(), "rho0, with the pores"),
      real("crush_pressure", &C::crush_pressure, "Pa", range::positive(),
           "p_crush, at which the pores begin to collapse"),
      real("crush_compression", &C::crush_compression, "", range::positive(), "mu_crush, there"),
      real("lock_pressure", &C::lock_pressure, "Pa", range::positive(), "p_lock, at which all are closed"),
      real("lock_compression", &C::lock_compression, "", range::positive(),
           "mu_lock: density of the grains over rho0, less 1"),
      real("K1", &C::K1, "Pa", range::positive(),
           "factor of m = (mu - mu_lock)/(1 + mu_lock), without pores"),
      real("K2", &C::K2, "Pa", range::any(), "factor of m^2, in compression").optional(),
      real("K3", &C::K3, "Pa", range::any(), "factor of m^3, in compression").optional(),
      real("heat_capacity", &C::heat_capacity, "J/(kg K)", range::positive(), "c_v, constant"),
      real("reference_temperature", &C::reference_temperature, "K", range::positive(), "T0").optional(),
  };
}

HolmquistJohnsonCook::HolmquistJohnsonCook(const Constants& k)
    : constants_(k),
      grain_density_(k.reference_density * (1 + k.lock_compression)),
      intact_modulus_(k.crush_pressure / k.crush_compression),
      distension_(1 + k.lock_compression) {
  if (!(k.lock_pressure > k.crush_pressure)) {
    throw InputError(fmt::format("{}: lock_pressure ({:.6g} Pa) must be above crush_pressure ({:.6g} Pa)",
                                 name, k.lock_pressure, k.crush_pressure));
  }
  // End of the curve of the grains: its slope K1 + 2 K2 m + 3 K3 m^2 vanishes, or the bound is reached.
  double limit = greatest_grain_compression;
  const double square = k.K2 * k.K2 - 3 * k.K1 * k.K3;
  if (square >= 0) {
    const double turn = -k.K1 / (k.K2 - std::sqrt(square));
    if (turn > 0) limit = std::min(limit, turn);
  }
  maximum_density_ = grain_density_ * (1 + limit);
  const auto of_grains = [&](double m) { return m * (k.K1 + m * (k.K2 + m * k.K3)); };
  if (!(of_grains(limit) > k.lock_pressure)) {
    throw InputError(
        fmt::format("{}: the pressure without pores does not reach lock_pressure (K1, K2, K3)", name));
  }
  double low = 0, high = limit;
  while (high - low > 1e-15 * limit) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (of_grains(middle) < k.lock_pressure ? low : high) = middle;
  }
  locked_compression_ = k.lock_compression + high * (1 + k.lock_compression);
  if (!(locked_compression_ > k.crush_compression)) {
    throw InputError(fmt::format("{}: lock_compression must lie above crush_compression", name));
  }
  locked_modulus_ = k.lock_pressure / (locked_compression_ - k.lock_compression);
  // The compression at rest must increase along the crushing line; its slope is smallest at one of the ends.
  const double a = k.crush_pressure, b = k.lock_pressure - a, c = intact_modulus_, d = locked_modulus_ - c;
  const double softer = std::min(c, c + d);
  if (!(locked_compression_ - k.crush_compression > (b * c - a * d) / (softer * softer)) ||
      !(intact_modulus_ * (locked_compression_ - k.crush_compression) > b)) {
    throw InputError(
        fmt::format("{}: crushed material would unload to less than its own compression: crush_pressure over "
                    "crush_compression must be steeper than the line from there to the lock pressure",
                    name));
  }
}

HolmquistJohnsonCook::Path HolmquistJohnsonCook::path(double crushed) const {  // (2), (3)
  const Constants& k = constants_;
  const double mu = k.crush_compression + crushed * (locked_compression_ - k.crush_compression);
  const double pressure = k.crush_pressure + crushed * (k.lock_pressure - k.crush_pressure);
  const double modulus = intact_modulus_ + crushed * (locked_modulus_ - intact_modulus_);
  return {mu, pressure, modulus, mu - pressure / modulus};
}

/// Solves rest(F) = mu_p, a quadratic in F.
double HolmquistJohnsonCook::crushed_share(double distension) const {
  const Constants& k = constants_;
  const double rest = (1 + k.lock_compression) / distension - 1;
  if (rest <= 0) return 0;
  const double span = locked_compression_ - k.crush_compression, d = locked_modulus_ - intact_modulus_;
  const double b =
      span * intact_modulus_ - (k.lock_pressure - k.crush_pressure) - (rest - k.crush_compression) * d;
  const double square = b * b + 4 * span * d * intact_modulus_ * rest;
  return std::min(1.0, 2 * intact_modulus_ * rest / (b + std::sqrt(std::max(square, 0.0))));
}

HolmquistJohnsonCook::Response HolmquistJohnsonCook::respond(double density, double& distension) const {
  const Constants& k = constants_;
  const double mu = density / k.reference_density - 1;
  if (distension > 1) {
    Path line = path(crushed_share(distension));
    const bool crushes = crushable_ && mu > line.greatest_compression;
    if (!crushes || mu < locked_compression_) {
      if (crushes) {
        line = path((mu - k.crush_compression) / (locked_compression_ - k.crush_compression));
        distension = std::min(distension, (1 + k.lock_compression) / (1 + line.rest));
      }
      const double x = (mu - line.rest) / (1 + line.rest);
      const double pressure = crushes ? line.greatest_pressure : line.modulus * (mu - line.rest);
      return {pressure, line.modulus,
              line.modulus / k.reference_density * (std::log1p(x) - x / (1 + x))};  // (4)
    }
    distension = 1;
  }
  const double m = (mu - k.lock_compression) / (1 + k.lock_compression);
  const double K2 = m > 0 ? k.K2 : 0, K3 = m > 0 ? k.K3 : 0;
  const double logarithm = std::log1p(m), share = m / (1 + m);
  const double energy = k.K1 * (logarithm - share) + K2 * (m + share - 2 * logarithm) +
                        K3 * (0.5 * m * m - 2 * m - share + 3 * logarithm);
  return {m * (k.K1 + m * (K2 + m * K3)), (k.K1 + m * (2 * K2 + 3 * K3 * m)) / (1 + k.lock_compression),
          energy / grain_density_};
}

std::string_view HolmquistJohnsonCook::broken_bound(double density, double energy) const {
  if (!(density > 0) || !std::isfinite(density)) return "density must be positive and finite";
  if (!std::isfinite(energy)) return "specific internal energy must be finite";
  if (density > maximum_density_) return "density above the compression limit";
  return "";
}

RangeReport HolmquistJohnsonCook::evaluate(const Batch& batch) const {
  const Constants& k = constants_;
  RangeReport report;
  for (std::size_t i = 0; i < batch.density.size(); ++i) {
    const double density = batch.density[i], energy = batch.specific_internal_energy[i];
    if (!batch.melted_fraction.empty()) batch.melted_fraction[i] = 0;
    if (!batch.vaporised_fraction.empty()) batch.vaporised_fraction[i] = 0;
    if (const std::string_view bound = broken_bound(density, energy); !bound.empty()) {
      if (report.out_of_range++ == 0) {
        report.first = i;
        report.bound = bound;
      }
      batch.pressure[i] = batch.temperature[i] = batch.sound_speed[i] = State::unknown;
      continue;
    }
    double distension = batch.distension.empty() ? distension_ : batch.distension[i];
    const Response r = respond(density, distension);
    if (!batch.distension.empty()) batch.distension[i] = distension;
    const double temperature = k.reference_temperature + (energy - r.recoverable_energy) / k.heat_capacity;
    report.below_cold_curve += temperature < least_temperature ? 1 : 0;
    batch.pressure[i] = r.pressure;
    batch.temperature[i] = std::max(temperature, least_temperature);
    batch.sound_speed[i] = std::sqrt(r.modulus / k.reference_density);
  }
  return report;
}

State HolmquistJohnsonCook::state(double density, double specific_internal_energy) const {
  if (const std::string_view bound = broken_bound(density, specific_internal_energy); !bound.empty()) {
    throw StateError(
        fmt::format("{}: {} (density {:.6g} kg/m^3, compression limit {:.6g} kg/m^3, specific internal "
                    "energy {:.6g} J/kg)",
                    name, bound, density, maximum_density_, specific_internal_energy));
  }
  State s;
  s.density = density;
  s.specific_internal_energy = specific_internal_energy;
  s.distension = distension_;
  const Response r = respond(density, s.distension);
  const Constants& k = constants_;
  s.temperature =
      std::max(k.reference_temperature + (specific_internal_energy - r.recoverable_energy) / k.heat_capacity,
               least_temperature);
  s.pressure = r.pressure;
  s.sound_speed = std::sqrt(r.modulus / k.reference_density);
  s.specific_entropy = k.heat_capacity * std::log(s.temperature / k.reference_temperature);
  s.heat_capacity = k.heat_capacity;
  s.gruneisen = 0;
  s.isothermal_bulk_modulus = density * r.modulus / k.reference_density;
  s.phase = s.distension == distension_ ? "solid" : s.distension > 1 ? "compacting" : "compacted";
  return s;
}

State HolmquistJohnsonCook::state_at_temperature(double density, double temperature) const {
  if (!(temperature >= least_temperature) || !std::isfinite(temperature)) {
    throw StateError(fmt::format("{}: temperature must be finite and at least {} K, not {}", name,
                                 least_temperature, temperature));
  }
  if (!broken_bound(density, 0).empty()) return state(density, 0);  // throws
  double distension = distension_;
  const double cold = respond(density, distension).recoverable_energy;
  return state(density, cold + constants_.heat_capacity * (temperature - constants_.reference_temperature));
}

std::unique_ptr<EquationOfState> HolmquistJohnsonCook::unloading(const State& from) const {
  HolmquistJohnsonCook held = *this;
  held.distension_ = from.distension;
  held.crushable_ = false;
  return std::make_unique<ModelEquationOfState<HolmquistJohnsonCook>>(held);
}

}  // namespace whipple::eos
