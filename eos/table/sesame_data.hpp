// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "eos/equation_of_state.hpp"

/// Tables of the SESAME library (Lyon and Johnson, LA-UR-92-3407, 1992): pressure, energy and Helmholtz
/// energy on a grid of density and temperature. SI here; Mg/m^3, K, GPa and MJ/kg in files (docs/manual/output.md).
namespace whipple::eos {

/// Table 301. Both axes rise strictly; values of the density i and the temperature j at [j * nr + i].
struct SesameGrid {
  std::vector<double> density;      ///< kg/m^3; the first may be 0
  std::vector<double> temperature;  ///< K; the first may be 0
  std::vector<double> pressure;     ///< Pa
  std::vector<double> energy;       ///< J/kg
  std::vector<double> helmholtz;    ///< J/kg; empty: not in the table
};

/// What `raise_energies` did to a table.
struct EnergyRepair {
  std::size_t steps = 0, raised = 0;  ///< steps from one temperature to the next; energies that were raised
  double largest = 0;  ///< raise, as a temperature: over the mean heat capacity of the isochore (K)
  double density = 0, temperature = 0;  ///< where that was
  double fraction = 0;                  ///< largest raise over its temperature
};

/// Raises energies that do not rise with the temperature, as tables have them from phase changes and from round-off in
/// the cold, to the least rise: a thousandth of the mean heat capacity of the isochore.
EnergyRepair raise_energies(SesameGrid& grid);

/// Table 401, liquid and vapour in equilibrium; one entry per temperature.
struct SesameVaporisation {
  std::vector<double> pressure;                            ///< Pa
  std::vector<double> temperature;                         ///< K
  std::vector<double> vapour_density, liquid_density;      ///< kg/m^3
  std::vector<double> vapour_energy, liquid_energy;        ///< J/kg
  std::vector<double> vapour_helmholtz, liquid_helmholtz;  ///< J/kg; empty: not in the table
};

/// One material of a SESAME file.
struct SesameMaterial {
  int number = 0;                ///< of the material, 1 to 999999
  int created = 0, changed = 0;  ///< dates as the file has them, MMDDYY; 0: none
  std::string comment;           ///< table 101
  double atomic_number = 0;      ///< mean; 0: not known
  double atomic_mass = 0;        ///< mean, kg/mol; 0: not known
  double reference_density = 0;  ///< kg/m^3
  double bulk_modulus = 0;       ///< of the solid, Pa; 0: not known
  double exchange_coefficient = 0;
  SesameGrid total;
  SesameVaporisation vaporisation;  ///< empty: the file has no table 401
};

/// Describes the range that a SESAME table of a model shall cover. Zero: the default.
struct SesameRequest {
  double minimum_density = 0;         ///< kg/m^3; default 1e-4 of the reference density
  double maximum_density = 0;         ///< kg/m^3; default the model's, at most 10 times the reference density
  double least_temperature = 50.0;    ///< K
  double greatest_temperature = 5e4;  ///< K
};

/// Samples a model: densities in a ratio of at most 1.01 between half and twice the reference density, 1.05
/// above, 1.25 below; temperatures in a ratio of at most 1.05, the reference temperature among them.
/// Helmholtz energies if the model has an entropy, table 401 if it has a dome. Number, comment, dates and
/// mean atom are left to the caller.
/// @throws InputError if the range is empty or the model carries no temperature, StateError if the model does
/// not cover the range
SesameMaterial sesame_of(const EquationOfState& eos, const SesameRequest& request);

}  // namespace whipple::eos
