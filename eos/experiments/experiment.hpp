// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace whipple::eos::experiments {

/// Stands for what a row does not state and for states outside the range of a model.
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Names the two measured quantities of an experiment.
enum class ExperimentKind {
  shock_velocity,  ///< Us over up along the principal Hugoniot
  shock_pressure,  ///< P over V/V0 along the principal Hugoniot
  isotherm,        ///< P over V/V0 at constant temperature
  melting,         ///< T over P along the melting line
  isentrope,       ///< P over V/V0 along the principal isentrope
  sound_speed,     ///< bulk sound speed over P along the principal Hugoniot
};

/// One CSV file, or one row of a file of fits. SI; volumes as ratios to the experiment's own volume at zero
/// pressure.
struct Experiment {
  std::filesystem::path file;
  std::string name;      ///< of the file, without ending
  std::string source;    ///< first comment line
  std::string material;  ///< a word of the names of the materials that it belongs to; empty: any
  ExperimentKind kind = ExperimentKind::isotherm;
  double temperature = 0.0;      ///< K; of an isotherm
  double ambient_volume = 0.0;   ///< m^3 per atom; 0 if the file gives ratios
  std::vector<double> abscissa;  ///< up (m/s), V/V0 or P (Pa), rising
  std::vector<double> ordinate;  ///< Us (m/s), P (Pa), T (K) or c (m/s)
  // Of each point:
  std::vector<int> lines;
  std::vector<double> initial_density;  ///< kg/m^3, NaN: not stated
  std::vector<double> porosity;         ///< density of the solid over the initial one, NaN: not stated
  /// One standard deviation of ordinate and abscissa where an isotherm states them; empty: not stated.
  std::vector<double> ordinate_error, abscissa_error;
  std::map<std::string, std::vector<int>> left_out;  ///< lines of rows that are no such points, by the reason
  bool only_its_material = false;                    ///< nothing for other materials
};

/// Reads a table (`MeasuredTable`). us and up make a Hugoniot; P and a volume or density a Hugoniot if name
/// or comments say so, an isentrope likewise, else an isotherm; P and a bulk sound speed give sound speeds
/// along the Hugoniot; P and a temperature without a volume make a melting line; C and S (S2, S3) with a
/// material in each row make a Hugoniot for each row. A comment "material: copper" names what it was measured
/// on. Without V_over_V0 the reference volume is that of rho0, or that of the row with P = 0. Rows that are
/// no compressed state, such as sound speeds (up = 0) and P = 0, are left out and named.
/// @param temperature  of an isotherm; without it, "298K" in the file name or "298 K" in a comment, or "room
/// temperature" (298 K)
/// @throws InputError with file and line
std::vector<Experiment> read_experiments(const std::filesystem::path& file,
                                         std::optional<double> temperature = {});

/// Returns one quantity of every row of a table, in SI, NaN for empty cells. Where the file lacks the column,
/// what its definition gives: V/V0 from a volume or density with a row at P = 0 or from 1 - up/us, P from
/// rho0 us up.
/// @param column  heading that names the quantity ("P_GPa"); the file may use another unit
/// @throws InputError if the file has no such quantity
std::vector<double> measured_quantity(const std::filesystem::path& file, std::string_view column);

}  // namespace whipple::eos::experiments
