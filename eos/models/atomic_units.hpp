// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Provides atomic units and constants in SI, CODATA 2018.
namespace whipple::eos::atomic {

constexpr double bohr = 5.29177210903e-11;       ///< m
constexpr double hartree = 4.3597447222071e-18;  ///< J
constexpr double boltzmann = 1.380649e-23;       ///< J/K
constexpr double avogadro = 6.02214076e23;       ///< 1/mol

}  // namespace whipple::eos::atomic
