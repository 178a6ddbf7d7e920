// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "src/analysis/frame.hpp"
#include "src/analysis/table.hpp"

/// Surfaces of dense material from particles: craters, holes, profiles (docs/theory/analysis.md).
namespace whipple::analysis {

/// Computes the volume fraction of material in rings about the axis, with the volumes of the particles distributed
/// linearly over the two nearest bins in either direction. The centre of bin (ring, layer) is at radius (ring + 1/2)
/// size and axial coordinate lower + (layer + 1/2) size.
class RingField {
 public:
  /// Computes the field from the chosen particles.
  /// @param size edge of the bins, m
  /// @param chosen selects the particles that count
  /// @param wall_at_upper the upper end is a mirror plane: contributions beyond it are reflected
  RingField(const Snapshot& snapshot, const Frame& frame, double size, double lower, double upper,
            double radius, const std::function<bool(std::size_t)>& chosen, bool wall_at_upper = false);

  [[nodiscard]] std::size_t rings() const { return rings_; }
  [[nodiscard]] std::size_t layers() const { return layers_; }
  [[nodiscard]] double size() const { return size_; }
  [[nodiscard]] double layer_coordinate(std::size_t layer) const {
    return lower_ + (static_cast<double>(layer) + 0.5) * size_;
  }
  [[nodiscard]] double fraction(std::size_t ring, std::size_t layer) const {
    return volume_[layer * rings_ + ring] / (ring_area(ring) * size_);
  }
  [[nodiscard]] double ring_area(std::size_t ring) const { return area_[ring]; }
  /// Returns the cross-section of the material in a layer, m^2.
  [[nodiscard]] double cross_section(std::size_t layer) const;
  /// Returns the thickness of the material along the axis in a ring, m.
  [[nodiscard]] double thickness(std::size_t ring) const;

 private:
  double size_, lower_;
  std::size_t rings_, layers_;
  std::vector<double> area_;    // of the rings, m^2
  std::vector<double> volume_;  // of the full problem, layer by layer
};

/// Finds the first upward crossing of 1/2 in a sequence at (k + 1/2) size, with at least two consecutive entries above
/// it; linear between the centres. NaN if there is none, 0 if the sequence begins in material.
double first_surface(const std::vector<double>& fractions, double size);

struct Crater {
  double depth = 0.0;   ///< of the floor on the axis below the original surface, m; NaN: no floor
  double radius = 0.0;  ///< in the plane of the original surface, m
  double bulge = 0.0;   ///< displacement of the rear face on the axis, m; negative: it has come off
  /// States that the floor is deeper because the body bends, not because material is missing: it is behind the original
  /// rear face, or the rear face has moved more than half as far as the floor. Depth and radius are then NaN.
  bool is_bulge = false;
};

/// Measures the crater in a body that initially extended from the axial coordinate `face` to `rear`. Material of other
/// bodies, such as the remains of the projectile, is not part of its floor.
Crater measure_crater(const Snapshot& snapshot, const Frame& frame, std::size_t body, double face,
                      double rear, double cell_size);

/// Measures the depth (m) that a body has reached below the axial coordinate `face`: 0.1 % of its mass is deeper.
/// Returns 0 before it arrives, NaN if nothing of it is left.
double penetration_depth(const Snapshot& snapshot, const Frame& frame, std::size_t body, double spacing,
                         double face);

struct Hole {
  double diameter = 0.0;      ///< m, within which less than half of the plate thickness is left
  double left_on_axis = 1.0;  ///< fraction of the plate's thickness left on the axis
};

/// Measures the hole in a plate from its remaining material, projected along the axis.
/// @param wall  1: the particle belongs to the remaining plate
Hole measure_hole(const Snapshot& snapshot, const Frame& frame, const std::vector<std::uint8_t>& wall,
                  double thickness, double cell_size);

}  // namespace whipple::analysis
