// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "eos/models/gray_constants.hpp"
#include "src/core/base/words.hpp"

namespace whipple::fit {

/// Holds the errors of the laws of GRAY on noise-free data, which contribute to the weights (docs/theory/fit.md,
/// section 3). All are one standard deviation.
struct ModelErrors {
  double zero_pressure_volume = 1e-4;  ///< relative
  double shock_velocity = 3e-3;        ///< relative, per Hugoniot state: Us-up is not exactly a line
  double gruneisen = 0.02;             ///< relative, common to an isochore: gamma is not exactly linear in V
  double anharmonic = 2e-4;            ///< J/(mol K^2), common to an isochore: the coefficient depends on V
  double thermal_pressure = 0.01;      ///< relative, per state: gamma also depends on T
  double energy = 0.003;  ///< relative to the thermal energy, per state: not exactly quadratic in T
  double melting_temperature = 0.01;  ///< relative: Lindemann law
  double latent_heat = 0.05;          ///< relative: one entropy of melting for all volumes
  double isotherm_pressure = 0.01;    ///< relative, per state: Vinet's form
  double isotherm_volume = 5e-4;      ///< relative, per state, as a pressure
  double liquid_density = 0.03;       ///< relative, of the saturated melt: the form of the fluid
  double vapour_density = 0.3;        ///< relative, of the saturated vapour

  /// Returns zero model errors: the weights are those of the noise.
  static ModelErrors none() { return {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}; }
};

/// Specifies how the model errors of the states of one curve are related.
enum class ErrorStructure {
  correlated,  ///< a smooth deviation of the law from the curve: Matern covariance of stated lengths
  independent  ///< an independent deviation for each state; an isochore's law has a common one
};
constexpr std::array<Word<ErrorStructure>, 2> words(ErrorStructure) {
  return {{{ErrorStructure::correlated, "correlated"}, {ErrorStructure::independent, "independent"}}};
}

/// Holds the correlation lengths of the discrepancy of a law along its curve (docs/theory/fit.md, section 3).
struct CorrelationLengths {
  double particle_velocity = 1000.0;  ///< m/s, of Us-up
  double volume_ratio = 0.1;          ///< of V/V0: isochores, isotherm, melting line
  double temperature = 1000.0;        ///< K, along an isochore
};

/// Specifies the windows of particle velocities from which the constants are taken.
enum class WindowChoice {
  averaged,  ///< mean over the windows; their scatter contributes to the covariance
  single     ///< only the window of the settings
};
constexpr std::array<Word<WindowChoice>, 2> words(WindowChoice) {
  return {{{WindowChoice::averaged, "averaged"}, {WindowChoice::single, "single"}}};
}

/// Specifies the nuclei to which the isotherm of a fit applies.
enum class Nuclei {
  quantum,  ///< with the quantum corrections of the protocol "quantum", if present at the reference temperature
  classical  ///< as simulated
};
constexpr std::array<Word<Nuclei>, 2> words(Nuclei) {
  return {{{Nuclei::quantum, "quantum"}, {Nuclei::classical, "classical"}}};
}

struct FitSettings {
  double reference_temperature = 293.0;    ///< K: V0 is the volume at zero pressure and this temperature
  double least_particle_velocity = 300.0;  ///< m/s, window of the Hugoniot states
  double most_particle_velocity = 2500.0;  ///< m/s
  /// Model curve through the coexistence points: the lower edge of the melting band, T_m(V), or the common tangent
  /// of solid and liquid. It is also the melting transition of the material.
  eos::MeltingTransition melting = eos::MeltingTransition::equilibrium;
  ModelErrors model_errors;
  ErrorStructure structure = ErrorStructure::correlated;
  CorrelationLengths lengths;
  bool inflation = true;  ///< scale model errors up until chi^2 of each kind of data has its expected value
  WindowChoice windows = WindowChoice::averaged;
  Nuclei nuclei = Nuclei::quantum;
  /// Name of a choice in the element's table, or a quantity; none: the first choice.
  std::optional<std::string> electrons;
  std::optional<std::filesystem::path> defaults{};  ///< file of the user with constants of elements
  int bootstrap = 0;                                ///< replicates; 0: none
  bool correction = false;        ///< correct the free energies of GRAY to the simulated states
  int correction_samples = 0;     ///< number of corrections drawn from their posterior distribution
  std::uint64_t seed = 1;         ///< of the draws
  std::optional<double> density;  ///< kg/m^3: replaces the fitted reference volume by a measured one
  std::vector<std::filesystem::path> measured{};  ///< tables of measurements that take part in the fit
  std::vector<std::filesystem::path> checked{};   ///< tables that the fit with `measured` predicts
};

/// Returns settings with a single window, the stated model errors and independent errors of the states, for
/// purposes that count the information of single states.
inline FitSettings independent_errors(FitSettings settings) {
  settings.structure = ErrorStructure::independent;
  settings.inflation = false;
  settings.windows = WindowChoice::single;
  return settings;
}

}  // namespace whipple::fit
