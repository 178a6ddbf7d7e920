// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "eos/equation_of_state.hpp"

/// Defines tables of the SESAME library (Lyon and Johnson, LA-UR-92-3407, 1992): pressure, energy and Helmholtz energy
/// on a grid of density and temperature. SI in memory; Mg/m^3, K, GPa and MJ/kg in files (docs/manual/output.md).
namespace whipple::eos {

/// Holds table 301. Both axes increase strictly; values at density i and temperature j are at [j * nr + i].
struct SesameGrid {
  std::vector<double> density;      ///< kg/m^3; the first may be 0
  std::vector<double> temperature;  ///< K; the first may be 0
  std::vector<double> pressure;     ///< Pa
  std::vector<double> energy;       ///< J/kg
  std::vector<double> helmholtz;    ///< J/kg; empty if absent from the table
};

/// Describes the changes that `raise_energies` made to a table.
struct EnergyRepair {
  std::size_t steps = 0, raised = 0;  ///< steps from one temperature to the next; energies that were raised
  double largest = 0;  ///< increase, as a temperature: over the mean heat capacity of the isochore (K)
  double density = 0, temperature = 0;  ///< location of the largest increase
  double fraction = 0;                  ///< largest increase over its temperature
};

/// Raises energies that do not increase with temperature, as they occur in tables because of phase changes and
/// round-off at low temperature, to the minimum slope: a thousandth of the mean heat capacity of the isochore.
EnergyRepair raise_energies(SesameGrid& grid);

/// Holds table 401, liquid and vapour in equilibrium; one entry per temperature.
struct SesameVaporisation {
  std::vector<double> pressure;                            ///< Pa
  std::vector<double> temperature;                         ///< K
  std::vector<double> vapour_density, liquid_density;      ///< kg/m^3
  std::vector<double> vapour_energy, liquid_energy;        ///< J/kg
  std::vector<double> vapour_helmholtz, liquid_helmholtz;  ///< J/kg; empty if absent from the table
};

/// Holds one material of a SESAME file.
struct SesameMaterial {
  int number = 0;                ///< of the material, 1 to 999999
  int created = 0, changed = 0;  ///< dates as in the file, MMDDYY; 0: none
  std::string comment;           ///< table 101
  double atomic_number = 0;      ///< mean; 0: unknown
  double atomic_mass = 0;        ///< mean, kg/mol; 0: unknown
  double reference_density = 0;  ///< kg/m^3
  double bulk_modulus = 0;       ///< of the solid, Pa; 0: unknown
  double exchange_coefficient = 0;
  SesameGrid total;
  SesameVaporisation vaporisation;  ///< empty if the file has no table 401
};

/// Describes the range of a SESAME table of a model. Zero: the default.
struct SesameRequest {
  double minimum_density = 0;  ///< kg/m^3; default 1e-4 of the reference density
  double maximum_density = 0;  ///< kg/m^3; default: that of the model, at most 10 times the reference density
  double least_temperature = 50.0;    ///< K
  double greatest_temperature = 5e4;  ///< K
};

/// Samples a model: densities in a ratio of at most 1.01 between half and twice the reference density, 1.05 above,
/// 1.25 below; temperatures in a ratio of at most 1.05, including the reference temperature. Helmholtz energies are
/// included if the model has an entropy, table 401 if it has a dome. Number, comment, dates and mean atom must be
/// set by the caller.
/// @throws InputError if the range is empty or the model has no temperature, StateError if the model does not cover
/// the range
SesameMaterial sesame_of(const EquationOfState& eos, const SesameRequest& request);

}  // namespace whipple::eos
