// SPDX-License-Identifier: BSD-3-Clause
// Limits of the checks: docs/theory/equations_of_state.md, section 5.
#include "eos/audit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "eos/detonation.hpp"
#include "src/core/base/error.hpp"

namespace whipple::eos {
namespace {

// Limits, each stated in the message of its finding.
constexpr double condensed_pressure = 0.1;         ///< of rho c^2: a higher pressure at rest indicates a gas
constexpr double greatest_defect = 1e-4;           ///< of the identities in a phase
constexpr double resting_pressure = 1e-3;          ///< of rho c^2
constexpr double greatest_thermal_excess = 9;      ///< of rho c^2: limit of -K_T at rest
constexpr double least_compression = 1.02;         ///< smallest useful compression limit
constexpr double modest_compression = 1.2;         ///< compression limit sufficient for impact shocks
constexpr double least_strength = 0.01;            ///< of rho c^2: smallest useful strongest shock
constexpr double modest_strength = 0.5;            ///< of rho c^2
constexpr double greatest_velocity = 20e3;         ///< m/s: particle velocity at the end of the search
constexpr double greatest_wide_velocity = 60e3;    ///< m/s: of models of a wide range
constexpr double hottest_of_grid = 3e4;            ///< K: of states that are visited, unless of a wide range
constexpr double greatest_compression = 3;         ///< of those states
constexpr double modest_temperature = 3000;        ///< K
constexpr double greatest_melting_point = 5000;    ///< K at zero pressure: exceeds all known materials
constexpr double greatest_critical_point = 25000;  ///< K: exceeds all known materials
constexpr double densest_matter = 25e3;            ///< kg/m^3 at rest: osmium has 22.6e3
constexpr double slowest_detonation = 1e3;         ///< m/s: below all known explosives
constexpr double fastest_detonation = 12e3;        ///< m/s: above all known explosives
constexpr double atmosphere = 101325;              ///< Pa
constexpr double thinnest = 1e-6;                  ///< of the reference density

constexpr double thinned = 1.0 / 30;  ///< of the reference density: end of the grid

constexpr double GPa = 1e9;

/// Returns c^2 from the moduli, V K_T + Gamma^2 C_v T, which may be negative where the model limits its reported
/// sound speed. NaN if a modulus is unknown.
double squared_sound_speed(const State& s) {
  return s.isothermal_bulk_modulus / s.density + s.gruneisen * s.gruneisen * s.heat_capacity * s.temperature;
}

/// Returns the fault of a state of a condensed material or of a gas; empty if there is none. Unknown quantities
/// (NaN) are not faults.
std::string instability(const State& s) {
  if (!std::isfinite(s.pressure)) return "the pressure is not finite";
  if (!(s.sound_speed > 0) || !std::isfinite(s.sound_speed)) {
    return fmt::format("the sound speed is {:.4g} m/s", s.sound_speed);
  }
  if (s.heat_capacity <= 0) return fmt::format("C_v = {:.4g} J/(kg K) is not positive", s.heat_capacity);
  if (squared_sound_speed(s) <= 0) {
    return fmt::format("c^2 = {:.4g} m^2/s^2 is not positive", squared_sound_speed(s));
  }
  // Mixtures of two phases have none, K_T = 0.
  if (s.isothermal_bulk_modulus < 0 && !(s.melted_fraction > 0 && s.melted_fraction < 1)) {
    return fmt::format(
        "K_T = {:.4g} GPa is not positive (rho c^2 = {:.4g} GPa, Gamma^2 C_v T rho = {:.4g} GPa)",
        s.isothermal_bulk_modulus / GPa, s.isentropic_bulk_modulus / GPa,
        s.gruneisen * s.gruneisen * s.heat_capacity * s.temperature * s.density / GPa);
  }
  return {};
}

class Auditor {
 public:
  Auditor(const EquationOfState& eos, AuditDepth depth) : eos_(eos), full_(depth == AuditDepth::full) {
    result_.model = eos.model();
    thermal_ = std::isfinite(eos.reference_temperature());
  }

  Audit run() {
    if (!check_reference()) return std::move(result_);
    if (eos_.detonates()) guarded("detonation", [&] { check_detonation(); });
    guarded("cold curve", [&] { check_cold_curve(); });
    guarded("Hugoniot", [&] { check_hugoniot(); });
    if (thermal_) guarded("heat capacity", [&] { check_temperatures(); });
    if (thermal_ && result_.condensed) guarded("melting", [&] { check_melting(); });
    guarded("liquid and vapour", [&] { check_boiling(); });
    if (full_ && thermal_) {
      guarded("stability", [&] { check_stability(); });
      guarded("identities", [&] { check_identities_of_phases(); });
    }
    return std::move(result_);
  }

 private:
  template <class... Args>
  void object(Verdict weight, fmt::format_string<Args...> format, Args&&... args) {
    result_.findings.push_back({weight, fmt::format(format, std::forward<Args>(args)...)});
  }

  template <class Check>
  void guarded(const char* what, const Check& check) {
    try {
      check();
    } catch (const StateError& error) {
      object(Verdict::reservations, "{}: {}", what, error.what());
    }
  }

  [[nodiscard]] double stiffness() const { return result_.reference.isentropic_bulk_modulus; }

  /// Checks the reference state; returns false if no further check is possible.
  bool check_reference() {
    State& s = result_.reference;
    const double density = eos_.reference_density();
    try {
      s = eos_.state(density, eos_.reference_energy());
    } catch (const StateError& error) {
      object(Verdict::not_usable, "reference state: {}", error.what());
      return false;
    }
    if (const std::string fault = instability(s); !fault.empty()) {
      // With c^2 > 0 the flow is well posed where K_T is not positive (stiffened gases): only queries at constant
      // temperature fail. K_T far below zero indicates a wrong unit of heat capacity or stiffness.
      const bool flows = s.isothermal_bulk_modulus > -greatest_thermal_excess * stiffness() &&
                         s.isothermal_bulk_modulus <= 0 && s.heat_capacity > 0 && s.sound_speed > 0 &&
                         squared_sound_speed(s) > 0;
      object(flows ? Verdict::reservations : Verdict::not_usable,
             "reference state ({:.6g} kg/m^3, {:.4g} K): {}{}", density, s.temperature, fault,
             flows ? ": no temperature of this model can be trusted" : "");
      if (!flows) return false;
      thermal_ = false;
    }
    if (density > densest_matter) {
      object(Verdict::not_usable, "reference density {:.4g} kg/m^3: no material at rest has more than {:g}",
             density, densest_matter);
    }
    result_.condensed = std::abs(s.pressure) < condensed_pressure * stiffness();
    if (result_.condensed && std::abs(s.pressure) > resting_pressure * stiffness()) {
      object(Verdict::reservations,
             "the reference state is not at rest: p = {:.4g} GPa, more than {:g} of rho c^2 = {:.4g} GPa",
             s.pressure / GPa, resting_pressure, stiffness() / GPa);
    }
    if (thermal_ && std::abs(s.temperature - eos_.reference_temperature()) > 1e-6 * s.temperature) {
      object(Verdict::reservations,
             "the reference energy is that of {:.6g} K, the reference temperature {:.6g} K", s.temperature,
             eos_.reference_temperature());
    }
    result_.range.least_temperature = eos_.least_temperature();
    result_.range.greatest_temperature = s.temperature;
    result_.range.least_density = thinnest * density;
    result_.range.greatest_density = eos_.maximum_density();
    return true;
  }

  /// Checks the detonation velocity, which is far outside the known range if constants have a wrong unit.
  void check_detonation() {
    const double velocity = chapman_jouguet(eos_).detonation_velocity;
    if (velocity >= slowest_detonation && velocity <= fastest_detonation) return;
    object(Verdict::not_usable, "the explosive detonates with {:.4g} km/s; known ones with {:g} to {:g} km/s",
           1e-3 * velocity, 1e-3 * slowest_detonation, 1e-3 * fastest_detonation);
  }

  /// Returns whether the model is meant for plasma and terapascals.
  [[nodiscard]] bool wide() const {
    return eos_.intended_temperature() > EquationOfState::usual_intended_temperature;
  }

  void check_cold_curve() {
    const double rho0 = eos_.reference_density();
    double& limit = result_.range.greatest_density;
    if (result_.condensed && thermal_) {
      result_.cold = cold_curve(eos_);
      const ColdCurve& cold = *result_.cold;
      if (!cold.tension_limit.phase.empty()) result_.range.least_density = cold.tension_limit.density;
      if (cold.compression_limit.density < 0.999 * std::min(limit, 100 * rho0)) {
        object(Verdict::reservations,
               "the pressure of the cold curve falls beyond {:.5g} kg/m^3, {:.4g} GPa: the model ends there "
               "(its own limit: {:.5g} kg/m^3)",
               cold.compression_limit.density, cold.compression_limit.pressure / GPa, limit);
        limit = cold.compression_limit.density;
      }
      if (std::abs(cold.at_rest.density / rho0 - 1) > 0.2) {
        object(Verdict::reservations,
               "cold material is at rest at {:.5g} kg/m^3, {:+.0f} % from the reference density",
               cold.at_rest.density, 100 * (cold.at_rest.density / rho0 - 1));
      }
    }
    if (limit < least_compression * rho0) {
      object(Verdict::not_usable,
             "compression limit {:.5g} kg/m^3: {:.3g} of the reference density, less than {:g}", limit,
             limit / rho0, least_compression);
    } else if (limit < modest_compression * rho0) {
      object(Verdict::reservations,
             "compression limit {:.5g} kg/m^3: {:.3g} of the reference density, less than {:g}", limit,
             limit / rho0, modest_compression);
    }
  }

  /// Checks the principal Hugoniot up to 20 km/s, of models of a wide range to 60 km/s: stable states, increasing pressure and entropy.
  void check_hugoniot() {
    const Hugoniot hugoniot(eos_);
    ValidRange& range = result_.range;
    range.strongest_shock.state = result_.reference;
    range.strongest_shock.shock_velocity = result_.reference.sound_speed;
    double spreads_to = 0, splits_to = 0;
    double greatest_entropy = result_.reference.specific_entropy;
    const auto fault_at = [&](double up) -> std::string {
      ShockState s;
      try {
        s = hugoniot.at_particle_velocity(up);
      } catch (const StateError& error) {
        return error.what();
      }
      const ShockState& before = range.strongest_shock;
      const std::string fault = thermal_ ? instability(s.state) : std::string();
      if (!fault.empty())
        return fmt::format("{} ({:.5g} kg/m^3, {:.4g} K)", fault, s.state.density, s.state.temperature);
      if (!(s.state.pressure > before.state.pressure)) return "the pressure does not rise with the velocity";
      const double entropy = s.state.specific_entropy;
      if (entropy < greatest_entropy - 1e-6 * (std::abs(entropy) + std::abs(greatest_entropy))) {
        // Across a transition one shock would be slower than the one to its beginning: it splits in two. Where the
        // pressure does not depend on the energy, the shock is a ramp and nothing else is wrong.
        if (s.state.phase != result_.reference.phase && s.state.melted_fraction == 0) {
          splits_to = s.state.pressure;
        } else if (s.state.gruneisen != 0) {
          return "the entropy falls";
        } else {
          spreads_to = s.state.pressure;
        }
      }
      greatest_entropy = std::max(greatest_entropy, entropy);
      range.strongest_shock = s;
      return {};
    };
    double last = 0, up = 0.01 * result_.reference.sound_speed;
    const double growth = full_ ? 1.1 : 1.5;
    const double end = wide() ? greatest_wide_velocity : greatest_velocity;
    while (last < end) {
      up = std::min(up, end);
      range.end_of_shocks = fault_at(up);
      if (!range.end_of_shocks.empty()) break;
      last = up;
      up *= growth;
    }
    if (!range.end_of_shocks.empty()) {
      for (double beyond = up; beyond - last > 0.01 * beyond;) {
        const double middle = 0.5 * (last + beyond);
        const std::string fault = fault_at(middle);
        if (!fault.empty()) range.end_of_shocks = fault;
        (fault.empty() ? last : beyond) = middle;
      }
    }
    if (spreads_to > 0) {
      object(Verdict::reservations, "shocks up to {:.4g} GPa spread into ramps: the entropy would fall",
             spreads_to / GPa);
    }
    if (splits_to > 0) {
      object(Verdict::reservations,
             "shocks into the next phase, up to {:.4g} GPa, are two waves: one of them would lose entropy",
             splits_to / GPa);
    }
    const double strength = range.strongest_shock.state.pressure / stiffness();
    if (range.end_of_shocks.empty() || strength > modest_strength) return;
    object(strength < least_strength ? Verdict::not_usable : Verdict::reservations,
           "the Hugoniot ends at {:.4g} GPa, {:.2g} of rho c^2 = {:.4g} GPa (less than {:g}): {}",
           range.strongest_shock.state.pressure / GPa, strength, stiffness() / GPa,
           strength < least_strength ? least_strength : modest_strength, range.end_of_shocks);
  }

  /// Checks heating at the reference density.
  void check_temperatures() {
    double& last = result_.range.greatest_temperature;
    const double hottest = eos_.intended_temperature();
    while (last < hottest) {
      const double T = std::clamp(1.1 * last, 1.0, hottest);
      std::string fault;
      try {
        fault = instability(eos_.state_at_temperature(eos_.reference_density(), T));
      } catch (const StateError& error) {
        fault = error.what();
      }
      if (fault.empty()) {
        last = T;
        continue;
      }
      if (T < modest_temperature) {
        object(Verdict::reservations, "at the reference density the model ends at {:.4g} K, below {:g} K: {}",
               T, modest_temperature, fault);
      }
      return;
    }
  }

  void check_melting() {
    result_.melting = melting_point(eos_, 0.0);
    if (!result_.melting) return;
    const double solidus = result_.melting->solidus.temperature;
    if (solidus < eos_.reference_temperature()) {
      object(Verdict::reservations, "melts at {:.5g} K, below the reference temperature of {:.5g} K", solidus,
             eos_.reference_temperature());
    }
    const double liquidus = result_.melting->liquidus.temperature;
    if (liquidus > greatest_melting_point) {
      object(Verdict::reservations, "molten at {:.5g} K at zero pressure: above {:g} K, as no known material",
             liquidus, greatest_melting_point);
    }
    if (!full_) return;
    result_.shock_melting = shock_melting(eos_);
    double before = result_.melting->liquidus.temperature;
    double strongest = std::min(200 * GPa, 0.5 * result_.range.strongest_shock.state.pressure);
    if (result_.cold) strongest = std::min(strongest, 0.95 * result_.cold->compression_limit.pressure);
    for (int i = 1; i <= 10; ++i) {
      const double pressure = strongest * i / 10;
      const auto point = melting_point(eos_, pressure);
      if (!point || point->liquidus.temperature < before) {
        object(Verdict::reservations, "the melting line {} at {:.4g} GPa", point ? "falls" : "ends",
               pressure / GPa);
        return;
      }
      before = point->liquidus.temperature;
    }
  }

  void check_boiling() {
    const VapourDome* dome = eos_.vapour_dome();
    if (dome == nullptr) return;
    result_.critical = dome->critical_point();
    result_.boiling = dome->at_pressure(atmosphere);
    if (result_.critical->temperature > greatest_critical_point) {
      object(Verdict::reservations, "critical temperature {:.5g} K: above {:g} K, as no known material",
             result_.critical->temperature, greatest_critical_point);
    }
    if (!result_.melting) return;
    const double liquidus = result_.melting->liquidus.temperature;
    if (result_.critical->temperature < liquidus) {
      object(Verdict::reservations, "critical temperature {:.5g} K below the melting point of {:.5g} K",
             result_.critical->temperature, liquidus);
    } else if (result_.boiling && result_.boiling->temperature < liquidus) {
      object(Verdict::reservations,
             "boils at {:.5g} K at one atmosphere, below the melting point of {:.5g} K",
             result_.boiling->temperature, liquidus);
    }
  }

  /// Visits a grid of densities (from the largest: linear in compression, logarithmic down to one thirtieth of the
  /// reference density) and temperatures from 200 to 30,000 K; models of a wide range in all of it.
  template <class Visit>
  void over_the_range(const Visit& visit) const {
    constexpr int compressed = 20, expanded = 21, temperatures = 31;
    const double rho0 = eos_.reference_density();
    const double limit = result_.range.greatest_density * 0.999;
    const double densest = wide() ? limit : std::min(limit, greatest_compression * rho0);
    const double hottest = wide() ? eos_.intended_temperature() : hottest_of_grid;
    const double coldest = std::max(200.0, eos_.least_temperature());
    for (int i = 0; i < compressed + expanded; ++i) {
      const double density = i < compressed ? densest + (rho0 - densest) * i / compressed
                                            : rho0 * std::pow(thinned, (i - compressed + 0.5) / expanded);
      for (int k = 0; k < temperatures; ++k) {
        const double T = coldest * std::pow(hottest / coldest, static_cast<double>(k) / (temperatures - 1));
        try {
          visit(eos_.state_at_temperature(density, T));
        } catch (const StateError&) {
          continue;  // outside the model, as reported by it
        }
      }
    }
  }

  /// Checks convexity over density and temperature. In expansion K_T < 0 is not a fault: cold material fractures, hot
  /// material boils there. Instability next to the compression limit narrows the range; elsewhere it is a finding.
  void check_stability() {
    const double rho0 = eos_.reference_density();
    int states = 0, unstable = 0;
    double unstable_to = std::numeric_limits<double>::infinity();  ///< end of the unstable layer at the limit
    double row = 0;
    bool in_layer = true, row_is_unstable = true;
    std::string first;
    over_the_range([&](const State& s) {
      ++states;
      if (s.density != row) {
        if (!row_is_unstable || s.density < modest_compression * rho0) in_layer = false;
        row = s.density;
        row_is_unstable = false;
      }
      const bool expanded = s.density < rho0;
      const std::string fault =
          expanded ? (s.heat_capacity <= 0 ? "C_v is not positive" : "") : instability(s);
      if (fault.empty()) return;
      row_is_unstable = true;
      if (in_layer) {
        unstable_to = s.density;
      } else if (unstable++ == 0) {
        first = fmt::format("{:.5g} kg/m^3, {:.4g} K, {:.4g} GPa: {}", s.density, s.temperature,
                            s.pressure / GPa, fault);
      }
    });
    result_.range.greatest_density = std::min(result_.range.greatest_density, unstable_to);
    if (unstable > 0) {
      object(Verdict::reservations, "{} of {} states between {:.4g} and {:.4g} kg/m^3 are unstable, first {}",
             unstable, states, thinned * rho0, result_.range.greatest_density, first);
    }
  }

  void check_identities_of_phases() {
    static constexpr std::array members = {&IdentityDefects::pressure,       &IdentityDefects::sound_speed,
                                           &IdentityDefects::heat_capacity,  &IdentityDefects::gruneisen,
                                           &IdentityDefects::bulk_modulus,   &IdentityDefects::entropy_energy,
                                           &IdentityDefects::entropy_volume, &IdentityDefects::round_trip};
    over_the_range([&](const State& s) {
      IdentityDefects defects = check_identities(eos_, s.density, s.specific_internal_energy);
      // If the stencil crosses a kink of the model (a join, the edge of a table), use a smaller step.
      if (defects.largest() > 1e-6) {
        const IdentityDefects closer = check_identities(eos_, s.density, s.specific_internal_energy, 1e-4);
        if (closer.largest() < defects.largest()) defects = closer;
      }
      auto entry = std::ranges::find(result_.identities, s.phase, &PhaseIdentities::phase);
      if (entry == result_.identities.end()) {
        result_.identities.push_back({std::string(s.phase), 0, {}});
        entry = result_.identities.end() - 1;
      }
      ++entry->states;
      for (const auto member : members) {
        const double defect = std::abs(defects.*member);
        if (!std::isnan(defect)) entry->largest.*member = std::fmax(entry->largest.*member, defect);
      }
    });
    for (PhaseIdentities& phase : result_.identities) {
      if (!(phase.largest.largest() > greatest_defect)) continue;
      phase.verdict = Verdict::reservations;
      object(Verdict::reservations, "identities of the phase {} hold to {:.2g} only, not to {:g}",
             phase.phase.empty() ? "of the model" : phase.phase, phase.largest.largest(), greatest_defect);
    }
  }

  const EquationOfState& eos_;
  bool full_;
  bool thermal_ = true;
  Audit result_;
};

}  // namespace

Verdict Audit::verdict() const {
  Verdict worst = Verdict::sound;
  for (const Finding& finding : findings) worst = std::max(worst, finding.weight);
  return worst;
}

std::string Audit::summary() const {
  const Verdict worst = verdict();
  if (worst == Verdict::sound) return "sound";
  std::vector<std::string> texts;
  for (const Finding& finding : findings) {
    if (finding.weight == worst) texts.push_back(finding.text);
  }
  return fmt::format("{}: {}", worst == Verdict::not_usable ? "not usable" : "sound with reservations",
                     fmt::join(texts, "; "));
}

std::string Audit::range_text() const {
  const auto number = [](double value, const char* none) {
    return std::isfinite(value) ? fmt::format("{:.4g}", value) : std::string(none);
  };
  return fmt::format(
      "density {:.4g} ... {} kg/m^3, temperature {} ... {} K, shocks to {:.4g} GPa ({:.4g} km/s)",
      range.least_density, number(range.greatest_density, "any"), number(range.least_temperature, "-"),
      number(range.greatest_temperature, "-"), range.strongest_shock.state.pressure / GPa,
      range.strongest_shock.particle_velocity * 1e-3);
}

Audit audit(const EquationOfState& eos, AuditDepth depth) { return Auditor(eos, depth).run(); }

}  // namespace whipple::eos
