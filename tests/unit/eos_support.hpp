// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "eos/model_equation_of_state.hpp"
#include "eos/models/debye_gruneisen.hpp"
#include "eos/models/gray.hpp"
#include "eos/models/mie_gruneisen.hpp"

/// Constants that the tests of the equations of state share.
namespace whipple::eos::test {

using GrayEos = ModelEquationOfState<Gray>;
using DebyeEos = ModelEquationOfState<DebyeGruneisen>;
using MieGruneisenEos = ModelEquationOfState<MieGruneisen>;

/// Copper: C, S, a, T_m0 of Steinberg, UCRL-MA-106439 (1996), with gamma0 = 1.97.
inline GrayConstants copper(MeltingTransition melting = MeltingTransition::band) {
  GrayConstants c;
  c.molar_mass = 63.546e-3;
  c.reference_specific_volume = 0.1118e-3;
  c.hugoniot_intercept = 3940;
  c.hugoniot_slope = 1.489;
  c.gruneisen = 1.97;
  c.gruneisen_slope = 1.5;
  c.electronic_heat_coefficient = 4.9e-4;
  c.melting_temperature = 1790;
  c.vapour_attraction = 620;  // 0.62 kJ cm^3/g^2
  c.melting = melting;
  return c;
}

/// Aluminium 1100-O: Steinberg's row, electronic heat capacity of aluminium, a_y for T_c near 6600 K.
inline GrayConstants aluminium() {
  GrayConstants c;
  c.molar_mass = 26.9815e-3;
  c.reference_specific_volume = 1 / 2707.0;
  c.hugoniot_intercept = 5386;
  c.hugoniot_slope = 1.339;
  c.gruneisen = 1.97;
  c.gruneisen_slope = 1.5;
  c.electronic_heat_coefficient = 1.35e-3;
  c.melting_temperature = 1220;
  c.vapour_attraction = 3600;
  return c;
}

/// Aluminium 2024-T4 on Steinberg's linear Hugoniot.
inline MieGruneisenConstants aluminium_2024(
    CompressedGruneisenLaw law = CompressedGruneisenLaw::constant_product) {
  MieGruneisenConstants c;
  c.reference_density = 2785;
  c.hugoniot_intercept = 5328;
  c.hugoniot_slope = 1.338;
  c.gruneisen = 2.0;
  c.gruneisen_law = law;
  c.heat_capacity = 863;
  return c;
}

/// One metal: V0 (A^3/atom), K0, K0' of the Vinet isotherm on the revised ruby scale of Dewaele, Loubeyre and
/// Mezouar, Phys. Rev. B 70, 094112 (2004), Table II; Debye temperature and electronic heat coefficient:
/// Kittel, Introduction to Solid State Physics; Grueneisen parameter: Steinberg, UCRL-MA-106439 (1996).
inline DebyeGruneisenConstants debye_metal(double molar_mass, double atomic_volume, double K0, double slope,
                                           double debye_temperature, double electrons, double gruneisen) {
  DebyeGruneisenConstants c;
  c.molar_mass = molar_mass;
  c.reference_density = molar_mass / (6.02214076e23 * atomic_volume * 1e-30);
  c.bulk_modulus = K0;
  c.bulk_modulus_slope = slope;
  c.debye_temperature = debye_temperature;
  c.electronic_heat_coefficient = electrons;
  c.gruneisen = gruneisen;
  c.reference_temperature = 298;
  return c;
}
inline DebyeGruneisenConstants debye_copper() {
  return debye_metal(63.546e-3, 11.810, 132.4e9, 5.32, 343, 0.695e-3, 1.97);
}
inline DebyeGruneisenConstants debye_aluminium() {
  return debye_metal(26.9815e-3, 16.573, 74.3e9, 4.47, 428, 1.35e-3, 1.97);
}
inline DebyeGruneisenConstants debye_tungsten() {
  return debye_metal(183.84e-3, 15.862, 295.2e9, 4.32, 400, 1.3e-3, 1.67);
}
inline DebyeGruneisenConstants debye_tantalum() {
  return debye_metal(180.948e-3, 18.035, 194e9, 3.52, 240, 5.9e-3, 1.67);
}

/// Rows of a CSV file as words, without comments and header.
inline std::vector<std::vector<std::string>> read_csv(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot open " + path);
  std::vector<std::vector<std::string>> rows;
  bool header = true;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (header) {
      header = false;
      continue;
    }
    std::vector<std::string> row;
    std::istringstream words(line);
    for (std::string word; std::getline(words, word, ',');) row.push_back(word);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace whipple::eos::test
