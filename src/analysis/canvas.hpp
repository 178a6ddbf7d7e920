// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "src/core/base/tensor.hpp"

/// Depth-buffered drawing: particles as lit spheres, finite elements as their lit faces.
namespace whipple::analysis {

using Corners = std::array<std::uint32_t, 8>;  ///< nodes of a hexahedron in the order of VTK

/// A face of an element.
struct Face {
  std::uint32_t element = 0;  ///< its number in the list
  std::array<std::uint32_t, 4> corners{};
};

/// Finds the faces that belong to one of the elements only.
std::vector<Face> surface_faces(std::span<const Corners> elements);

/// A picture: the label of what is seen in each pixel, and how much light it sends. Coordinates in pixels from the lower
/// left corner, z toward the viewer.
class Canvas {
 public:
  static constexpr std::uint32_t nothing = 0xffffffff;  ///< label of the background
  static constexpr double edge_darkness = 0.82;         ///< of the light, along edges of elements

  Canvas(std::size_t rows, std::size_t columns);

  /// Draws a sphere of whole pixels of radius, at least one and at most twelve.
  void sphere(const Vector3& centre, double radius, std::uint32_t label);
  /// Draws faces of four corners, labelled one by one. Each half is lit by its plane; edges are darker if the faces are
  /// large enough (median edge of seven pixels).
  void faces(std::span<const std::array<Vector3, 4>> corners, std::span<const std::uint32_t> labels);

  /// Darkens what is behind other things: evenly with the depth, from the nearest to the farthest of what is seen, by
  /// `fading` at most; and beside nearer neighbours, as if light came from all directions of the eye's side (Boucheny,
  /// thesis, Grenoble 2009: eye-dome lighting). To be called once, when all is drawn.
  void shade(double fading);

  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] std::size_t columns() const { return columns_; }
  /// Returns the labels, row by row from below.
  [[nodiscard]] const std::vector<std::uint32_t>& seen() const { return seen_; }
  /// Returns the light, between 0 and 1, row by row from below.
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
