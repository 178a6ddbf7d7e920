// SPDX-License-Identifier: BSD-3-Clause
#include "src/transfer/momentum.hpp"

namespace whipple::transfer {

std::array<double, grid::nodes_per_block> relaxation_of(const grid::Node* nodes, const Relaxation& relaxation,
                                                        double rate) {
  std::array<double, grid::nodes_per_block> beta;
  if (relaxation.fixed >= 0.0) {
    beta.fill(relaxation.fixed);
    return beta;
  }
  for (std::size_t i = 0; i < beta.size(); i += 4) {
    const grid::Node* n = nodes + i;
    const Lanes mass = {n[0].sums.mass(), n[1].sums.mass(), n[2].sums.mass(), n[3].sums.mass()};
    const Lanes carried = {n[0].sums.sound(), n[1].sums.sound(), n[2].sums.sound(), n[3].sums.sound()};
    const LanesMask massive = mass >= no_mass;
    Lanes of_four{};
    if (any(massive)) {
      const Lanes sound_speed = maximum(carried, Lanes{}) / select(massive, mass, broadcast(1.0));
      of_four = select(massive, -exp_minus_1(-rate * sound_speed), Lanes{});
    }
    store(&beta[i], of_four);
  }
  return beta;
}

}  // namespace whipple::transfer
