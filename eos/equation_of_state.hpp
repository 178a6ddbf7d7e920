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

/// Arrays of equal length, one entry per point (SI). `melted_fraction`, `vaporised_fraction` and `distension`
/// may be empty.
struct Batch {
  std::span<const double> density;                   ///< kg/m^3
  std::span<const double> specific_internal_energy;  ///< J/kg
  std::span<double> pressure;                        ///< Pa
  std::span<double> temperature;                     ///< K
  std::span<double> sound_speed;                     ///< m/s, isentropic (bulk)
  std::span<double> melted_fraction;                 ///< mass fraction of liquid and vapour
  std::span<double> vaporised_fraction;              ///< mass fraction of vapour
  /// Volume over that of the material without its pores: the past of porous material, in and out. Empty: never
  /// compacted so far. Models without pores leave it alone.
  std::span<double> distension = {};
};

/// Counts the points of a batch outside the model's range. Kernels count and keep the first; the caller throws.
struct RangeReport {
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  std::size_t out_of_range = 0;  ///< points whose state is not defined (NaN, beyond the compression limit)
  std::size_t first = none;      ///< index of the first of them
  std::string_view bound = "";   ///< which bound it broke
  std::size_t below_cold_curve = 0;   ///< points colder than the model's least temperature: clamped, counted
  std::size_t at_pressure_floor = 0;  ///< points held at the least pressure of a modifier: counted

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

/// Where h dp/de falls to this, a step compresses so much that the work of the new pressure is taken by
/// iteration instead of by the slope, whose sum with 1 would vanish soon.
constexpr double least_work_slope = -0.5;

/// The run-time face of every model: one virtual call per batch, never per point. A model itself is a plain
/// struct of constants with a parameter table and inlined functions (eos/models/).
class EquationOfState {
 public:
  virtual ~EquationOfState() = default;

  [[nodiscard]] virtual std::string_view model() const = 0;
  /// Density and temperature of the reference state, energy of it (kg/m^3, K, J/kg).
  [[nodiscard]] virtual double reference_density() const = 0;
  [[nodiscard]] virtual double reference_temperature() const = 0;
  [[nodiscard]] virtual double reference_energy() const = 0;
  /// Returns whether the model describes condensed material, which has a state of zero pressure: bodies start there. A
  /// gas has none: bodies start in its reference state.
  [[nodiscard]] virtual bool condensed() const { return true; }
  /// Returns whether points may melt or vaporise: else both fractions are always 0.
  [[nodiscard]] virtual bool has_phases() const { return true; }
  /// Time of the constitutive update with this model over that with an explicit one (some 50 ns a point), as
  /// measured: ranks share the particles out by it.
  [[nodiscard]] virtual double relative_cost() const { return 1.0; }
  /// Largest density that the model is valid for (kg/m^3).
  [[nodiscard]] virtual double maximum_density() const = 0;
  /// Least specific internal energy at a density (J/kg): that of the coldest state which the model describes.
  [[nodiscard]] virtual double minimum_energy(double density) const = 0;
  /// The coldest temperature that the model describes (K); points with less energy are held there.
  [[nodiscard]] virtual double least_temperature() const = 0;

  /// p, T, c (and phase fractions) from density and specific internal energy. Does not throw, does not
  /// allocate.
  virtual RangeReport evaluate(const Batch& batch) const = 0;
  /// Evaluates a batch at the energy that the work of the pressure itself leaves: e = e_0 - h p(rho, e), the
  /// trapezoidal rule of docs/theory/material.md, eq. 14. Two evaluations and the secant through them, exact
  /// where p is linear in e; models that know its slope need one.
  /// @param batch        its energies are those of `energy`; pressure on entry: before the step
  /// @param energy       e_0, all but the work of the new pressure (J/kg); on return e
  /// @param half_change  h, half the change of the specific volume (m^3/kg)
  virtual RangeReport integrate(const Batch& batch, std::span<double> energy,
                                std::span<const double> half_change) const;

  /// One point with everything that the model knows.
  /// @throws StateError out of range
  [[nodiscard]] virtual State state(double density, double specific_internal_energy) const = 0;
  /// @throws StateError out of range, InputError if the model carries no temperature
  [[nodiscard]] virtual State state_at_temperature(double density, double temperature) const = 0;

  /// The dome of liquid and vapour in equilibrium; null if the model has none.
  [[nodiscard]] virtual const VapourDome* vapour_dome() const { return nullptr; }

  /// Densities at which the edges of the phases on isochores have kinks, beside those at which a phase
  /// appears or ends (kg/m^3): a table starts over there.
  [[nodiscard]] virtual std::vector<double> kinks() const { return {}; }

  /// Distension of the material that bodies start from; 1: no pores.
  [[nodiscard]] virtual double initial_distension() const { return 1.0; }
  /// Pressure at which material of a distension is crushed further (Pa); infinite: never, or no pores left.
  virtual void crush_pressure(std::span<const double> distension, std::span<double> pressure) const {
    for (std::size_t i = 0; i < distension.size(); ++i) pressure[i] = std::numeric_limits<double>::infinity();
  }
  /// The surface on which a state expands, if that is another one than the one it was loaded on (compacted
  /// pores do not open again); null: the same.
  [[nodiscard]] virtual std::unique_ptr<EquationOfState> unloading(const State& /*from*/) const {
    return nullptr;
  }

  /// All constants with units as TOML lines (provenance in output files).
  [[nodiscard]] virtual std::string constants() const = 0;
};

}  // namespace whipple::eos
