// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "src/material/material.hpp"

/// Measured compression curves against a material's equation of state (docs/theory/fit.md, section 6).
namespace whipple::app {

enum class ExperimentKind {
  shock_velocity,  ///< Us over up along the principal Hugoniot
  shock_pressure,  ///< P over V/V0 along the principal Hugoniot
  isotherm,        ///< P over V/V0 at constant temperature
  melting,         ///< T over P along the melting line
};

/// One CSV file. SI; volumes as ratios to the experiment's own volume at zero pressure.
struct Experiment {
  std::filesystem::path file;
  std::string name;      ///< of the file, without ending
  std::string source;    ///< first comment line
  std::string material;  ///< a word of the names of the materials that it belongs to; empty: any
  ExperimentKind kind = ExperimentKind::isotherm;
  double temperature = 0.0;      ///< K; of an isotherm
  double ambient_volume = 0.0;   ///< m^3 per atom; 0 if the file gives ratios
  std::vector<double> abscissa;  ///< up (m/s), V/V0 or P (Pa), rising
  std::vector<double> ordinate;  ///< Us (m/s), P (Pa) or T (K)
};

/// Reads a CSV file: '#' comments name the source, the header names each column with its unit (us_km_s,
/// up_km_s, P_GPa, P_revised_ruby_GPa, V_over_V0, atomic_volume_A3, V_cm3_g, rho_g_cm3; other columns are
/// ignored). us and up make a Hugoniot; P and a volume a Hugoniot if name or comments say so, else an
/// isotherm; P and a temperature (T_K, Tm_K) without a volume make a melting line. A comment "material:
/// copper" names what it was measured on. Of several pressure scales the revised one counts. An atomic volume
/// is divided by that of the row with P = 0. Points at rest (up = 0: sound speeds) are no shocks and are left
/// out, and so is P = 0, which is the reference itself.
/// @param temperature  of an isotherm; without it, "298K" in the file name or "298 K" in a comment, or "room
/// temperature" (298 K)
/// @throws InputError with file and line
Experiment read_experiment(const std::filesystem::path& file, std::optional<double> temperature = {});

/// A path, or a bare file name of the experiments that come with the program (eos/data).
/// @throws InputError if there is no such file
std::filesystem::path find_experiment(const std::string& name);

/// One quantity of every row of a CSV file, in SI, NaN for empty cells. Where the file lacks the column, what
/// its definition gives: V/V0 from a volume or density with a row at P = 0 or from 1 - up/us, P from rho0 us
/// up.
/// @param column  name with unit as in the tables of `whipple eos` ("P_GPa"); the file may use another unit
/// @throws InputError if the file has no such quantity
std::vector<double> measured_quantity(const std::filesystem::path& file, const std::string& column);

/// The equation of state on the points of an experiment.
struct Comparison {
  std::vector<double> model;  ///< ordinate of the material; NaN outside its range
  /// In percent of the measured Us or T, or in Pa; model less experiment.
  std::vector<double> deviation;
  int points = 0;  ///< inside the range of the material
  int out_of_range = 0;
  double rms = 0.0, mean = 0.0, maximum = 0.0;  ///< `maximum`: the deviation of largest size, with its sign
};

/// Whether a material of this name is of the kind that was measured.
bool belongs_to(const Experiment& experiment, const Material& material);

/// Of a melting line counts the middle of solidus and liquidus. The initial state of a Hugoniot, and the
/// reference volume of an isotherm, are the material's own: zero pressure at its reference temperature, or at
/// the temperature of the isotherm.
Comparison compare(const Material& material, const Experiment& experiment);

/// The curve of the material over the range of the experiment, `count` points of equal distance.
std::vector<double> curve(const Material& material, const Experiment& experiment,
                          const std::vector<double>& abscissa);

}  // namespace whipple::app
