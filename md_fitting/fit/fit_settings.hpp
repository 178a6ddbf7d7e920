// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "eos/models/gray_constants.hpp"
#include "src/core/base/words.hpp"

namespace whipple::fit {

/// Holds the errors of the laws of GRAY on data without noise: part of the weights
/// (docs/theory/fit.md, section 3). All are one standard deviation.
struct ModelErrors {
  double zero_pressure_volume = 1e-4;  ///< relative
  double shock_velocity = 3e-3;        ///< relative, per Hugoniot state: Us-up is not exactly a line
  double gruneisen = 0.02;             ///< relative, common to an isochore: gamma is not exactly linear in V
  double anharmonic = 2e-4;            ///< J/(mol K^2), common to an isochore: the coefficient depends on V
  double thermal_pressure = 0.01;      ///< relative, per state: gamma depends on T, too
  double energy = 0.003;  ///< relative to the thermal energy, per state: not exactly quadratic in T
  double melting_temperature = 0.01;  ///< relative: Lindemann law
  double latent_heat = 0.05;          ///< relative: one entropy of melting for all volumes
  double isotherm_pressure = 0.01;    ///< relative, per state: Vinet's form
  double isotherm_volume = 5e-4;      ///< relative, per state, as a pressure
  double liquid_density = 0.03;       ///< relative, of the saturated melt: the form of the fluid
  double vapour_density = 0.3;        ///< relative, of the saturated vapour

  /// No model error at all: the weights are those of the noise.
  static ModelErrors none() { return {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}; }
};

/// How the model errors of the states of one curve are related.
enum class ErrorStructure {
  correlated,  ///< a smooth deviation of the law from the curve: Matern covariance of stated lengths
  independent  ///< one deviation for each state, those of an isochore's law common to it
};
constexpr std::array<Word<ErrorStructure>, 2> words(ErrorStructure) {
  return {{{ErrorStructure::correlated, "correlated"}, {ErrorStructure::independent, "independent"}}};
}

/// Lengths over which the deviation of a law from its curve changes (docs/theory/fit.md, section 3).
struct CorrelationLengths {
  double particle_velocity = 1000.0;  ///< m/s, of Us-up
  double volume_ratio = 0.1;          ///< of V/V0: isochores, isotherm, melting line
  double temperature = 1000.0;        ///< K, along an isochore
};

/// Which windows of particle velocities the constants are taken from.
enum class WindowChoice {
  averaged,  ///< mean over the windows, their scatter is part of the covariance
  single     ///< the window of the settings alone
};
constexpr std::array<Word<WindowChoice>, 2> words(WindowChoice) {
  return {{{WindowChoice::averaged, "averaged"}, {WindowChoice::single, "single"}}};
}

/// Whose thermodynamics the isotherm of a fit is.
enum class Nuclei {
  quantum,   ///< with what the points of the protocol "quantum" add, if there are any at the reference
             ///< temperature
  classical  ///< as simulated
};
constexpr std::array<Word<Nuclei>, 2> words(Nuclei) {
  return {{{Nuclei::quantum, "quantum"}, {Nuclei::classical, "classical"}}};
}

struct FitSettings {
  double reference_temperature = 293.0;    ///< K: V0 is the volume at zero pressure and this temperature
  double least_particle_velocity = 300.0;  ///< m/s, window of the Hugoniot states
  double most_particle_velocity = 2500.0;  ///< m/s
  /// Curve of the model through the coexistence points: the lower edge of its melting band, T_m(V) itself, or
  /// the common tangent of solid and liquid. It is also the melting transition of the material.
  eos::MeltingTransition melting = eos::MeltingTransition::equilibrium;
  ModelErrors model_errors;
  ErrorStructure structure = ErrorStructure::correlated;
  CorrelationLengths lengths;
  bool inflation = true;  ///< model errors grow until chi^2 of each kind of data is what it should be
  WindowChoice windows = WindowChoice::averaged;
  Nuclei nuclei = Nuclei::quantum;
  /// Name of a choice of the element's table, or a quantity; none: the first choice.
  std::optional<std::string> electrons;
  std::optional<std::filesystem::path> defaults{};  ///< a file of the user with constants of elements
  int bootstrap = 0;                                ///< replicates; 0: none
  std::optional<double> density;  ///< kg/m^3: replaces the fitted reference volume by a measured one
};

/// Leaves one window and the stated model errors, each state by itself: for what counts the information of
/// single states.
inline FitSettings independent_errors(FitSettings settings) {
  settings.structure = ErrorStructure::independent;
  settings.inflation = false;
  settings.windows = WindowChoice::single;
  return settings;
}

}  // namespace whipple::fit
