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

/// Denotes values missing from a row and states outside the range of a model.
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
  heat_capacity,      ///< c_p over T at zero pressure
  expansion,          ///< coefficient of linear thermal expansion over T at zero pressure
};

/// Specifies the meaning of volumes in a table.
enum class VolumeScale {
  ratio,    ///< V/V0: tests the compressibility of a material
  density,  ///< kg/m^3: also tests its density
};

/// Holds the data of one CSV file, or one row of a file of fits. SI.
struct Experiment {
  std::filesystem::path file;
  std::string name;      ///< of the file, without extension
  std::string source;    ///< first comment line
  std::string material;  ///< a word in the names of matching materials; empty: any
  ExperimentKind kind = ExperimentKind::isotherm;
  double temperature = nan;  ///< K; common temperature of an isotherm
  VolumeScale volume = VolumeScale::ratio;
  double volume_temperature = nan;  ///< K; of V0 (at zero pressure) of an isotherm
  double ambient_volume = 0.0;      ///< m^3 per atom, of V0; 0 if the file gives none
  std::vector<double> abscissa;     ///< up (m/s), V/V0, density (kg/m^3), P (Pa) or T (K), increasing
  std::vector<double> ordinate;     ///< Us (m/s), P (Pa), T (K), c (m/s), c_p (J/(kg K)) or expansion (1/K)
  // For each point:
  std::vector<int> lines;
  std::vector<double> initial_density;  ///< kg/m^3, NaN: not given
  std::vector<double> porosity;         ///< density of the solid over the initial one, NaN: not given
  std::vector<double> temperatures;     ///< K, of an isotherm; NaN for the other kinds
  bool states_errors = false;           ///< has a column of errors of ordinate or abscissa
  /// One standard deviation; NaN for rows without one, 0 if only the table's other column of errors exists.
  std::vector<double> ordinate_error, abscissa_error;
  std::map<std::string, std::vector<int>> left_out;  ///< lines of excluded rows, by the reason
  std::vector<std::string> remarks;  ///< on assumptions, and on columns that were not understood
  bool only_its_material = false;    ///< not applicable to other materials
};

/// Reads a table (`MeasuredTable`). us and up give a Hugoniot; P and a volume or density give a Hugoniot or isentrope
/// if the name or the comments indicate it, otherwise isotherms, with temperatures from a column if there is one; P and
/// a bulk sound speed give sound speeds along the Hugoniot; P and a temperature without a volume give a melting line or
/// shock temperatures, as indicated first by name, headings or comments; T and a heat capacity or a linear expansion give
/// these at zero pressure; C and S (S2, S3) with a material in each row
/// give a Hugoniot for each row. A comment "material: copper" specifies the measured material. Densities and specific
/// volumes of isotherms are absolute; those of Hugoniots and isentropes are absolute if there is neither rho0 nor a row
/// at rest (|P| up to 2 bar). V0 of the ratios of an isotherm is that at ambient temperature (298 K, or the temperature
/// of the isotherm if it is from 273 to 323 K), unless a row at rest has V/V0 = 1 or a comment reads "V0 at 1500 K".
/// Rows that are not compressed states, such as sound speeds (up = 0), are excluded and listed.
/// @param temperature  of an isotherm; if absent, "298K" in the file name or "298 K" in a comment, or "room
/// temperature" (298 K)
/// @throws InputError with file and line
std::vector<Experiment> read_experiments(const std::filesystem::path& file,
                                         std::optional<double> temperature = {});

/// Returns one quantity of every row of a table, in SI, NaN for empty cells. If the file lacks the column, the
/// quantity is derived: V/V0 from a volume or density with a row at rest or from 1 - up/us, P from rho0 us up.
/// @param column  heading that names the quantity ("P_GPa"); the file may use another unit
/// @throws InputError if the file has no such quantity
std::vector<double> measured_quantity(const std::filesystem::path& file, std::string_view column);

}  // namespace whipple::eos::experiments
