// SPDX-License-Identifier: BSD-3-Clause
#include "src/case/build/touch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "src/case/build/placement.hpp"

namespace whipple::cases {
namespace {

constexpr double near = 0.05;           // cells: surfaces closer than this touch
constexpr double same_velocity = 1e-9;  // relative to the speeds

Vector3 velocity_at(const Body& body, const Vector3& x) {
  const Shape::Bounds box = body.shape->bounds();
  return body.velocity_at(x, 0.5 * (box.lower + box.upper));
}

bool move_alike(const Body& a, const Body& b, const Vector3& x) {
  const Vector3 of_a = velocity_at(a, x), of_b = velocity_at(b, x);
  return (of_a - of_b).norm() <= same_velocity * (of_a.norm() + of_b.norm());
}

bool meet(const Shape::Bounds& a, const Shape::Bounds& b, double distance) {
  return (a.lower.array() <= b.upper.array() + distance).all() &&
         (b.lower.array() <= a.upper.array() + distance).all();
}

Shape::Bounds grown(const Shape::Bounds& box, double by) {
  return {box.lower.array() - by, box.upper.array() + by};
}

/// Indexes boxes by the cells of a lattice that they overlap.
class BoxTable {
 public:
  BoxTable(const std::vector<Shape::Bounds>& boxes, double edge) : boxes_(boxes), edge_(edge) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for_each_cell(boxes[i], [&](std::uint64_t key) {
        cells_[key].push_back(static_cast<std::uint32_t>(i));
        return false;
      });
    }
  }
  /// Returns whether f(box) is true for any of the boxes within a distance (m) of this one.
  template <class Function>
  [[nodiscard]] bool any_near(const Shape::Bounds& box, double distance, Function&& f) const {
    return for_each_cell(grown(box, distance), [&](std::uint64_t key) {
      const auto cell = cells_.find(key);
      return cell != cells_.end() && std::ranges::any_of(cell->second, [&](std::uint32_t i) {
               return meet(boxes_[i], box, distance) && f(boxes_[i]);
             });
    });
  }

 private:
  /// Calls f(key) for the cells of a box until it returns true. @returns whether it did
  template <class Function>
  bool for_each_cell(const Shape::Bounds& box, Function&& f) const {
    std::array<std::int64_t, 3> first{}, last{};
    for (std::size_t a = 0; a < 3; ++a) {
      const auto axis = static_cast<Eigen::Index>(a);
      first[a] = static_cast<std::int64_t>(std::floor(box.lower[axis] / edge_));
      last[a] = static_cast<std::int64_t>(std::floor(box.upper[axis] / edge_));
    }
    for (std::int64_t i = first[0]; i <= last[0]; ++i) {
      for (std::int64_t j = first[1]; j <= last[1]; ++j) {
        for (std::int64_t k = first[2]; k <= last[2]; ++k) {
          // Hash collisions of cells only cost time.
          const auto key = static_cast<std::uint64_t>(i) * 0x9e3779b97f4a7c15ULL ^
                           static_cast<std::uint64_t>(j) * 0xc2b2ae3d27d4eb4fULL ^
                           static_cast<std::uint64_t>(k) * 0x165667b19e3779f9ULL;
          if (f(key)) return true;
        }
      }
    }
    return false;
  }

  const std::vector<Shape::Bounds>& boxes_;
  double edge_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace

bool touch_and_move_alike(const Case& setup, const Body& a, const Body& b) {
  const auto varies = [](const Body& body) {
    return !body.angular_velocity.isZero(0.0) || !body.expansion_rate.isZero(0.0);
  };
  if (!varies(a) && !varies(b) && !move_alike(a, b, Vector3::Zero())) return false;
  const double cell = setup.geometry.cell_size, distance = near * cell;
  // The boxes of particles may extend beyond the shape by at most half a cell.
  const Shape::Bounds of_a = grown(a.shape->bounds(), 0.5 * cell),
                      of_b = grown(b.shape->bounds(), 0.5 * cell);
  if (!meet(of_a, of_b, distance)) return false;
  const Shape::Bounds both =
      grown({of_a.lower.cwiseMax(of_b.lower), of_a.upper.cwiseMin(of_b.upper)}, distance);
  const std::vector<Shape::Bounds> boxes = particle_boxes(setup, a, both);
  const BoxTable table(boxes, cell);
  return std::ranges::any_of(particle_boxes(setup, b, both), [&](const Shape::Bounds& box) {
    return table.any_near(box, distance, [&](const Shape::Bounds& other) {
      return move_alike(a, b, 0.25 * (box.lower + box.upper + other.lower + other.upper));
    });
  });
}

double gap_that_closes(const Case& setup, const Body& a, const Body& b) {
  const Shape::Bounds of_a = a.shape->bounds(), of_b = b.shape->bounds();
  const Vector3 velocity = b.velocity - a.velocity;
  double gap2 = 0.0, begin = 0.0, end = setup.time.end;  // s, while the boxes overlap
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double below = of_a.lower[i] - of_b.upper[i], above = of_b.lower[i] - of_a.upper[i];
    const double apart = std::max({below, above, 0.0});
    gap2 += apart * apart;
    if (velocity[i] == 0.0) {
      if (apart > 0.0) return 0.0;
      continue;
    }
    const double one = below / velocity[i], other = -above / velocity[i];
    begin = std::max(begin, std::min(one, other));
    end = std::min(end, std::max(one, other));
  }
  const double gap = std::sqrt(gap2);
  return begin < end && gap > near * setup.geometry.cell_size ? gap : 0.0;
}

}  // namespace whipple::cases
