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

/// The sides that meet at the nodes of a contact slot: each body is one, or two at a crack of its own. Fields of a body on the
/// same side of a crack move as one (docs/theory/cracks.md, 5).
class Sides {
 public:
  /// @param cracks  of bodies whose fields divide; null: of none
  Sides(grid::BlockGrid& grid, std::uint32_t slot, const Cracks* cracks);

  /// Goes to a node of the slot and puts the fields of every side together.
  void go_to(std::size_t node);
  [[nodiscard]] std::vector<Side>& all() { return sides_; }
  /// Returns the number of the body of a side among those of the slot.
  [[nodiscard]] std::size_t body(std::size_t side) const { return body_[side]; }
  /// Returns the field of a body of the slot.
  [[nodiscard]] unsigned field(std::size_t body) const { return fields_[body]; }
  [[nodiscard]] std::size_t bodies() const { return fields_.size(); }
  /// Returns the crack between a side and the next, of the same body.
  [[nodiscard]] const Cracks::Crack& crack(std::size_t side) const { return crack_[side]; }
  /// Gives the fields of every side its motion and its heat.
  void spread();

 private:
  void join(std::span<grid::Node* const> parts, std::size_t body);

  grid::BlockGrid& grid_;
  std::uint32_t slot_;
  const Cracks* cracks_;
  std::vector<unsigned> fields_;      // of each body, whole
  std::vector<std::uint64_t> parts_;  // of each body: bit per field of it that reaches the slot
  std::vector<Side> sides_;
  std::vector<std::size_t> body_;     // of each side
  std::vector<Cracks::Crack> crack_;  // behind each side
  /// Fields that move as one.
  struct Joint {
    std::size_t side;
    std::vector<grid::Node*> parts;
  };
  std::vector<Joint> joints_;
  std::vector<grid::Node> joined_;  // in the place of the parts of each
};

}  // namespace whipple::contact
