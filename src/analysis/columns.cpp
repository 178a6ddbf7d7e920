// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "src/analysis/cloud.hpp"

namespace whipple::analysis {

Columns::Columns(const Snapshot& first, const Frame& frame, std::size_t body, double size)
    : frame_(frame), body_(body), size_(size) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  lower_ = {infinity, infinity};
  upper_ = {-infinity, -infinity};
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first.body[i] != body) continue;
    for (std::size_t a = 0; a < 2; ++a) {
      const double x = first.position[i][frame.transverse[a]];
      lower_[a] = std::min(lower_[a], x);
      upper_[a] = std::max(upper_[a], x);
    }
  }
  if (!(upper_[0] > lower_[0])) return;
  for (std::size_t a = 0; a < 2; ++a) {
    // Columns begin at a mirror plane, so that none is cut by it.
    for (const Plane& plane : frame.planes) {
      if (plane.axis == frame.transverse[a] && lower_[a] - plane.position < size) lower_[a] = plane.position;
    }
    count_[a] = static_cast<std::ptrdiff_t>(std::ceil((upper_[a] - lower_[a]) / size));
  }
  initial_ = thickness(first, true);
  const double full = *std::ranges::max_element(initial_);
  const auto counts = [&](std::ptrdiff_t i, std::ptrdiff_t j) {
    return initial_[static_cast<std::size_t>(i * count_[1] + j)] > 0.75 * full;
  };
  for (std::ptrdiff_t i = 0; i < count_[0]; ++i) {
    for (std::ptrdiff_t j = 0; j < count_[1]; ++j) {
      // Next to a mirror plane there is no neighbour; elsewhere the rim has none, or thinner ones.
      const std::array<std::ptrdiff_t, 2> at = {i, j};
      bool whole = counts(i, j);
      for (std::size_t a = 0; a < 2 && whole; ++a) {
        for (const std::ptrdiff_t step : {-1, 1}) {
          std::array<std::ptrdiff_t, 2> next = at;
          next[a] += step;
          const bool at_plane = next[a] < 0 && frame.mirrored(frame.transverse[a]);
          if (at_plane) continue;
          whole = whole && next[a] >= 0 && next[a] < count_[a] && counts(next[0], next[1]);
        }
      }
      if (whole) inside_.push_back(static_cast<std::size_t>(i * count_[1] + j));
    }
  }
}

/// A particle's volume is shared among the four nearest columns, as its distance from their centres.
std::vector<double> Columns::thickness(const Snapshot& snapshot, bool all) const {
  std::vector<double> result(static_cast<std::size_t>(count_[0] * count_[1]), 0.0);
  const std::vector<double> volumes = snapshot.volumes();
  const double speed = moving * frame_.impact_speed;
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (snapshot.body[i] != body_) continue;
    if (!all && std::abs(frame_.axial(snapshot.velocity[i])) > speed) continue;
    std::array<std::ptrdiff_t, 2> first{};
    std::array<double, 2> share{};
    for (std::size_t a = 0; a < 2; ++a) {
      const double x = (snapshot.position[i][frame_.transverse[a]] - lower_[a]) / size_ - 0.5;
      first[a] = static_cast<std::ptrdiff_t>(std::floor(x));
      share[a] = x - std::floor(x);
    }
    for (std::ptrdiff_t di = 0; di < 2; ++di) {
      for (std::ptrdiff_t dj = 0; dj < 2; ++dj) {
        std::ptrdiff_t c = first[0] + di, d = first[1] + dj;
        // Beyond a mirror plane lies the image of the first column.
        if (c == -1 && frame_.mirrored(frame_.transverse[0])) c = 0;
        if (d == -1 && frame_.mirrored(frame_.transverse[1])) d = 0;
        if (c < 0 || c >= count_[0] || d < 0 || d >= count_[1]) continue;
        const double part = (di == 1 ? share[0] : 1.0 - share[0]) * (dj == 1 ? share[1] : 1.0 - share[1]);
        result[static_cast<std::size_t>(c * count_[1] + d)] += part * volumes[i] / (size_ * size_);
      }
    }
  }
  return result;
}

double Columns::least_left(const Snapshot& snapshot) const {
  if (inside_.empty()) return 1.0;
  const std::vector<double> now = thickness(snapshot, false);
  double least = 1.0;
  for (const std::size_t c : inside_) least = std::min(least, now[c] / initial_[c]);
  return least;
}

}  // namespace whipple::analysis
