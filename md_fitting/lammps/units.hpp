// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Converts between the LAMMPS unit set "metal" and SI; no other file does. The constants are those used internally
/// by LAMMPS for this set (its update.cpp), so that kinetic energies and pressures agree to the last digit.
namespace whipple::md::metal {

inline constexpr double angstrom = 1e-10;                 ///< m
inline constexpr double picosecond = 1e-12;               ///< s
inline constexpr double bar = 1e5;                        ///< Pa
inline constexpr double electron_volt = 1.602176634e-19;  ///< J, exact since 2019
inline constexpr double dalton = 1.66053906660e-27;       ///< kg, CODATA 2018
inline constexpr double boltzmann = 8.617343e-5;          ///< eV/K in LAMMPS (CODATA 2006; 1e-6 below 2018)
inline constexpr double pressure_from_energy = 1.6021765e6;  ///< bar per eV/A^3 in LAMMPS
inline constexpr double avogadro = 6.02214076e23;            ///< 1/mol, exact since 2019

/// Returns J/kg from an energy per atom in eV and the atomic mass in g/mol.
inline double specific_energy(double energy_per_atom, double mass) {
  return energy_per_atom * electron_volt / (mass * dalton);
}
/// Returns m^3/kg from a volume per atom in A^3 and the atomic mass in g/mol.
inline double specific_volume(double volume_per_atom, double mass) {
  return volume_per_atom * angstrom * angstrom * angstrom / (mass * dalton);
}
/// Returns A^3 per atom from m^3/kg.
inline double volume_per_atom(double volume, double mass) {
  return volume * (mass * dalton) / (angstrom * angstrom * angstrom);
}

}  // namespace whipple::md::metal

/// Defines constants in SI (exact since 2019; hbar to ten digits).
namespace whipple::md::si {
inline constexpr double hbar = 1.054571817e-34;    ///< J s
inline constexpr double boltzmann = 1.380649e-23;  ///< J/K
}  // namespace whipple::md::si
