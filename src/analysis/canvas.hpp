// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "src/core/base/tensor.hpp"

/// Depth-buffered drawing: particles as shaded spheres, finite elements as shaded faces.
namespace whipple::analysis {

using Corners = std::array<std::uint32_t, 8>;  ///< nodes of a hexahedron in the order of VTK

/// Describes a face of an element.
struct Face {
  std::uint32_t element = 0;  ///< index in the list of elements
  std::array<std::uint32_t, 4> corners{};
};

/// Finds the faces that belong to exactly one of the elements.
std::vector<Face> surface_faces(std::span<const Corners> elements);

/// Holds a picture: the label of the item visible in each pixel, and its brightness. Coordinates are in pixels from the
/// lower left corner, with z toward the viewer.
class Canvas {
 public:
  static constexpr std::uint32_t nothing = 0xffffffff;  ///< label of the background
  static constexpr double edge_darkness = 0.82;         ///< brightness factor along the edges of elements

  Canvas(std::size_t rows, std::size_t columns);

  /// Draws a sphere; its radius is rounded to whole pixels and limited to the range 1 to 40.
  void sphere(const Vector3& centre, double radius, std::uint32_t label);
  /// Draws quadrilateral faces, each with its label. Each half is shaded by its plane; edges are darker if the faces
  /// are large enough (median edge of seven pixels).
  void faces(std::span<const std::array<Vector3, 4>> corners, std::span<const std::uint32_t> labels);

  /// Darkens distant items: linearly with depth, from the nearest to the farthest visible point, by at most `fading`;
  /// and next to nearer neighbours, as if light came from all directions on the viewer's side (Boucheny, thesis,
  /// Grenoble 2009: eye-dome lighting). Must be called once, after all drawing.
  void shade(double fading);

  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] std::size_t columns() const { return columns_; }
  /// Returns the labels, row by row from the bottom.
  [[nodiscard]] const std::vector<std::uint32_t>& seen() const { return seen_; }
  /// Returns the brightness, between 0 and 1, row by row from the bottom.
  [[nodiscard]] const std::vector<float>& light() const { return light_; }

 private:
  void put(double column, double row, double depth, std::uint32_t label, double light);
  void triangle(const Vector3& p, const Vector3& q, const Vector3& r, std::uint32_t label, bool edged);

  std::size_t rows_, columns_;
  std::vector<std::uint32_t> seen_;
  std::vector<float> light_;
  std::vector<double> depth_;
};

}  // namespace whipple::analysis
