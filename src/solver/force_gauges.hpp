// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/case/case.hpp"
#include "src/core/base/tensor.hpp"
#include "src/grid/block_grid.hpp"

namespace whipple::solver {

/// Holds an impulse and its moment about the point of a gauge.
struct GaugedImpulse {
  Vector3 impulse = Vector3::Zero();  ///< N s
  Vector3 moment = Vector3::Zero();   ///< N m s
  GaugedImpulse& operator+=(const GaugedImpulse& other) {
    impulse += other.impulse;
    moment += other.moment;
    return *this;
  }
};

/// Accumulates what acts on the bodies and faces of the force gauges of a case (docs/theory/mpm.md, equations 3.6a to
/// 3.6c).
class ForceGauges {
 public:
  explicit ForceGauges(const cases::Case& setup);

  [[nodiscard]] bool any() const { return !gauges_.empty(); }
  /// Returns whether any of them is on a body, on which other bodies act too.
  [[nodiscard]] bool any_of_body() const;

  /// Books the impulse (N s) of planes, walls and contact on the particles at a node of the grid.
  void book_node(const grid::BlockGrid& grid, std::uint32_t node, const Vector3& impulse);
  /// Books the impulse (N s) of a face of the domain on a point of a body, which is at the face.
  void book_point(std::size_t body, std::size_t face, const Vector3& position, const Vector3& impulse);

  /// Books the impulse (N s) of other material on a driven body whose nodes a load step holds.
  void book_held(std::size_t body, const Vector3& position, const Vector3& impulse);

  /// Returns the impulses of the current step on this rank, one of each gauge.
  [[nodiscard]] std::span<GaugedImpulse> booked() { return booked_; }

 private:
  struct Gauge {
    int face = -1;  // -1: on a body
    std::size_t body = 0;
    unsigned field = 0;                      // of the body
    unsigned first_piece = 0, pieces = 0;    // fields of its pieces
    std::array<double, 3> lower{}, upper{};  // of the patch, m; infinite to the ends of the face
    Vector3 about;
  };

  void add(std::size_t gauge, const Vector3& position, const Vector3& impulse);
  [[nodiscard]] double share(const Gauge& gauge, const Vector3& position, double cell_size) const;

  grid::Geometry geometry_;
  std::vector<Gauge> gauges_;
  std::vector<GaugedImpulse> booked_;
};

}  // namespace whipple::solver
