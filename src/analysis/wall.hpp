// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "src/analysis/columns.hpp"
#include "src/analysis/table.hpp"

namespace whipple::analysis {

/// Follows a body that may be perforated and decides whether connected material closes every path through it
/// (docs/theory/analysis.md, section 6). The criterion is that particles have not failed and touch; their speed is
/// irrelevant.
class Wall {
 public:
  /// Sets up the wall along the axis of the flight; for plates that an oblique flight hits on another face, along their
  /// thin direction.
  Wall(const Run& run, const Snapshot& first, const Frame& flight, std::size_t body);

  /// Returns the frame along the axis of the wall, about the point where the line of flight meets its face.
  [[nodiscard]] const Frame& frame() const { return frame_; }
  /// Returns the extent of the body along that axis at the start.
  [[nodiscard]] const Extent& extent() const { return extent_; }

  /// Describes the remaining wall: the material that closes it, or, if perforated, the pieces attached to its rim.
  struct Remains {
    std::string undecided;  ///< why nothing can be decided; empty: it can
    bool closed = false;
    std::vector<std::uint8_t> wall;  ///< 1: the particle belongs to it
    std::vector<std::uint8_t>
        front;  ///< 1: it belongs to the foremost of the pieces that each close the body
    Vector3 shift = Vector3::Zero();  ///< displacement of the wall across the axis, m
  };
  /// Finds the remaining wall. Snapshots must be passed in order of time.
  [[nodiscard]] Remains look(const Snapshot& snapshot);

  /// Measures perforation, remaining thickness and hole; values that cannot be decided are NaN with the reason.
  [[nodiscard]] Quantities measure(const Snapshot& snapshot, const Remains& left) const;
  /// Does both.
  [[nodiscard]] Quantities measure(const Snapshot& snapshot) { return measure(snapshot, look(snapshot)); }

  /// Returns the number of cells over the face.
  [[nodiscard]] std::size_t face_cells() const { return cells_[0] * cells_[1]; }
  /// Returns the cell over the face that a position (m) lies in, of a wall displaced by `shift`; nothing beyond them.
  [[nodiscard]] std::optional<std::size_t> cell_at(const Vector3& position, const Vector3& shift) const;
  /// Returns the area (m^2, of the full problem) of such a cell.
  [[nodiscard]] double cell_area(std::size_t cell) const;
  /// Returns the distance (m) within which particles of the body touch; edge of these cells.
  [[nodiscard]] double reach() const { return reach_; }
  /// Returns whether a particle began on the rim.
  [[nodiscard]] bool began_on_rim(std::uint64_t id) const;
  /// Returns where a particle began, nullptr if it did not exist.
  [[nodiscard]] const Vector3* place_of(std::uint64_t id) const;
  [[nodiscard]] std::size_t body() const { return body_; }

 private:
  using Piece = std::vector<std::uint32_t>;

  [[nodiscard]] std::vector<Piece> pieces(const Snapshot& snapshot) const;
  /// Returns the mean displacement of a piece across the axis, m.
  [[nodiscard]] Vector3 shift_of(const Snapshot& snapshot, const Piece& piece) const;
  [[nodiscard]] bool closes(const Snapshot& snapshot, const Piece& piece, const Vector3& shift) const;
  [[nodiscard]] Remains remains(const Snapshot& snapshot) const;
  [[nodiscard]] std::string undecided(const Snapshot& snapshot) const;
  /// Returns the mass of the material of the body that has come off behind the remaining wall, kg of the full problem.
  [[nodiscard]] double spall_mass(const Snapshot& snapshot, const Remains& remains) const;
  [[nodiscard]] bool at_border(const Snapshot& snapshot, const Remains& remains) const;

  const Run& run_;
  Frame frame_;
  std::size_t body_;
  Extent extent_;
  double reach_;  // m, distance within which particles touch; edge of the cells of the path search
  Columns columns_;
  std::array<std::size_t, 2> cells_{};  // over the face, across the axis
  std::vector<std::uint8_t> face_;      // 1: paths may pass through the cells of this column
  std::size_t face_cells_ = 0;
  std::vector<std::uint64_t> id_;  // of the particles of the body at the start
  std::vector<Vector3> place_;     // of these, m
  double rim_ = 0.0;               // number of particles on the rim
  bool perforated_ = false;        // at an earlier time
  std::string never_;              // reason why nothing can be decided at any time
};

}  // namespace whipple::analysis
