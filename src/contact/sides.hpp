// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "src/contact/cracks.hpp"
#include "src/contact/node_fields.hpp"
#include "src/grid/block_grid.hpp"

namespace whipple::contact {

/// Combines the fields at the nodes of a contact slot into sides: each body is one side, or two at one of its cracks.
/// Fields of a body on the same side of a crack have a common motion (docs/theory/cracks.md, equation 5).
class Sides {
 public:
  /// @param cracks  cracks of the bodies whose fields are divided; null: there are none
  Sides(grid::BlockGrid& grid, std::uint32_t slot, const Cracks* cracks);

  /// Moves to a node of the slot and combines the fields of each side.
  void go_to(std::size_t node);
  [[nodiscard]] std::vector<Side>& all() { return sides_; }
  /// Returns the number of the body of a side among those of the slot.
  [[nodiscard]] std::size_t body(std::size_t side) const { return body_[side]; }
  /// Returns the field of a body of the slot.
  [[nodiscard]] unsigned field(std::size_t body) const { return fields_[body]; }
  [[nodiscard]] std::size_t bodies() const { return fields_.size(); }
  /// Returns the crack between a side and the next side of the same body.
  [[nodiscard]] const Cracks::Crack& crack(std::size_t side) const { return crack_[side]; }
  /// Assigns motion and heat of each side to its fields.
  void spread();

 private:
  void join(std::span<grid::Node* const> parts, std::size_t body);

  grid::BlockGrid& grid_;
  std::uint32_t slot_;
  const Cracks* cracks_;
  std::vector<unsigned> fields_;       // of each body, undivided
  std::vector<grid::FieldSet> parts_;  // of each body: its fields that reach the slot
  std::vector<Side> sides_;
  std::vector<std::size_t> body_;     // of each side
  std::vector<Cracks::Crack> crack_;  // after each side
  /// Holds the fields with a common motion.
  struct Joint {
    std::size_t side;
    std::vector<grid::Node*> parts;
  };
  std::vector<Joint> joints_;
  std::vector<grid::Node> joined_;  // combined node of each joint
};

}  // namespace whipple::contact
