// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/arrivals.hpp"

#include "src/analysis/cloud.hpp"
#include "src/analysis/measures.hpp"

namespace whipple::analysis {

void Arrivals::add(const Snapshot& snapshot) {
  const double interval = snapshot.time - before_.time;
  for (std::size_t i = 0, k = 0; i < before_.size(); ++i) {
    const std::uint64_t id = before_.id[i];
    while (k < snapshot.size() && snapshot.id[k] < id) ++k;
    const double to_plane = position_ - frame_.axial(before_.position[i]);
    if (!(to_plane > 0.0) || before_.body[i] == wall_ || beyond_.contains(id)) continue;
    Vector3 travel = interval * before_.velocity[i];  // if it has left the domain: free flight
    if (k < snapshot.size() && snapshot.id[k] == id) travel = snapshot.position[k] - before_.position[i];
    if (!(frame_.axial(travel) >= to_plane)) continue;
    const double part = to_plane / frame_.axial(travel);
    beyond_.insert(id);
    hits_.push_back(hit_of(frame_, before_.position[i] + part * travel, before_.time + part * interval,
                           before_.mass[i], before_.velocity[i]));
  }
  // Particles beyond the plane have passed it or started there; they do not count when they return.
  for (std::size_t k = 0; k < snapshot.size(); ++k) {
    if (frame_.axial(snapshot.position[k]) >= position_) beyond_.insert(snapshot.id[k]);
  }
  before_ = snapshot;
  before_.scalars.clear();
}

Loads Arrivals::loads(double ring) const {
  constexpr int times = 50;
  Loads result =
      tabulate(hits_, frame_, "loads", "the plane, of what has passed it until the end", ring, times);
  double under_way = 0.0;
  for (const std::uint32_t i : debris(before_, frame_)) {
    const bool before = frame_.axial(before_.position[i]) < position_ && before_.body[i] != wall_;
    if (before && !beyond_.contains(before_.id[i])) under_way += frame_.copies() * before_.mass[i];
  }
  result.totals.push_back(measured("loads_under_way", under_way));
  return result;
}

}  // namespace whipple::analysis
