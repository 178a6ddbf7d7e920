// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "src/analysis/frame.hpp"

namespace whipple::analysis {

/// Measures the thickness of the material of a body along the axis, in columns over its face: the minimum thickness
/// left in a plate, regardless of the point of impact.
///
/// Excludes columns near the rim and columns where the body was thinner at the start. The margin is a twentieth of the
/// smaller width of the face, at least one column.
class Columns {
 public:
  /// Sets up the columns from the first snapshot.
  /// @param size  edge of the columns, m
  Columns(const Snapshot& first, const Frame& frame, std::size_t body, double size);

  /// Returns the minimum fraction of its initial thickness that the chosen material has in any column that counts; 1 if
  /// no column counts.
  /// @param chosen  1: the particle counts
  /// @param shift   displacement of the body since the start, m
  [[nodiscard]] double least_left(const Snapshot& snapshot, const std::vector<std::uint8_t>& chosen,
                                  const Vector3& shift) const;

  /// Returns the area (m^2, of the full problem; in plane strain per 1 m) of the counting columns in which less than a
  /// fraction of the initial thickness is left.
  [[nodiscard]] double area_below(double fraction, const Snapshot& snapshot,
                                  const std::vector<std::uint8_t>& chosen, const Vector3& shift) const;

  /// Returns whether a point of the first snapshot (m) is in a column that counts.
  [[nodiscard]] bool inside(const Vector3& place) const;
  /// Returns whether any column counts.
  [[nodiscard]] bool any() const;
  /// Returns whether the model ends at a mirror plane at the lower (0) or upper (1) end of a transverse direction.
  [[nodiscard]] bool mirrored(std::size_t direction, std::size_t end) const {
    return mirrored_[direction][end];
  }
  /// Returns the lower corner of the face (m), and its widths.
  [[nodiscard]] const std::array<double, 2>& lower() const { return lower_; }
  [[nodiscard]] std::array<double, 2> widths() const {
    return {size_ * static_cast<double>(count_[0]), size_ * static_cast<double>(count_[1])};
  }

 private:
  template <class Chosen>
  [[nodiscard]] std::vector<double> thickness(const Snapshot& snapshot, const Vector3& shift,
                                              Chosen&& chosen) const;
  [[nodiscard]] std::size_t index(std::ptrdiff_t i, std::ptrdiff_t j) const {
    return static_cast<std::size_t>(i * count_[1] + j);
  }

  Frame frame_;
  std::array<int, 2> transverse_;
  double size_;
  std::array<double, 2> lower_{};          // of the face
  std::array<std::ptrdiff_t, 2> count_{};  // of columns
  std::array<std::array<bool, 2>, 2> mirrored_{};
  std::vector<double> initial_;       // m
  std::vector<std::uint8_t> counts_;  // 1: farther from the rim than the margin
};

}  // namespace whipple::analysis
