// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "eos/equation_of_state.hpp"

namespace whipple::eos {

/// Mixes two materials without phases at common pressure and temperature, for batches: the same equilibrium as
/// `mixture_at_energy` (eos/closure.hpp) for one state, in a hundredth of its time
/// (docs/theory/equations_of_state.md, "Mixtures in pressure-temperature equilibrium").
struct MixtureOfTwo {
  const EquationOfState& first;
  const EquationOfState& second;
  double energy_of_first = 0;  ///< zero of its energy above that of the second, J/kg

  /// Mass fraction of the second below which its volume is lost in round-off.
  static constexpr double least_fraction = 1e-6;

  /// Evaluates pressure, temperature and sound speed at equilibrium. Points without a common pressure are out
  /// of range.
  /// @param batch            energies are relative to the zero of the second; phase fractions and distension are
  /// not changed
  /// @param second_fraction  mass fraction of the second of each point, from `least_fraction` to below 1
  RangeReport evaluate(const Batch& batch, std::span<const double> second_fraction) const;
};

}  // namespace whipple::eos
