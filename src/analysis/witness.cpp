// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/witness.hpp"

#include "src/analysis/cloud.hpp"

namespace whipple::analysis {

Loads witness_plate(const Snapshot& snapshot, const Frame& frame, const WitnessOptions& options) {
  std::vector<Hit> hits;
  for (const std::uint32_t i : debris(snapshot, frame)) {
    const Vector3& velocity = snapshot.velocity[i];
    const double flight = (options.position - frame.axial(snapshot.position[i])) / frame.axial(velocity);
    hits.push_back(hit_of(frame, snapshot.position[i] + flight * velocity, snapshot.time + flight,
                          snapshot.mass[i], velocity));
  }
  return tabulate(hits, frame, "witness", "the witness plate", options.ring, options.times);
}

}  // namespace whipple::analysis
