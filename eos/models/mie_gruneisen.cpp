// SPDX-License-Identifier: BSD-3-Clause
// Equation numbers: docs/theory/equations_of_state.md.
#include "eos/models/mie_gruneisen.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "src/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr double pole_margin = 0.05;          ///< least 1 - s eta
constexpr double greatest_compression = 0.9;  ///< greatest eta
constexpr int table_intervals = 512;

}  // namespace

ParameterTable<MieGruneisenConstants> MieGruneisen::parameters() {
  using C = MieGruneisenConstants;
  return {
      real("reference_density", &C::reference_density, "kg/m^3", range::positive(),
           "rho0, density at the reference temperature and zero pressure"),
      real("hugoniot_intercept", &C::hugoniot_intercept, "m/s", range::positive(),
           "c0 of the linear shock Hugoniot Us = c0 + s up"),
      real("hugoniot_slope", &C::hugoniot_slope, "", range::positive(), "s of Us = c0 + s up"),
      real("gruneisen", &C::gruneisen, "", range::positive(), "Gamma0, Grueneisen parameter at rho0"),
      choice("gruneisen_law", &C::gruneisen_law, {"constant_product", "constant"},
             "rho Gamma constant in compression, or Gamma constant")
          .optional(),
      real("heat_capacity", &C::heat_capacity, "J/(kg K)", range::positive(), "c_v, constant"),
      real("reference_temperature", &C::reference_temperature, "K", range::positive(), "T0").optional(),
  };
}

/// One point.
struct MieGruneisen::Point {
  double density = 0, energy = 0, pressure = 0, temperature = 0, squared_sound_speed = 0, gruneisen = 0;
  double isentrope_temperature = 0;
  bool cold = false;
  std::string_view broken;
};

MieGruneisen::MieGruneisen(const Constants& constants)
    : constants_(constants), constant_product_(constants.gruneisen_law == "constant_product") {
  find_limit();
  tabulate_isentrope();
}

MieGruneisen::Coefficients MieGruneisen::coefficients(double rho) const {
  const Constants& k = constants_;
  const double rho0 = k.reference_density, c2 = k.hugoniot_intercept * k.hugoniot_intercept;
  if (rho <= rho0) {  // (M4)
    return {c2 * (rho - rho0), k.gruneisen * rho, c2, k.gruneisen};
  }
  const double eta = 1 - rho0 / rho, eta_slope = rho0 / (rho * rho);
  const double y = 1 - k.hugoniot_slope * eta;
  const double hugoniot = rho0 * c2 * eta / (y * y);                                     // (M1)
  const double hugoniot_slope = rho0 * c2 * (1 + k.hugoniot_slope * eta) / (y * y * y);  // by eta
  if (constant_product_) {                                                               // (M2)
    const double half = 0.5 * k.gruneisen, factor = 1 - half * eta;
    return {hugoniot * factor, k.gruneisen * rho0, eta_slope * (hugoniot_slope * factor - half * hugoniot),
            0.0};
  }
  const double half = 0.5 * k.gruneisen, factor = 1 - half * (rho / rho0 - 1);  // (M3)
  return {hugoniot * factor, k.gruneisen * rho, eta_slope * hugoniot_slope * factor - half * hugoniot / rho0,
          k.gruneisen};
}

void MieGruneisen::find_limit() {
  const double rho0 = constants_.reference_density;
  const double last = std::min((1 - pole_margin) / constants_.hugoniot_slope, greatest_compression);
  constexpr int steps = 4000;
  for (int i = 1; i <= steps; ++i) {
    const double rho = rho0 / (1 - last * i / steps);
    if (coefficients(rho).A_slope <= 0) break;
    maximum_density_ = rho;
  }
  if (maximum_density_ < 1.01 * rho0) {
    throw InputError(
        fmt::format("mie_gruneisen: the reference pressure turns over at {:.4g} kg/m^3, at no compression to "
                    "speak of; check "
                    "hugoniot_slope ({:.4g}) and gruneisen ({:.4g})",
                    maximum_density_, constants_.hugoniot_slope, constants_.gruneisen));
  }
}

void MieGruneisen::tabulate_isentrope() {
  // de_s/d eta = V0 (A + B e_s) from the reference state, with the integrating factor T_s/T0 (M5).
  const Constants& k = constants_;
  const double V0 = 1 / k.reference_density, last = 1 - k.reference_density / maximum_density_;
  const double step = last / table_intervals;
  const auto factor = [&](double eta) {
    return constant_product_ ? std::exp(k.gruneisen * eta) : std::pow(1 - eta, -k.gruneisen);
  };
  const auto at = [&](double eta) { return coefficients(k.reference_density / (1 - eta)); };
  const auto integrand = [&](double eta) { return V0 * at(eta).A / factor(eta); };
  std::vector<HermiteTable::Node> nodes;
  double sum = 0;
  for (int i = 0; i <= table_intervals; ++i) {
    const double eta = i * step;
    if (i > 0) sum += boost::math::quadrature::gauss<double, 10>::integrate(integrand, eta - step, eta);
    // Just above rho0 the law of compression holds, also for the first node.
    const Coefficients c = at(std::max(eta, 1e-15));
    const double e = factor(eta) * sum, rho_by_eta = k.reference_density / ((1 - eta) * (1 - eta));
    const double slope = V0 * (c.A + c.B * e);
    nodes.push_back({e, slope, V0 * ((c.A_slope + c.B_slope * e) * rho_by_eta + c.B * slope)});
  }
  isentrope_energy_ = HermiteTable(0, step, std::move(nodes));
}

MieGruneisen::Isentrope MieGruneisen::isentrope(double rho) const {
  const Constants& k = constants_;
  const double rho0 = k.reference_density, G = k.gruneisen, T0 = k.reference_temperature;
  if (rho > rho0) {
    const double eta = 1 - rho0 / rho;
    return {isentrope_energy_(eta), T0 * (constant_product_ ? std::exp(G * eta) : std::pow(rho / rho0, G))};
  }
  // (M6): closed form in v = V/V0.
  const double v = rho0 / rho, power = std::pow(v, G);
  const double integral = (power - 1) / G - (power * v - 1) / (G + 1);
  return {-k.hugoniot_intercept * k.hugoniot_intercept * integral / power, T0 / power};
}

MieGruneisen::Point MieGruneisen::point(double rho, double e) const {
  Point p;
  p.density = rho;
  p.energy = e;
  if (!(rho > 0) || !std::isfinite(rho)) {
    p.broken = "density must be positive and finite";
  } else if (!std::isfinite(e)) {
    p.broken = "specific internal energy must be finite";
  } else if (rho > maximum_density_) {
    p.broken = "density above the compression limit of the reference curve";
  }
  if (!p.broken.empty()) return p;
  const Coefficients c = coefficients(rho);
  const Isentrope s = isentrope(rho);
  p.pressure = c.A + c.B * e;
  p.squared_sound_speed = c.A_slope + c.B_slope * e + c.B * p.pressure / (rho * rho);  // (M7)
  p.gruneisen = c.B / rho;
  p.isentrope_temperature = s.temperature;
  p.temperature = s.temperature + (e - s.energy) / constants_.heat_capacity;  // (M5)
  if (p.temperature < least_temperature) {
    p.temperature = least_temperature;
    p.cold = true;
  }
  return p;
}

RangeReport MieGruneisen::evaluate(const Batch& batch) const {
  RangeReport report;
  const double least = std::pow(least_sound_speed_ratio * constants_.hugoniot_intercept, 2);
  for (std::size_t i = 0; i < batch.density.size(); ++i) {
    const Point p = point(batch.density[i], batch.specific_internal_energy[i]);
    if (!p.broken.empty()) {
      if (report.out_of_range++ == 0) {
        report.first = i;
        report.bound = p.broken;
      }
      batch.pressure[i] = batch.temperature[i] = batch.sound_speed[i] = State::unknown;
      continue;
    }
    report.below_cold_curve += p.cold ? 1 : 0;
    batch.pressure[i] = p.pressure;
    batch.temperature[i] = p.temperature;
    batch.sound_speed[i] = std::sqrt(std::max(p.squared_sound_speed, least));
  }
  std::ranges::fill(batch.melted_fraction, 0.0);
  std::ranges::fill(batch.vaporised_fraction, 0.0);
  return report;
}

State MieGruneisen::full_state(const Point& p) const {
  if (!p.broken.empty()) {
    throw StateError(
        fmt::format("mie_gruneisen: {} (density {:.6g} kg/m^3, compression limit {:.6g} kg/m^3, specific "
                    "internal energy {:.6g} J/kg)",
                    p.broken, p.density, maximum_density_, p.energy));
  }
  const double least = std::pow(least_sound_speed_ratio * constants_.hugoniot_intercept, 2);
  State s;
  s.density = p.density;
  s.specific_internal_energy = p.energy;
  s.temperature = p.temperature;
  s.pressure = p.pressure;
  s.sound_speed = std::sqrt(std::max(p.squared_sound_speed, least));
  s.heat_capacity = constants_.heat_capacity;
  s.gruneisen = p.gruneisen;
  s.specific_entropy = constants_.heat_capacity * std::log(p.temperature / p.isentrope_temperature);
  s.isothermal_bulk_modulus =
      p.density *
      (p.squared_sound_speed - p.gruneisen * p.gruneisen * constants_.heat_capacity * p.temperature);
  s.phase = "solid";
  return s;
}

State MieGruneisen::state(double density, double specific_internal_energy) const {
  return full_state(point(density, specific_internal_energy));
}

State MieGruneisen::state_at_temperature(double density, double temperature) const {
  if (!(temperature >= least_temperature) || !std::isfinite(temperature)) {
    throw StateError(fmt::format("mie_gruneisen: temperature must be finite and at least {} K, not {}",
                                 least_temperature, temperature));
  }
  if (!(density > 0 && density <= maximum_density_)) return full_state(point(density, 0.0));
  const Isentrope s = isentrope(density);
  return full_state(point(density, s.energy + constants_.heat_capacity * (temperature - s.temperature)));
}

}  // namespace whipple::eos
