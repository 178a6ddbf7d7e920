// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "eos/loci.hpp"
#include "src/material/material.hpp"
#include "tests/verification/exact/result.hpp"

/// Planar impact of two slabs with free surfaces behind, and full release.
namespace whipple::verification::exact {

/// The material without its strength: what is left has an exact solution. It parts at the tension of soft
/// aluminium and makes no heat by that (voids that grow do): else released material would swing in tension.
/// @returns its file
std::string hydrodynamic(const std::string& material);

struct PlanarImpact {
  std::string name;
  std::string flyer, target;           ///< material files; the part [strength] is left out
  double speed;                        ///< m/s
  double flyer_length, target_length;  ///< m
  double end;                          ///< s, when both are released
  /// m/s, of the frame of the run against that of the target: what differs is not Galilean invariant.
  double frame = 0.0;
  std::string lattice = "regular";  ///< of the particles
  /// For messages of tests.
  friend void PrintTo(const PlanarImpact& impact, std::ostream* out) { *out << impact.name; }
};

/// The problems of the suite.
std::vector<PlanarImpact> planar_impacts();
/// Impacts of two slabs of one metal whose release melts a part of it.
std::vector<PlanarImpact> melting_impacts();
/// One of the former by name.
PlanarImpact planar_impact(const std::string& name);

/// Exact history of one body of an impact: shock from the impedance match, release along the isentrope of
/// the same equation of state.
class ShockedAndReleased {
 public:
  ShockedAndReleased(const Material& material, const eos::ShockState& shocked);

  [[nodiscard]] const eos::ShockState& shocked() const { return shocked_; }
  /// Where the release first has zero pressure, on the model's own surface (not the equilibrium of liquid and
  /// vapour, which boiling material does not reach in such times); without phase if it has none.
  [[nodiscard]] const eos::State& released() const { return released_; }
  /// Specific internal energy on the release isentrope (J/kg, above that of the material at the start), at the
  /// density, at least that at zero pressure.
  [[nodiscard]] double energy(double density) const;
  [[nodiscard]] double initial_energy() const { return initial_energy_; }
  /// Entropy of a state over that of the shock: 0 at the start, 1 behind the shock and after release.
  [[nodiscard]] double entropy_share(double density, double specific_internal_energy) const;

 private:
  const eos::EquationOfState* eos_;
  eos::ShockState shocked_;
  eos::State released_;
  double initial_energy_, initial_entropy_;
  std::vector<eos::State> release_;  // falling density
};

/// Runs an impact in a column of two cells by two between mirror planes, free ends, with the default scheme.
/// Figures of either body; profiles of its layers of one cell from the contact and of half a cell from the
/// free surface.
Result run(const PlanarImpact& impact, double cell);

}  // namespace whipple::verification::exact
