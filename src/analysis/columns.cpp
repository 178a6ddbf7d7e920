// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whipple::analysis {

Columns::Columns(const Snapshot& first, const Frame& frame, std::size_t body, double size)
    : frame_(frame), transverse_(frame.transverse), size_(size) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 2> upper = {-infinity, -infinity};
  lower_ = {infinity, infinity};
  const auto mine = [&](std::size_t i) { return first.body[i] == body; };
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (!mine(i)) continue;
    for (std::size_t a = 0; a < 2; ++a) {
      const double x = first.position[i][transverse_[a]];
      lower_[a] = std::min(lower_[a], x);
      upper[a] = std::max(upper[a], x);
    }
  }
  const std::size_t directions = frame.is_planar() ? 1 : 2;
  if (frame.is_planar()) {  // one column across the plane
    lower_[1] = -0.5 * size;
    count_[1] = 1;
    mirrored_[1] = {true, true};
  }
  for (std::size_t a = 0; a < directions; ++a) {
    if (!(upper[a] > lower_[a])) return;
  }
  double width = infinity;
  for (std::size_t a = 0; a < directions; ++a) {
    if (frame.dimension == grid::Dimension::axisymmetric && lower_[a] < size) {
      mirrored_[a][0] = true;
      lower_[a] = 0.0;
    }
    // Columns begin at a mirror plane, so that no column is cut by it.
    for (const Plane& plane : frame.planes) {
      if (plane.axis != transverse_[a]) continue;
      mirrored_[a] = {lower_[a] - plane.position < size && lower_[a] >= plane.position,
                      plane.position - upper[a] < size && upper[a] <= plane.position};
      if (mirrored_[a][0]) lower_[a] = plane.position;
      if (mirrored_[a][1]) upper[a] = plane.position;
    }
    count_[a] = static_cast<std::ptrdiff_t>(std::ceil((upper[a] - lower_[a]) / size));
    if (mirrored_[a][1]) lower_[a] = upper[a] - static_cast<double>(count_[a]) * size;
    width = std::min(width, (mirrored_[a][0] || mirrored_[a][1] ? 2.0 : 1.0) * (upper[a] - lower_[a]));
  }
  initial_ = thickness(first, Vector3::Zero(), mine);
  const double full = *std::ranges::max_element(initial_);
  const auto margin = static_cast<std::ptrdiff_t>(std::max(std::ceil(0.05 * width / size), 1.0));
  const auto whole = [&](std::ptrdiff_t i, std::ptrdiff_t j) {
    const std::array<std::ptrdiff_t, 2> at = {i, j};
    for (std::size_t a = 0; a < 2; ++a) {
      // Beyond a mirror plane the body continues.
      if (at[a] < 0) return mirrored_[a][0];
      if (at[a] >= count_[a]) return mirrored_[a][1];
    }
    return initial_[index(i, j)] > 0.75 * full;
  };
  counts_.assign(initial_.size(), 0);
  for (std::ptrdiff_t i = 0; i < count_[0]; ++i) {
    for (std::ptrdiff_t j = 0; j < count_[1]; ++j) {
      bool counts = true;
      for (std::ptrdiff_t di = -margin; counts && di <= margin; ++di) {
        for (std::ptrdiff_t dj = -margin; counts && dj <= margin; ++dj) counts = whole(i + di, j + dj);
      }
      counts_[index(i, j)] = counts ? 1 : 0;
    }
  }
}

/// Distributes the volume of a particle over the four nearest columns, by its distance from their centres.
template <class Chosen>
std::vector<double> Columns::thickness(const Snapshot& snapshot, const Vector3& shift,
                                       Chosen&& chosen) const {
  std::vector<double> result(static_cast<std::size_t>(count_[0] * count_[1]), 0.0);
  const std::vector<double> volumes = snapshot.volumes();
  for (std::size_t i = 0; i < snapshot.size(); ++i) {
    if (!chosen(i)) continue;
    std::array<std::ptrdiff_t, 2> first{};
    std::array<double, 2> upper{};
    const double across = frame_.is_planar() ? frame_.depth(snapshot.position[i]) : size_;
    for (std::size_t a = 0; a < 2; ++a) {
      const int axis = transverse_[a];
      const double x = (snapshot.position[i][axis] - shift[axis] - lower_[a]) / size_ - 0.5;
      first[a] = static_cast<std::ptrdiff_t>(std::floor(x));
      upper[a] = x - std::floor(x);
    }
    // The neighbour beyond a mirror plane is the image of the outermost column.
    const auto folded = [&](std::size_t a, std::ptrdiff_t c) {
      if (c == -1 && mirrored_[a][0]) return std::ptrdiff_t{0};
      if (c == count_[a] && mirrored_[a][1]) return count_[a] - 1;
      return c;
    };
    for (std::ptrdiff_t di = 0; di < 2; ++di) {
      for (std::ptrdiff_t dj = 0; dj < 2; ++dj) {
        const std::ptrdiff_t c = folded(0, first[0] + di), d = folded(1, first[1] + dj);
        if (c < 0 || c >= count_[0] || d < 0 || d >= count_[1]) continue;
        const double part = (di == 1 ? upper[0] : 1.0 - upper[0]) * (dj == 1 ? upper[1] : 1.0 - upper[1]);
        result[index(c, d)] += part * volumes[i] / (across * size_);
      }
    }
  }
  return result;
}

double Columns::least_left(const Snapshot& snapshot, const std::vector<std::uint8_t>& chosen,
                           const Vector3& shift) const {
  const std::vector<double> now = thickness(snapshot, shift, [&](std::size_t i) { return chosen[i] != 0; });
  double least = 1.0;
  for (std::size_t c = 0; c < counts_.size(); ++c) {
    if (counts_[c] != 0) least = std::min(least, now[c] / initial_[c]);
  }
  return least;
}

double Columns::area_below(double fraction, const Snapshot& snapshot, const std::vector<std::uint8_t>& chosen,
                           const Vector3& shift) const {
  const std::vector<double> now = thickness(snapshot, shift, [&](std::size_t i) { return chosen[i] != 0; });
  double area = 0.0;
  for (std::ptrdiff_t i = 0; i < count_[0]; ++i) {
    const double inner = lower_[0] + static_cast<double>(i) * size_;
    const double own = frame_.dimension == grid::Dimension::axisymmetric
                           ? frame_.ring_area(inner, inner + size_)
                       : frame_.is_planar() ? frame_.copies() * size_
                                            : frame_.copies() * size_ * size_;
    for (std::ptrdiff_t j = 0; j < count_[1]; ++j) {
      const std::size_t c = index(i, j);
      if (counts_[c] != 0 && now[c] < fraction * initial_[c]) area += own;
    }
  }
  return area;
}

bool Columns::inside(const Vector3& place) const {
  std::array<std::ptrdiff_t, 2> at{};
  for (std::size_t a = 0; a < 2; ++a) {
    at[a] = static_cast<std::ptrdiff_t>(std::floor((place[transverse_[a]] - lower_[a]) / size_));
    if (at[a] < 0 || at[a] >= count_[a]) return false;
  }
  return counts_[index(at[0], at[1])] != 0;
}

bool Columns::any() const {
  return std::ranges::any_of(counts_, [](std::uint8_t counts) { return counts != 0; });
}

}  // namespace whipple::analysis
