// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/fit/observations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "md_fitting/data_set/points.hpp"
#include "md_fitting/data_set/run_cost.hpp"
#include "src/core/base/error.hpp"

namespace whipple::fit {
namespace {

using md::Estimate;
using md::PointRecord;
using md::StatePoint;
using md::ZeroPressurePoint;

/// Upper limit of |r|. Proportional series have r = +-1, which makes one combination of P and E exact and the error
/// matrix singular. The error of that combination, relative to those of P and E, is sqrt(2 (1 - r)); r is estimated
/// from 16 blocks and cannot resolve less than a few per cent: the limit corresponds to 4.5 %.
constexpr double most_correlated = 0.999;
constexpr double same_volume = 1e-6;      // relative: states of one isochore
constexpr double same_temperature = 0.5;  // K: tolerance on the reference temperature of a volume
constexpr std::size_t least_states = 3;   // of the Hugoniot window, of an isochore
constexpr std::size_t least_isochores = 2;
constexpr std::size_t least_isotherm = 5;

/// Finds V at zero pressure and the reference temperature, from the point there or by linear interpolation.
bool reference_volume(const std::vector<ZeroPressurePoint>& points, double temperature, Estimate& volume) {
  const ZeroPressurePoint* below = nullptr;
  const ZeroPressurePoint* above = nullptr;
  for (const ZeroPressurePoint& point : points) {
    const double t = point.temperature;
    if (std::abs(t - temperature) <= same_temperature) {
      volume = point.specific_volume;
      return true;
    }
    if (t < temperature && (below == nullptr || t > below->temperature)) below = &point;
    if (t > temperature && (above == nullptr || t < above->temperature)) above = &point;
  }
  if (below == nullptr || above == nullptr) return false;
  const double t0 = below->temperature;
  const double weight = (temperature - t0) / (above->temperature - t0);
  const Estimate v0 = below->specific_volume;
  const Estimate v1 = above->specific_volume;
  volume.value = (1 - weight) * v0.value + weight * v1.value;
  volume.error = std::hypot((1 - weight) * v0.error, weight * v1.error);
  return true;
}

/// Returns the state behind the shock by the jump conditions: V is exact, us and up represent the pressure above
/// the initial one, P = us up / V0 with V0 = V us / (us - up).
HugoniotState hugoniot_state(const md::HugoniotPoint& point) {
  HugoniotState state;
  state.volume = point.specific_volume;
  state.shock_velocity = point.shock_velocity.value;
  state.particle_velocity = point.particle_velocity.value;
  state.pressure.value =
      state.particle_velocity * (state.shock_velocity - state.particle_velocity) / state.volume;
  state.pressure.error = point.pressure.error;
  return state;
}

std::vector<Isochore> isochores(std::span<const PointRecord> points) {
  std::vector<Isochore> found;
  for (const char* protocol : {"isochore", "isotherm"}) {
    for (const StatePoint& point : md::select_as<StatePoint>(points, protocol)) {
      if (!point.solid) continue;
      const double volume = point.specific_volume;
      ThermalState state{point.temperature, point.pressure, point.specific_internal_energy};
      // Both are means over the same trajectory.
      state.correlation = std::clamp(point.error_correlation, -most_correlated, most_correlated);
      const auto place = std::find_if(found.begin(), found.end(), [&](const Isochore& isochore) {
        return std::abs(isochore.volume - volume) <= same_volume * volume;
      });
      if (place == found.end()) {
        found.push_back({volume, {state}});
        continue;
      }
      // An isotherm and an isochore may share a state: it is one datum.
      const bool twice =
          std::any_of(place->states.begin(), place->states.end(), [&](const ThermalState& other) {
            return other.temperature == state.temperature && other.pressure.value == state.pressure.value;
          });
      if (!twice) place->states.push_back(state);
    }
  }
  std::erase_if(found, [](const Isochore& isochore) {
    std::set<double> temperatures;
    for (const ThermalState& state : isochore.states) temperatures.insert(state.temperature);
    return temperatures.size() < least_states;
  });
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.volume > b.volume; });
  for (Isochore& isochore : found) {
    std::sort(isochore.states.begin(), isochore.states.end(),
              [](const auto& a, const auto& b) { return a.temperature < b.temperature; });
  }
  return found;
}

/// Returns the melting points; at each pressure only those of the largest cells are used, since a plan may contain
/// smaller ones to show the size effect.
std::vector<MeltingPoint> melting_points(std::span<const PointRecord> points) {
  std::map<double, double> largest;  // cells, by pressure
  std::vector<std::pair<md::CoexistencePoint, double>> with_cells;
  for (const PointRecord& record : points) {
    const auto point = md::read_as<md::CoexistencePoint>(record);
    if (!point.solid_specific_volume) continue;  // does not constrain V0
    const md::RunShape shape = md::run_shape(record.provenance);
    const double cells = shape.cells * shape.cells * shape.length;
    with_cells.emplace_back(point, cells);
    double& most = largest[point.pressure];
    most = std::max(most, cells);
  }
  std::vector<MeltingPoint> found;
  for (const auto& [point, cells] : with_cells) {
    if (cells < largest[point.pressure]) continue;
    found.push_back({point.pressure, point.melting_temperature, *point.solid_specific_volume,
                     point.latent_heat, point.fusion_volume});
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.pressure < b.pressure; });
  return found;
}

/// Returns the solid states at the reference temperature, regardless of protocol.
std::vector<IsothermState> isotherm_states(std::span<const PointRecord> points, double temperature) {
  std::vector<IsothermState> found;
  for (const char* protocol : {"isotherm", "isochore"}) {
    for (const StatePoint& point : md::select_as<StatePoint>(points, protocol)) {
      if (!point.solid || std::abs(point.temperature - temperature) > same_temperature) continue;
      const IsothermState state{point.specific_volume, point.pressure};
      // An isotherm and an isochore may share a state: it is one datum.
      const bool twice = std::ranges::any_of(found, [&](const IsothermState& other) {
        return other.volume == state.volume && other.pressure.value == state.pressure.value;
      });
      if (!twice) found.push_back(state);
    }
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.volume > b.volume; });
  return found;
}

/// Minimum |1 - V/V0|: closer to V0, P/(1 - V/V0), or the difference of two, is dominated by the noise of P.
constexpr double too_near = 2e-3;

/// Returns -V dP/dV where an isotherm crosses zero pressure: P/(1 - V/V0) of the two nearest states of different
/// volumes, extrapolated to V0; nothing if all states have one volume or are next to V0.
std::optional<double> modulus_at_rest(std::vector<IsothermState> isotherm, double v0) {
  const auto strain = [&](const IsothermState& state) { return 1.0 - state.volume / v0; };
  std::erase_if(isotherm, [&](const IsothermState& state) { return std::abs(strain(state)) < too_near; });
  std::ranges::sort(isotherm, {}, [&](const IsothermState& state) { return std::abs(strain(state)); });
  const auto next = std::ranges::find_if(isotherm, [&](const IsothermState& state) {
    return std::abs(strain(state) - strain(isotherm.front())) >= too_near;
  });
  if (next == isotherm.end()) return std::nullopt;
  const double x0 = strain(isotherm.front());
  const double x1 = strain(*next);
  const double secant0 = isotherm.front().pressure.value / x0;
  const double secant1 = next->pressure.value / x1;
  return secant0 - (secant1 - secant0) / (x1 - x0) * x0;
}

/// Returns the points of the protocol "quantum" at a temperature, by decreasing volume.
std::vector<QuantumState> quantum_states(std::span<const PointRecord> points, double temperature) {
  std::vector<QuantumState> found;
  for (const md::QuantumPoint& point : md::select_as<md::QuantumPoint>(points)) {
    if (std::abs(point.temperature - temperature) > same_temperature) continue;
    found.push_back({point.specific_volume, point.quantum_pressure, point.debye_temperature});
  }
  std::ranges::sort(found, [](const auto& a, const auto& b) { return a.volume > b.volume; });
  return found;
}

/// Returns the quantum correction to the pressure, interpolated linearly between the volumes of the points; nothing
/// outside their range.
std::optional<Estimate> quantum_pressure(const std::vector<QuantumState>& states, double volume) {
  const auto below =
      std::ranges::find_if(states, [&](const auto& s) { return s.volume <= volume * (1 + 1e-9); });
  if (below == states.end() || volume > states.front().volume * (1 + 1e-9)) return std::nullopt;
  if (below == states.begin()) return below->pressure;
  const QuantumState& above = *std::prev(below);
  const double weight = (volume - below->volume) / (above.volume - below->volume);
  return Estimate{weight * above.pressure.value + (1 - weight) * below->pressure.value,
                  std::hypot(weight * above.pressure.error, (1 - weight) * below->pressure.error)};
}

/// Compares the isotherm with that of quantum nuclei, if the points of the protocol include the volume at zero
/// pressure.
void compare_nuclei(Observations& data) {
  const double v0 = data.reference_volume.value;
  const std::optional<Estimate> at_reference = quantum_pressure(data.quantum, v0);
  const std::optional<double> bulk_modulus = modulus_at_rest(data.isotherm, v0);
  if (!at_reference || !bulk_modulus || data.isotherm.size() < least_isotherm) return;
  data.nuclei.expansion = at_reference->value / *bulk_modulus;
  for (const IsothermState& state : data.isotherm) {
    if (const auto addition = quantum_pressure(data.quantum, state.volume)) {
      data.nuclei.isotherm.push_back({state.volume, state.pressure.value, addition->value});
    }
  }
}

/// Converts the isotherm of classical nuclei, and the volume at zero pressure, to those of quantum nuclei.
/// @throws InputError if the points of the protocol do not cover the isotherm, or its states do not give a bulk modulus
void take_quantum_nuclei(Observations& data, const std::string& store_name) {
  if (data.quantum.empty()) return;
  const auto addition = [&](double volume) {
    if (const auto pressure = quantum_pressure(data.quantum, volume)) return *pressure;
    throw InputError(fmt::format(
        "{}: the points of the protocol \"quantum\" at {} K reach from V = {:.5g} to {:.5g} cm^3/g, the "
        "isotherm has {:.5g}; add volumes, or fit with --nuclei classical",
        store_name, data.reference_temperature, 1e3 * data.quantum.back().volume,
        1e3 * data.quantum.front().volume, 1e3 * volume));
  };
  Estimate& v0 = data.reference_volume;
  const Estimate at_reference = addition(v0.value);
  const std::optional<double> bulk_modulus = modulus_at_rest(data.isotherm, v0.value);
  if (!bulk_modulus) {
    throw InputError(fmt::format(
        "{}: the isotherm has no two volumes that differ from that at zero pressure and from one another by "
        "{} of it: the points of the protocol \"quantum\" need its bulk modulus; add volumes, or fit with "
        "--nuclei classical",
        store_name, too_near));
  }
  v0.error = std::hypot(v0.error, v0.value * at_reference.error / *bulk_modulus);
  v0.value *= 1.0 + data.nuclei.expansion;
  for (IsothermState& state : data.isotherm) {
    const Estimate pressure = addition(state.volume);
    state.pressure.value += pressure.value;
    state.pressure.error = std::hypot(state.pressure.error, pressure.error);
  }
  data.nuclei.contained = true;
}

/// Adds the observations of liquid, vapour and Debye temperature.
void add_other_phases(std::span<const PointRecord> points, Observations& data) {
  for (const md::LiquidPoint& point : md::select_as<md::LiquidPoint>(points)) {
    if (point.liquid) data.liquid.push_back({point.temperature, point.pressure, point.specific_volume});
  }
  for (const md::LiquidVapourPoint& point : md::select_as<md::LiquidVapourPoint>(points)) {
    data.saturation.push_back({point.temperature, point.liquid_density, point.vapour_density});
  }
  std::sort(data.saturation.begin(), data.saturation.end(),
            [](const auto& a, const auto& b) { return a.temperature < b.temperature; });
  for (const md::ElasticPoint& point : md::select_as<md::ElasticPoint>(points)) {
    data.elastic.push_back({point.specific_volume, point.bulk_modulus.value, point.shear_modulus_hill.value});
  }
}

/// Returns the value common to all finished points.
std::string common_origin(std::span<const PointRecord> points, const char* entry,
                          const std::string& store_name) {
  std::set<std::string> values;
  for (const PointRecord& point : points) {
    if (point.done()) values.insert(point.origin(entry));
  }
  if (values.size() > 1) {
    throw InputError(
        fmt::format("{}: the points were computed with different values of '{}' ({}); keep one store "
                    "for each",
                    store_name, entry, fmt::join(values, ", ")));
  }
  return *values.begin();
}

std::string missing(std::span<const PointRecord> points, std::string_view protocol, const std::string& have,
                    const std::string& need) {
  const auto failed = std::count_if(points.begin(), points.end(), [&](const PointRecord& point) {
    return point.protocol == protocol && !point.done();
  });
  std::string text = fmt::format("\n  protocol \"{}\": {}, the fit needs {}", protocol, have, need);
  if (failed > 0) text += fmt::format(" ({} failed)", failed);
  return text;
}

}  // namespace

Observations observe(std::span<const PointRecord> points, const FitSettings& settings, const Needs& needs,
                     const std::string& store_name) {
  const double reference_temperature = settings.reference_temperature;
  const double least = settings.least_particle_velocity;
  const double most = settings.most_particle_velocity;
  if (std::none_of(points.begin(), points.end(), [](const PointRecord& point) { return point.done(); })) {
    throw InputError(
        fmt::format("{}: no finished points ({} failed); run a plan with the protocols "
                    "\"zero_pressure_volume\", \"hugoniot\", "
                    "\"isochore\" and, for the melting temperature, \"coexistence\"",
                    store_name, points.size()));
  }
  Observations data;
  data.element = common_origin(points, "element", store_name);
  data.potential = common_origin(points, "potential", store_name);
  const auto first =
      std::find_if(points.begin(), points.end(), [](const auto& point) { return point.done(); });
  data.molar_mass = first->origin_number("molar_mass");
  data.reference_temperature = reference_temperature;

  std::string lacking;
  const std::vector<ZeroPressurePoint> volumes = md::select_as<ZeroPressurePoint>(points);
  if (!reference_volume(volumes, reference_temperature, data.reference_volume)) {
    lacking += missing(points, ZeroPressurePoint::protocol,
                       fmt::format("{} finished, none at {} K nor on both sides of it", volumes.size(),
                                   reference_temperature),
                       fmt::format("one at {} K", reference_temperature));
  }
  for (const md::HugoniotPoint& point : md::select_as<md::HugoniotPoint>(points)) {
    if (point.solid) data.hugoniot.push_back(hugoniot_state(point));
  }
  std::sort(data.hugoniot.begin(), data.hugoniot.end(),
            [](const auto& a, const auto& b) { return a.particle_velocity < b.particle_velocity; });
  const auto inside =
      std::count_if(data.hugoniot.begin(), data.hugoniot.end(), [&](const HugoniotState& state) {
        return state.particle_velocity >= least && state.particle_velocity <= most;
      });
  if (needs.hugoniot && inside < static_cast<std::ptrdiff_t>(least_states)) {
    lacking += missing(points, "hugoniot",
                       fmt::format("{} finished, {} of them with a particle velocity of {} ... {} km/s",
                                   data.hugoniot.size(), inside, 1e-3 * least, 1e-3 * most),
                       fmt::format("{} there", least_states));
  }
  data.isochores = isochores(points);
  if (data.isochores.size() < least_isochores) {
    lacking += missing(points, "isochore",
                       fmt::format("{} volumes with {} or more temperatures of the solid",
                                   data.isochores.size(), least_states),
                       fmt::format("{}", least_isochores));
  }
  data.isotherm = isotherm_states(points, reference_temperature);
  if (needs.isotherm && data.isotherm.size() < least_isotherm) {
    lacking += missing(points, "isotherm",
                       fmt::format("{} solid states at {} K", data.isotherm.size(), reference_temperature),
                       fmt::format("{}", least_isotherm));
  }
  if (lacking.empty()) {
    data.quantum = quantum_states(points, reference_temperature);
    compare_nuclei(data);
    if (needs.isotherm && settings.nuclei == Nuclei::quantum) take_quantum_nuclei(data, store_name);
  }
  data.melting = melting_points(md::select(points, md::CoexistencePoint::protocol));
  add_other_phases(points, data);
  if (!lacking.empty()) {
    throw InputError(fmt::format("{}: points are missing:{}", store_name, lacking));
  }
  return data;
}

}  // namespace whipple::fit
