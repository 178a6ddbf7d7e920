// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "eos/state.hpp"
#include "eos/vapour_dome.hpp"

namespace whipple::eos {

/// Holds arrays of equal length, one entry per point (SI). `melted_fraction`, `vaporised_fraction` and `distension`
/// may be empty.
struct Batch {
  std::span<const double> density;                   ///< kg/m^3
  std::span<const double> specific_internal_energy;  ///< J/kg
  std::span<double> pressure;                        ///< Pa
  std::span<double> temperature;                     ///< K
  std::span<double> sound_speed;                     ///< m/s, isentropic (bulk)
  std::span<double> melted_fraction;                 ///< mass fraction of liquid and vapour
  std::span<double> vaporised_fraction;              ///< mass fraction of vapour
  /// Volume over that of the pore-free material: the history variable of porous material, in and out. Empty: never
  /// compacted so far. Models without pores do not change it.
  std::span<double> distension = {};
};

/// Counts the points of a batch outside the model's range. Kernels count and keep the first; the caller throws.
struct RangeReport {
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::size_t out_of_range = 0;       ///< points whose state is undefined (NaN, beyond the compression limit)
  std::size_t first = none;           ///< index of the first such point
  std::string_view bound = "";        ///< the violated bound
  std::size_t below_cold_curve = 0;   ///< points below the model's lowest temperature: clamped and counted
  std::size_t at_pressure_floor = 0;  ///< points at the minimum pressure of a modifier: counted

  void merge(const RangeReport& other) {
    if (other.first != none && (first == none || other.first < first)) {
      first = other.first;
      bound = other.bound;
    }
    out_of_range += other.out_of_range;
    below_cold_curve += other.below_cold_curve;
    at_pressure_floor += other.at_pressure_floor;
  }
};

/// Threshold of h dp/de below which a step compresses so strongly that the work of the new pressure is iterated
/// instead of using the slope, whose sum with 1 approaches zero.
constexpr double least_work_slope = -0.5;

/// Defines the run-time interface of every model: one virtual call per batch, never per point. A model is a plain
/// struct of constants with a parameter table and inlined functions (eos/models/).
class EquationOfState {
 public:
  virtual ~EquationOfState() = default;

  [[nodiscard]] virtual std::string_view model() const = 0;
  /// Returns the density of the reference state (kg/m^3); the next two return its temperature (K) and energy (J/kg).
  [[nodiscard]] virtual double reference_density() const = 0;
  [[nodiscard]] virtual double reference_temperature() const = 0;
  [[nodiscard]] virtual double reference_energy() const = 0;
  /// Returns whether the model describes condensed material, which has a state of zero pressure as the initial
  /// state of bodies. A gas has none, and its bodies start in the reference state.
  [[nodiscard]] virtual bool condensed() const { return true; }
  /// Returns whether the model describes detonation products: its reference state is the explosive with its heat of
  /// reaction.
  [[nodiscard]] virtual bool detonates() const { return false; }
  /// Returns whether points may melt or vaporise; otherwise both fractions are always 0.
  [[nodiscard]] virtual bool has_phases() const { return true; }
  /// Returns the measured time of the constitutive update with this model relative to that with an explicit one
  /// (about 50 ns per point), used to balance the load of the ranks.
  [[nodiscard]] virtual double relative_cost() const { return 1.0; }
  /// Returns the largest density for which the model is valid (kg/m^3).
  [[nodiscard]] virtual double maximum_density() const = 0;
  /// Returns the lowest specific internal energy at a density (J/kg): that of the coldest state described by the model.
  [[nodiscard]] virtual double minimum_energy(double density) const = 0;
  /// Returns the lowest temperature described by the model (K); points with less energy are limited to it.
  [[nodiscard]] virtual double least_temperature() const = 0;
  /// Returns the temperature up to which the model is meant to hold (K): audits go as far.
  [[nodiscard]] virtual double intended_temperature() const { return usual_intended_temperature; }
  static constexpr double usual_intended_temperature = 1e5;  ///< K

  /// Evaluates p, T, c (and phase fractions) from density and specific internal energy. Does not throw and does not
  /// allocate.
  virtual RangeReport evaluate(const Batch& batch) const = 0;
  /// Evaluates a batch at the energy that includes the work of the new pressure: e = e_0 - h p(rho, e), the
  /// trapezoidal rule of docs/theory/material.md, eq. 14. Uses two evaluations and the secant through them, exact
  /// where p is linear in e; models with a known slope need one.
  /// @param batch        its energies are those of `energy`; pressure on entry: before the step
  /// @param energy       e_0, all but the work of the new pressure (J/kg); on return e
  /// @param half_change  h, half the change of the specific volume (m^3/kg)
  virtual RangeReport integrate(const Batch& batch, std::span<double> energy,
                                std::span<const double> half_change) const;

  /// Returns the full state of one point.
  /// @throws StateError out of range
  [[nodiscard]] virtual State state(double density, double specific_internal_energy) const = 0;
  /// Returns the state at a temperature. @throws StateError out of range, InputError if the model has no temperature
  [[nodiscard]] virtual State state_at_temperature(double density, double temperature) const = 0;

  /// Returns the dome of liquid and vapour in equilibrium; null if the model has none.
  [[nodiscard]] virtual const VapourDome* vapour_dome() const { return nullptr; }

  /// Returns the densities (kg/m^3) at which phase boundaries along isochores have kinks, in addition to those at
  /// which a phase appears or ends; tables start a new strip there.
  [[nodiscard]] virtual std::vector<double> kinks() const { return {}; }

  /// Returns the initial distension of bodies; 1: no pores.
  [[nodiscard]] virtual double initial_distension() const { return 1.0; }
  /// Computes the pressure at which material of a distension is crushed further (Pa); infinite: never, or no pores
  /// left.
  virtual void crush_pressure(std::span<const double> distension, std::span<double> pressure) const {
    for (std::size_t i = 0; i < distension.size(); ++i) pressure[i] = std::numeric_limits<double>::infinity();
  }
  /// Returns the surface on which a state expands, if it differs from the loading surface (compacted pores do not
  /// reopen); null otherwise.
  [[nodiscard]] virtual std::unique_ptr<EquationOfState> unloading(const State& /*from*/) const {
    return nullptr;
  }

  /// Returns all constants with units as TOML lines (provenance in output files).
  [[nodiscard]] virtual std::string constants() const = 0;
};

}  // namespace whipple::eos
