// SPDX-License-Identifier: BSD-3-Clause
#include "eos/models/simulated_crystal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

constexpr std::string_view beyond_volumes = "volume outside of the range that may be simulated";
constexpr std::string_view too_hot = "hotter than the temperatures that may be simulated";
constexpr std::string_view unstable = "no stable crystal: the isentrope does not rise";

CrystalSurface::Settings settings_of(const SimulatedConstants& c) {
  const double cells = (c.greatest_volume_ratio - c.least_volume_ratio) / c.spacing;
  if (!(cells > 0.5 && std::abs(cells - std::round(cells)) < 1e-6)) {
    throw InputError(fmt::format(
        "least_volume_ratio = {}, greatest_volume_ratio = {}: the range must be a multiple of spacing = {}",
        c.least_volume_ratio, c.greatest_volume_ratio, c.spacing));
  }
  if (c.temperature.size() < 2) throw InputError("temperature: expected two temperatures or more");
  return {c.least_volume_ratio,
          c.greatest_volume_ratio,
          c.spacing,
          *std::max_element(c.temperature.begin(), c.temperature.end()),
          c.tolerance,
          static_cast<int>(c.divisions)};
}

/// Returns the registered maker of sources that simulate crystals in this process; empty if none is registered.
IsochoreSourceMaker& registered() {
  static IsochoreSourceMaker maker;
  return maker;
}

}  // namespace

ParameterTable<SimulatedConstants> SimulatedConstants::parameters() {
  using C = SimulatedConstants;
  return {
      text("element", &C::element, "chemical symbol"),
      text("potential", &C::potential, "as in a plan of whipple md; a file: with its whole path"),
      text("store", &C::store, "whole path of the store NAME.md.h5 that keeps what was simulated")
          .optional("by element and potential in the user's cache"),
      real_list("temperature", &C::temperature, "K", range::positive(),
                "simulated at every volume; the largest bounds the states"),
      real("least_volume_ratio", &C::least_volume_ratio, "", range::open_between(0.1, 1.0),
           "V over the volume of the static crystal at zero pressure")
          .optional(),
      real("greatest_volume_ratio", &C::greatest_volume_ratio, "", range::open_between(1.0, 2.0), "the same")
          .optional(),
      real("spacing", &C::spacing, "", range::open_between(0.0, 0.5),
           "of the volumes that are simulated first; each interval is halved once at least")
          .optional(),
      real(
          "tolerance", &C::tolerance, "Pa", range::positive(),
          "estimated error of the pressure, up to the largest temperature, above which an interval is halved")
          .optional(),
      integer("divisions", &C::divisions, {.lower = 1, .upper = 10}, "halvings of an interval at most")
          .optional(),
      real("reference_temperature", &C::reference_temperature, "K", range::positive(),
           "of the reference state, at zero pressure")
          .optional(),
      integer("cells", &C::cells, {.lower = 2, .upper = 100}, "unit cells along each edge of the crystal")
          .optional(),
      integer("equilibration_steps", &C::equilibration_steps, {.lower = 100, .upper = 1e9},
              "time steps before averaging")
          .optional(),
      integer("steps", &C::steps, {.lower = 200, .upper = 1e9}, "time steps that are averaged").optional(),
      integer("seed", &C::seed, {.lower = 0}, "changes all initial velocities").optional()};
}

SimulatedCrystal::SimulatedCrystal(const SimulatedConstants& constants,
                                   std::unique_ptr<IsochoreSource> source)
    : constants_(constants),
      surface_(std::move(source), settings_of(constants)),
      greatest_temperature_(settings_of(constants).greatest_temperature) {
  // Zero pressure at the reference temperature: Newton's method in V from the volume of the static crystal.
  double density = 1.0 / (surface_.greatest_volume() / constants_.greatest_volume_ratio);
  constexpr int most_steps = 50;
  for (int step = 0;; ++step) {
    const State here = state_at_temperature(density, constants_.reference_temperature);
    if (std::abs(here.pressure) <= 1e-12 * here.isothermal_bulk_modulus) {
      energy_zero_ = here.specific_internal_energy;
      reference_density_ = density;
      return;
    }
    if (step == most_steps) throw StateError("no state of zero pressure at the reference temperature");
    density *= 1.0 - std::clamp(here.pressure / here.isothermal_bulk_modulus, -0.02, 0.02);
  }
}

const CrystalSurface::Cell& SimulatedCrystal::cell(double density) const {
  const CrystalSurface::Cell* cell = surface_.cell(1.0 / density);
  if (cell == nullptr) {
    throw StateError(fmt::format("{} kg/m^3: {} ({:.6g} ... {:.6g} kg/m^3)", density, beyond_volumes,
                                 1.0 / surface_.greatest_volume(), 1.0 / surface_.least_volume()));
  }
  if (!cell->fault.empty()) throw StateError(fmt::format("{} kg/m^3: {}", density, cell->fault));
  return *cell;
}

/// Solves e - phi = c T + g T^2/2.
double SimulatedCrystal::temperature_of(double thermal_energy) const {
  const double c = surface_.heat_capacity();
  const double g = surface_.anharmonic_coefficient();
  return 2.0 * thermal_energy / (c + std::sqrt(c * c + 2.0 * g * thermal_energy));
}

SimulatedCrystal::Derivatives SimulatedCrystal::derivatives(const CrystalSurface::Point& point, double v,
                                                            double t) const {
  const double c = surface_.heat_capacity();
  const double heat_capacity = c + surface_.anharmonic_coefficient() * t;
  const double by_temperature = c * point.gruneisen / v;  // dP/dT
  const double by_volume = -point.second + c * t * (point.gruneisen_slope - point.gruneisen / v) / v;
  return {-point.first + t * by_temperature, heat_capacity, v * by_temperature / heat_capacity,
          -v * by_volume, v * v * (t * by_temperature * by_temperature / heat_capacity - by_volume)};
}

double SimulatedCrystal::minimum_energy(double density) const {
  const double v = 1.0 / density;
  return cell(density).leaf(v).at(v).cold_energy - energy_zero_;
}

RangeReport SimulatedCrystal::evaluate(const Batch& batch) const {
  RangeReport report;
  for (std::size_t i = 0; i < batch.density.size(); ++i) {
    const double v = 1.0 / batch.density[i];
    const auto refuse = [&](std::string_view bound) {
      if (report.first == RangeReport::none) {
        report.first = i;
        report.bound = bound;
      }
      ++report.out_of_range;
      batch.pressure[i] = batch.temperature[i] = batch.sound_speed[i] = State::unknown;
    };
    const CrystalSurface::Cell* cell = surface_.cell(v);
    if (cell == nullptr || !cell->fault.empty()) {
      refuse(cell == nullptr ? beyond_volumes : std::string_view(cell->fault));
      continue;
    }
    const CrystalSurface::Point point = cell->leaf(v).at(v);
    double thermal = batch.specific_internal_energy[i] + energy_zero_ - point.cold_energy;
    if (thermal < 0.0) {
      thermal = 0.0;
      ++report.below_cold_curve;
    }
    const double t = temperature_of(thermal);
    const Derivatives d = derivatives(point, v, t);
    if (!(t <= greatest_temperature_)) {
      refuse(too_hot);
    } else if (!(d.sound_speed_squared > 0.0)) {
      refuse(unstable);
    } else {
      batch.pressure[i] = d.pressure;
      batch.temperature[i] = t;
      batch.sound_speed[i] = std::sqrt(d.sound_speed_squared);
    }
    if (!batch.melted_fraction.empty()) batch.melted_fraction[i] = 0.0;
    if (!batch.vaporised_fraction.empty()) batch.vaporised_fraction[i] = 0.0;
  }
  return report;
}

State SimulatedCrystal::state_at_temperature(double density, double temperature) const {
  const double v = 1.0 / density;
  const CrystalSurface::Point point = cell(density).leaf(v).at(v);
  if (!(temperature >= 0.0 && temperature <= greatest_temperature_)) {
    throw StateError(fmt::format("{} K at {} kg/m^3: {}", temperature, density, too_hot));
  }
  const Derivatives d = derivatives(point, v, temperature);
  if (!(d.sound_speed_squared > 0.0)) {
    throw StateError(fmt::format("{} kg/m^3, {} K: {}", density, temperature, unstable));
  }
  State state;
  state.density = density;
  state.temperature = temperature;
  const double c = surface_.heat_capacity();
  state.specific_internal_energy = point.cold_energy - energy_zero_ +
                                   temperature * (c + 0.5 * surface_.anharmonic_coefficient() * temperature);
  state.pressure = d.pressure;
  state.sound_speed = std::sqrt(d.sound_speed_squared);
  state.heat_capacity = d.heat_capacity;
  state.gruneisen = d.gruneisen;
  state.isothermal_bulk_modulus = d.isothermal_modulus;
  state.phase = "solid";
  derive(state);
  return state;
}

State SimulatedCrystal::state(double density, double specific_internal_energy) const {
  const double thermal = specific_internal_energy - minimum_energy(density);
  if (thermal < 0.0) {
    throw StateError(
        fmt::format("{} J/kg at {} kg/m^3: below the static crystal", specific_internal_energy, density));
  }
  return state_at_temperature(density, temperature_of(thermal));
}

std::string SimulatedCrystal::constants() const {
  SimulatedConstants values = constants_;
  return to_toml(whipple::bind(SimulatedConstants::parameters(), values));
}

void set_isochore_source(IsochoreSourceMaker maker) { registered() = std::move(maker); }

std::unique_ptr<SimulatedCrystal> simulated_crystal(const SimulatedConstants& constants) {
  if (!registered()) throw InputError("this program cannot simulate crystals: it has no source of isochores");
  return std::make_unique<SimulatedCrystal>(constants, registered()(constants));
}

}  // namespace whipple::eos
