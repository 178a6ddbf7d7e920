// SPDX-License-Identifier: BSD-3-Clause
#include "src/analysis/canvas.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace whipple::analysis {
namespace {

constexpr double ambient = 0.42;  // fraction of the light that is ambient

/// Returns the direction of the light: from the upper left in front.
Vector3 light_direction() { return {-0.4, 0.55, 0.73}; }

/// Returns the brightness of a surface with a unit normal.
double lit(const Vector3& normal) {
  return ambient + (1.0 - ambient) * std::max(0.0, normal.dot(light_direction()));
}

}  // namespace

std::vector<Face> surface_faces(std::span<const Corners> elements) {
  constexpr std::array<std::array<std::size_t, 4>, 6> faces_of_hexahedron = {
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  using Key = std::array<std::uint32_t, 4>;  // ascending corners: equal for both elements of a face
  std::vector<Face> all;
  std::vector<std::pair<Key, std::uint32_t>> keys;
  for (std::uint32_t e = 0; e < elements.size(); ++e) {
    for (const auto& corners : faces_of_hexahedron) {
      const Corners& nodes = elements[e];
      all.push_back({e, {nodes[corners[0]], nodes[corners[1]], nodes[corners[2]], nodes[corners[3]]}});
      Key key = all.back().corners;
      std::ranges::sort(key);
      keys.emplace_back(key, static_cast<std::uint32_t>(keys.size()));
    }
  }
  std::ranges::sort(keys);
  std::vector<Face> alone;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const bool as_before = k > 0 && keys[k - 1].first == keys[k].first;
    const bool as_next = k + 1 < keys.size() && keys[k + 1].first == keys[k].first;
    if (!as_before && !as_next) alone.push_back(all[keys[k].second]);
  }
  return alone;
}

Canvas::Canvas(std::size_t rows, std::size_t columns)
    : rows_(rows),
      columns_(columns),
      seen_(rows * columns, nothing),
      light_(rows * columns, 0.0F),
      depth_(rows * columns, -std::numeric_limits<double>::infinity()) {}

void Canvas::put(double column, double row, double depth, std::uint32_t label, double light) {
  if (!(column >= 0.0 && row >= 0.0 && column < static_cast<double>(columns_) &&
        row < static_cast<double>(rows_)))
    return;
  const std::size_t pixel = static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column);
  if (!(depth > depth_[pixel])) return;
  depth_[pixel] = depth;
  seen_[pixel] = label;
  light_[pixel] = static_cast<float>(light);
}

void Canvas::sphere(const Vector3& centre, double radius, std::uint32_t label) {
  constexpr double largest =
      40.0;  // pixels: particles of coarse models touch, and single ones do not hide the others
  const double r = std::clamp(std::nearbyint(radius), 1.0, largest);
  const double reach = r + 0.45;  // rounds the outline; the smallest spheres leave no gaps
  const double column = std::floor(centre[0]), row = std::floor(centre[1]);
  for (double dy = -r; dy <= r; dy += 1.0) {
    for (double dx = -r; dx <= r; dx += 1.0) {
      const double inside = reach * reach - dx * dx - dy * dy;
      if (inside < 0.0) continue;
      const double height = std::sqrt(inside);
      put(column + dx, row + dy, centre[2] + height, label, lit(Vector3(dx, dy, height) / reach));
    }
  }
}

void Canvas::faces(std::span<const std::array<Vector3, 4>> corners, std::span<const std::uint32_t> labels) {
  constexpr double smallest_with_edges = 7.0;  // pixels: edges of smaller elements would hide everything else
  if (corners.empty()) return;
  std::vector<double> sizes;
  for (const auto& face : corners) {
    for (std::size_t k = 0; k < 4; ++k) sizes.push_back((face[k] - face[(k + 3) % 4]).norm());
  }
  std::ranges::nth_element(sizes, sizes.begin() + std::ssize(sizes) / 2);
  const bool edged = sizes[sizes.size() / 2] >= smallest_with_edges;
  for (std::size_t f = 0; f < corners.size(); ++f) {
    triangle(corners[f][0], corners[f][1], corners[f][2], labels[f], edged);
    triangle(corners[f][2], corners[f][3], corners[f][0], labels[f], edged);
  }
}

/// Draws a triangle whose edges p-q and q-r are edges of an element; r-p is the diagonal of its face.
void Canvas::triangle(const Vector3& p, const Vector3& q, const Vector3& r, std::uint32_t label, bool edged) {
  const Vector3 normal = (q - p).cross(r - p);
  const double twice = normal[2];         // area in the picture
  if (!(std::abs(twice) > 1e-9)) return;  // seen edge-on
  const double light = lit(std::copysign(1.0 / normal.norm(), twice) * normal);
  const auto height = [&](const Vector3& a, const Vector3& b) {  // of the triangle above an edge, pixels
    return std::abs(twice) / std::max(std::hypot(b[0] - a[0], b[1] - a[1]), 1e-300);
  };
  const double above_pq = height(p, q), above_qr = height(q, r);
  const auto bound = [&](int axis, bool upper) {
    const auto [least, most] = std::minmax({p[axis], q[axis], r[axis]});
    const double within = axis == 0 ? static_cast<double>(columns_) : static_cast<double>(rows_);
    return upper ? std::min(std::floor(most), within - 1.0) : std::max(std::floor(least), 0.0);
  };
  for (double row = bound(1, false); row <= bound(1, true); row += 1.0) {
    for (double column = bound(0, false); column <= bound(0, true); column += 1.0) {
      const double x = column + 0.5, y = row + 0.5;
      const double of_q = ((x - p[0]) * (r[1] - p[1]) - (y - p[1]) * (r[0] - p[0])) / twice;
      const double of_r = ((y - p[1]) * (q[0] - p[0]) - (x - p[0]) * (q[1] - p[1])) / twice;
      const double of_p = 1.0 - of_q - of_r;
      if (!(of_q >= -1e-9 && of_r >= -1e-9 && of_p >= -1e-9)) continue;
      const double depth = p[2] + of_q * (q[2] - p[2]) + of_r * (r[2] - p[2]);
      const bool at_edge = edged && std::min(of_r * above_pq, of_p * above_qr) < 0.7;
      put(column, row, depth, label, at_edge ? edge_darkness * light : light);
    }
  }
}

void Canvas::shade(double fading) {
  constexpr double slope = 24.0,
                   strength = 0.6;     // depth (pixels) at which a neighbour darkens fully; by all of them
  constexpr std::ptrdiff_t reach = 2;  // pixels to the neighbours
  double nearest = -std::numeric_limits<double>::infinity(), farthest = -nearest;
  for (std::size_t pixel = 0; pixel < seen_.size(); ++pixel) {
    if (seen_[pixel] == nothing) continue;
    nearest = std::max(nearest, depth_[pixel]);
    farthest = std::min(farthest, depth_[pixel]);
  }
  const auto rows = static_cast<std::ptrdiff_t>(rows_), columns = static_cast<std::ptrdiff_t>(columns_);
  for (std::ptrdiff_t row = 0; row < rows; ++row) {
    for (std::ptrdiff_t column = 0; column < columns; ++column) {
      const std::size_t pixel = static_cast<std::size_t>(row * columns + column);
      if (seen_[pixel] == nothing) continue;
      double hidden = 0.0;
      for (const auto& [dy, dx] :
           {std::pair{-reach, std::ptrdiff_t{0}}, std::pair{reach, std::ptrdiff_t{0}},
            std::pair{std::ptrdiff_t{0}, -reach}, std::pair{std::ptrdiff_t{0}, reach}}) {
        const std::ptrdiff_t y = row + dy, x = column + dx;
        if (y < 0 || x < 0 || y >= rows || x >= columns) continue;
        const double nearer = depth_[static_cast<std::size_t>(y * columns + x)] - depth_[pixel];
        hidden += 0.25 * std::clamp(nearer / slope, 0.0, 1.0);
      }
      const double distance = nearest > farthest ? (nearest - depth_[pixel]) / (nearest - farthest) : 0.0;
      light_[pixel] *= static_cast<float>((1.0 - fading * distance) * (1.0 - strength * hidden));
    }
  }
}

}  // namespace whipple::analysis
