// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/loads.hpp"

#include <algorithm>

namespace whipple::solver {

Load uniform_load(std::string name, std::function<Vector3(double time)> acceleration, double begin) {
  return {.name = std::move(name),
          .add =
              [acceleration](const LoadedPoints&, double time, std::span<Vector3> sum) {
                const Vector3 of_all = acceleration(time);
                for (Vector3& of_point : sum) of_point += of_all;
              },
          .next_event = [begin](double time) { return std::max(begin, time); },
          .of_all = std::move(acceleration)};
}

bool Loads::are_uniform() const {
  return std::ranges::all_of(loads_, [](const Load& load) { return load.of_all != nullptr; });
}

Vector3 Loads::uniform_at(double time) const {
  Vector3 sum = Vector3::Zero();
  for (const Load& load : loads_) {
    if (load.next_event(time) <= time && load.of_all) sum += load.of_all(time);
  }
  return sum;
}

void Loads::add_to(const LoadedPoints& points, double time, std::span<Vector3> acceleration) const {
  for (const Load& load : loads_) {
    if (load.next_event(time) <= time) load.add(points, time, acceleration);
  }
}

double Loads::next_event(double time) const {
  double next = std::numeric_limits<double>::infinity();
  for (const Load& load : loads_) next = std::min(next, load.next_event(time));
  return next;
}

double Loads::next_start(double time) const {
  double next = std::numeric_limits<double>::infinity();
  for (const Load& load : loads_) {
    if (load.moves == Moves::all_material) next = std::min(next, load.next_event(time));
  }
  return next;
}

}  // namespace whipple::solver
