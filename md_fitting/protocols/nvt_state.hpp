// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "md_fitting/lammps/potential.hpp"
#include "md_fitting/plan/plan.hpp"
#include "md_fitting/protocols/state_source.hpp"

namespace whipple::md {

/// Computes states at constant volume and temperature by molecular dynamics (Langevin bath), starting from a
/// perfect crystal. The kinetic part is exact, and the thermal part of energy and pressure of a crystal is scaled
/// by N/(N - 1): the centre of mass is at rest, so that 3N - 3 of its 3N vibrations contribute
/// (docs/theory/molecular_dynamics.md, equations 3 to 5).
class NvtStateSource final : public StateSource {
 public:
  /// @param seed of the velocities of the first state; the seeds of further states are derived from it
  NvtStateSource(const Potential& potential, const RunSize& size, std::int64_t seed);

  State state(double specific_volume, double temperature, Effort effort) override;

  /// Returns the LAMMPS commands of all states so far.
  [[nodiscard]] const std::string& transcript() const { return transcript_; }

 private:
  const Potential& potential_;
  RunSize size_;
  std::int64_t seed_;
  std::int64_t states_ = 0;
  std::string transcript_;
};

/// Root-mean-square displacement, in nearest-neighbour distances, above which a crystal has melted: far above the
/// Lindemann limit of about 0.15, far below the displacement in a melt within a picosecond.
inline constexpr double melting_displacement = 0.62;

}  // namespace whipple::md
