// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "eos/equation_of_state.hpp"

namespace whipple::eos {

/// Describes the unreacted explosive ahead of a detonation wave, at rest (SI). Its energy is relative to the zero
/// of the products' equation of state and thus includes the heat of reaction.
struct Explosive {
  double density;                   ///< kg/m^3
  double specific_internal_energy;  ///< J/kg
  double pressure = 0;              ///< Pa
};

/// Holds the state behind a detonation wave of minimum velocity.
struct ChapmanJouguet {
  double detonation_velocity;  ///< D, m/s
  double particle_velocity;    ///< m/s, of the products, relative to the explosive
  State state;                 ///< of the products
};

/// Returns the state of the products at a density and specific internal energy; pressure and sound speed are used.
using Products = std::function<State(double density, double specific_internal_energy)>;

/// Computes the Chapman-Jouguet state, where the Rayleigh line is tangent to the Hugoniot of the products,
///   e - e0 = (p + p0) (V0 - V)/2,  (p - p0)/(V0 - V) = (rho c)^2, D = V0 sqrt[(p - p0)/(V0 - V)]
/// (Fickett and Davis, Detonation, 1979, section 2A; docs/theory/equations_of_state.md, section 2.5).
/// @throws StateError if the products have no energy to detonate or there is no point of tangency below their
/// compression limit
ChapmanJouguet chapman_jouguet(const Products& products, const Explosive& explosive, double maximum_density);

/// Finds the Chapman-Jouguet state of products whose reference state is the unreacted explosive (jwl).
ChapmanJouguet chapman_jouguet(const EquationOfState& products);

}  // namespace whipple::eos
