// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace whipple::eos {

/// Holds a fluid state at (V, T), SI per unit mass.
struct FluidPoint {
  double pressure = 0;
  double energy = 0;
  double entropy = 0;
};

/// Holds a point of an isotherm: pressure and slope.
struct IsothermPoint {
  double pressure = 0;
  double pressure_by_volume = 0;  ///< (dP/dV)_T
};

/// Holds liquid and vapour in equilibrium (equal T, P and Gibbs energy), SI per unit mass.
struct Saturation {
  double temperature = 0;
  double pressure = 0;
  double liquid_volume = 0, vapour_volume = 0;
  double liquid_energy = 0, vapour_energy = 0;
  double liquid_entropy = 0, vapour_entropy = 0;

  /// Returns the enthalpy of vaporisation, J/kg.
  [[nodiscard]] double latent_heat() const { return temperature * (vapour_entropy - liquid_entropy); }
};

struct CriticalPoint {
  double temperature = 0, pressure = 0, specific_volume = 0, energy = 0;
};

/// Computes the liquid-vapour dome of a pressure surface with a van der Waals loop, by Maxwell's construction on a
/// grid of temperatures (docs/theory/gray.md, section 5). Immutable after construction.
class VapourDome {
 public:
  struct Search {
    std::function<FluidPoint(double V, double T)> fluid;
    std::function<IsothermPoint(double V, double T)> isotherm;  ///< of the same surface; called most often
    double dense_volume;       ///< smaller than the volume of every saturated liquid
    double loop_volume;        ///< the loop at the critical temperature is above this volume
    double dilute_volume;      ///< larger than the vapour spinodal at the lowest temperature
    double gas_constant;       ///< R/M: P V -> R T/M for V -> infinity
    double temperature_guess;  ///< critical temperature, within a factor of 6
    int rows = 320;
    double least_reduced_temperature = 0.1;  ///< T/T_c of the coldest row
  };
  /// @throws InputError if the surface has no critical point within the search
  explicit VapourDome(const Search& search);

  /// Returns the dome of the surface with volumes, energies and entropies multiplied by `factor`, and the energies
  /// then increased by `energy` (J/kg).
  [[nodiscard]] VapourDome transformed(double factor, double energy) const;

  [[nodiscard]] const CriticalPoint& critical_point() const { return critical_; }
  /// Returns the equilibrium mass fraction of vapour at given volume and energy (lever rule at the temperature at which
  /// the mixture has both): 0 for V below the saturated liquid, 1 beyond the saturated vapour and for supercritical
  /// fluid less dense than the critical point. Continuous; piecewise linear in E between rows of the table.
  [[nodiscard]] double vaporised_fraction(double V, double E) const;
  /// Returns the saturation at a pressure, recomputed on the surface; none above the critical pressure or below the
  /// coldest row.
  [[nodiscard]] std::optional<Saturation> at_pressure(double pressure) const;
  /// Returns the saturation at a temperature; none above the critical temperature or below the coldest row.
  [[nodiscard]] std::optional<Saturation> at_temperature(double temperature) const;
  /// Returns the rows of the table, coldest first.
  [[nodiscard]] const std::vector<Saturation>& rows() const { return rows_; }

 private:
  [[nodiscard]] Saturation saturation_at(double temperature) const;

  Search search_;
  CriticalPoint critical_;
  std::vector<Saturation> rows_;
  /// Holds the volumes and energies of a row for the lever rule (SI, per unit mass).
  struct TieLine {
    double liquid_volume, inverse_width, liquid_energy, energy_width;
    [[nodiscard]] double fraction(double V) const { return (V - liquid_volume) * inverse_width; }
    [[nodiscard]] double energy(double x) const { return liquid_energy + x * energy_width; }
  };
  std::vector<TieLine> tie_lines_;
};

// Steps of the construction, for separate use.

/// Holds the point of steepest increase of an isotherm: the volume of the maximum of V^2 (dP/dV)_T beyond
/// `loop_volume`, and that value (J/kg), which is positive below the critical temperature and zero at it.
struct LoopPoint {
  double volume = 0, steepness = 0;
};
LoopPoint steepest_point(const VapourDome::Search& search, double temperature);

/// Returns the lowest temperature at which the loop has vanished.
/// @throws InputError if there is none within a factor of 6 of the guess
CriticalPoint critical_point(const VapourDome::Search& search);

/// Performs Maxwell's construction at a temperature; the volume must be in the loop of the isotherm.
/// @throws InputError without a loop, StateError if the saturation pressure is outside the search range
Saturation saturation(const VapourDome::Search& search, double temperature, double volume_in_loop);

}  // namespace whipple::eos
