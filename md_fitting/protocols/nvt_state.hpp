// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/plan.hpp"
#include "md_fitting/protocols/state_source.hpp"

namespace whipple::md {

/// States at constant volume and temperature by molecular dynamics (Langevin bath), from a perfect
/// crystal. The kinetic part is exact, and the thermal part of energy and pressure of a crystal is scaled by
/// N/(N - 1): the centre of mass is at rest, so that 3N - 3 of its 3N vibrations take part
/// (docs/theory/molecular_dynamics.md, equations 3 to 5).
class NvtStateSource final : public StateSource {
 public:
  /// @param seed of the velocities of the first state; each further state has its own, made from it
  NvtStateSource(const Potential& potential, const RunSize& size, std::int64_t seed);

  State state(double specific_volume, double temperature, Effort effort) override;

  /// The LAMMPS commands of all states so far.
  [[nodiscard]] const std::string& transcript() const { return transcript_; }

 private:
  const Potential& potential_;
  RunSize size_;
  std::int64_t seed_;
  std::int64_t states_ = 0;
  std::string transcript_;
};

/// A crystal whose atoms have moved on average (root mean square) further than 0.62 nearest-neighbour
/// distances has melted: far above the Lindemann limit of about 0.15, far below what a melt does in a
/// picosecond.
inline constexpr double melting_displacement = 0.62;

}  // namespace whipple::md
