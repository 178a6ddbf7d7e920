// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "src/analysis/columns.hpp"
#include "src/analysis/table.hpp"

namespace whipple::analysis {

/// Follows a body that may be perforated: decides whether connected material closes every path through it
/// (docs/theory/analysis.md, section 6). What matters is that particles have not failed and touch, not their speed.
class Wall {
 public:
  /// Takes the axis of the flight; but for plates that an oblique flight hits on a face that is not across it, the
  /// direction in which they are thin.
  Wall(const Run& run, const Snapshot& first, const Frame& flight, std::size_t body);

  /// Returns the frame along the axis of the wall, about the point where the line of flight meets its face.
  [[nodiscard]] const Frame& frame() const { return frame_; }
  /// Returns the extent of the body along that axis at the start.
  [[nodiscard]] const Extent& extent() const { return extent_; }

  /// Measures perforation, thickness left and hole; NaN with the reason where they cannot be decided. Snapshots come in
  /// the order of time.
  [[nodiscard]] Quantities measure(const Snapshot& snapshot);

 private:
  /// Selects what is left of the body: the material that closes it, or what hangs on its rim if nothing does.
  struct Remains {
    bool closed = false;
    std::vector<std::uint8_t> wall;   ///< 1: the particle belongs to it
    Vector3 shift = Vector3::Zero();  ///< displacement of the wall across the axis, m
  };
  using Piece = std::vector<std::uint32_t>;

  [[nodiscard]] std::vector<Piece> pieces(const Snapshot& snapshot) const;
  /// Returns the place of a particle at the start, nullptr if it was not there.
  [[nodiscard]] const Vector3* place_of(std::uint64_t id) const;
  /// Returns the mean displacement of a piece across the axis, m.
  [[nodiscard]] Vector3 shift_of(const Snapshot& snapshot, const Piece& piece) const;
  [[nodiscard]] bool closes(const Snapshot& snapshot, const Piece& piece, const Vector3& shift) const;
  [[nodiscard]] Remains remains(const Snapshot& snapshot) const;
  [[nodiscard]] std::string undecided(const Snapshot& snapshot) const;
  /// Returns the mass of the body's material that has come off behind what is left of it, kg of the full problem.
  [[nodiscard]] double spall_mass(const Snapshot& snapshot, const Remains& remains) const;
  [[nodiscard]] bool at_border(const Snapshot& snapshot, const Remains& remains) const;

  const Run& run_;
  Frame frame_;
  std::size_t body_;
  Extent extent_;
  double reach_;  // m, within which particles touch; edge of the cells in which paths are sought
  Columns columns_;
  std::array<std::size_t, 2> cells_{};  // over the face, across the axis
  std::vector<std::uint8_t> face_;      // 1: paths may lead through the cells of this column
  std::size_t face_cells_ = 0;
  std::vector<std::uint64_t> id_;  // of the particles of the body at the start
  std::vector<Vector3> place_;     // of these, m
  double rim_ = 0.0;               // number of those on the rim
  bool perforated_ = false;        // at an earlier time
  std::string never_;              // reason why nothing can be decided at any time
};

}  // namespace whipple::analysis
