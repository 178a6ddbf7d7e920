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
  shock_velocity,     ///< Us over up along the principal Hugoniot
  shock_pressure,     ///< P over V/V0 along the principal Hugoniot
  isotherm,           ///< P over V/V0 or density at the temperature of each point
  melting,            ///< T over P along the melting line
  isentrope,          ///< P over V/V0 along the principal isentrope
  sound_speed,        ///< bulk sound speed over P along the principal Hugoniot
  shock_temperature,  ///< T over P along the principal Hugoniot
};

/// What a table states of volumes.
enum class VolumeScale {
  ratio,    ///< V/V0: a material is judged by its compressibility
  density,  ///< kg/m^3: and by its density
};

/// One CSV file, or one row of a file of fits. SI.
struct Experiment {
  std::filesystem::path file;
  std::string name;      ///< of the file, without ending
  std::string source;    ///< first comment line
  std::string material;  ///< a word of the names of the materials that it belongs to; empty: any
  ExperimentKind kind = ExperimentKind::isotherm;
  double temperature = nan;  ///< K; of an isotherm whose points have the same
  VolumeScale volume = VolumeScale::ratio;
  double volume_temperature = nan;  ///< K; of V0 of an isotherm, which is that at zero pressure
  double ambient_volume = 0.0;      ///< m^3 per atom, of V0; 0 if the file gives none
  std::vector<double> abscissa;     ///< up (m/s), V/V0, density (kg/m^3) or P (Pa), rising
  std::vector<double> ordinate;     ///< Us (m/s), P (Pa), T (K) or c (m/s)
  // Of each point:
  std::vector<int> lines;
  std::vector<double> initial_density;  ///< kg/m^3, NaN: not stated
  std::vector<double> porosity;         ///< density of the solid over the initial one, NaN: not stated
  std::vector<double> temperatures;     ///< K, of an isotherm; NaN for the other kinds
  bool states_errors = false;           ///< has a column of errors of ordinate or abscissa
  /// One standard deviation; NaN where the row states none, 0 where the table has no such column but the other.
  std::vector<double> ordinate_error, abscissa_error;
  std::map<std::string, std::vector<int>> left_out;  ///< lines of rows that are no such points, by the reason
  std::vector<std::string> remarks;  ///< on what is taken for what, and on columns not understood
  bool only_its_material = false;    ///< nothing for other materials
};

/// Reads a table (`MeasuredTable`). us and up make a Hugoniot; P and a volume or density a Hugoniot if name
/// or comments say so, an isentrope likewise, else isotherms, whose temperatures are those of a column if there is
/// one; P and a bulk sound speed give sound speeds along the Hugoniot; P and a temperature without a volume make a
/// melting line or shock temperatures, whichever name, headings or comments say first; C and S (S2, S3) with a
/// material in each row make a Hugoniot for each row. A comment "material: copper" names what it was measured
/// on. Densities and specific volumes of isotherms are absolute; of Hugoniots and isentropes they are so without
/// rho0 and a row at rest (|P| up to 2 bar). V0 of ratios of an isotherm is that of ambient temperature (298 K, or
/// the isotherm's own from 273 to 323 K), unless a row at rest has V/V0 = 1 or a comment says "V0 at 1500 K".
/// Rows that are no compressed state, such as sound speeds (up = 0), are left out and named.
/// @param temperature  of an isotherm; without it, "298K" in the file name or "298 K" in a comment, or "room
/// temperature" (298 K)
/// @throws InputError with file and line
std::vector<Experiment> read_experiments(const std::filesystem::path& file,
                                         std::optional<double> temperature = {});

/// Returns one quantity of every row of a table, in SI, NaN for empty cells. Where the file lacks the column,
/// what its definition gives: V/V0 from a volume or density with a row at rest or from 1 - up/us, P from
/// rho0 us up.
/// @param column  heading that names the quantity ("P_GPa"); the file may use another unit
/// @throws InputError if the file has no such quantity
std::vector<double> measured_quantity(const std::filesystem::path& file, std::string_view column);

}  // namespace whipple::eos::experiments
