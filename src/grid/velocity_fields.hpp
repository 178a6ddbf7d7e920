// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "src/grid/field_set.hpp"
#include "src/grid/point_bins.hpp"

namespace whipple::grid {

/// Assigns particles and off-grid points to velocity fields. A slot that points of more than one field reach is a
/// contact slot and has separate nodes for each of them; elsewhere all fields share one set (local multi-mesh:
/// docs/theory/contact.md, section 2). Blocks of nodes are numbered by slot, followed by the additional blocks of the
/// contact slots. The field of a body may be divided at cracks (docs/theory/cracks.md); it is then the whole of its
/// parts.
class VelocityFields : public PointBins {
 public:
  /// Holds points of the grid with the velocity field (below `maximum_fields`) of each.
  struct FieldPoints {
    std::span<const Vector3> position;
    std::span<const std::uint8_t> field;
  };
  /// Declares fields as parts of others.
  /// @param of_field  whole of each field: the field itself unless it is a part of another
  void set_wholes(const std::array<std::uint8_t, maximum_fields>& of_field) {
    is_divided_ = of_field != whole_;
    whole_ = of_field;
  }
  /// Returns the whole of a field; the field itself if it is not a part of another.
  [[nodiscard]] unsigned whole(unsigned field) const { return whole_[field]; }
  /// Returns the whole fields that reach a slot with any of their parts.
  [[nodiscard]] FieldSet wholes(std::size_t slot) const {
    if (!is_divided_) return fields_[slot];
    FieldSet all;
    fields_[slot].for_each([&](unsigned field) { all.insert(whole_[field]); });
    return all;
  }

  /// Calls f(points of one field, field) for the points of a slot, in the order of their list: once for all points if
  /// they reach no contact slot, and never if there are none.
  /// f, which is a whole kernel, is called and inlined in one place.
  template <class Function>
  WHIPPLE_INLINE void for_each_field(Points points, std::size_t slot, Function&& f) const {
    const std::span<const std::uint32_t> all = members(points, slot);
    const bool one_field = !meets_contact(slot);
    const std::vector<std::uint8_t>& field_of = points == Points::particles ? field_ : field_of_guest_;
    for (std::size_t i = 0, end = 0; i < all.size(); i = end) {
      const std::uint8_t field = one_field ? std::uint8_t{0} : field_of[all[i]];
      for (end = one_field ? all.size() : i + 1; end < all.size() && field_of[all[end]] == field;) ++end;
      f(all.subspan(i, end - i), static_cast<unsigned>(field));
    }
  }
  /// Returns whether the points of a slot may reach contact slots.
  [[nodiscard]] bool meets_contact(std::size_t slot) const {
    return !contact_slots_.empty() && meets_contact_[slot] != 0;
  }

  /// Return the number of node blocks of this rank's own slots, and the index of each.
  [[nodiscard]] std::size_t owned_blocks() const { return owned_slots() + owned_further_; }
  [[nodiscard]] std::size_t owned_block(std::size_t i) const {
    return i < owned_slots() ? i : slots() + (i - owned_slots());
  }
  [[nodiscard]] bool is_contact_block(std::size_t block) const {
    return !contact_slots_.empty() && (block >= slots() || contact_number_[block] != no_slot);
  }

  /// Returns the contact slots, ascending: this rank's own slots first.
  [[nodiscard]] std::span<const std::uint32_t> contact_slots() const { return contact_slots_; }
  [[nodiscard]] std::size_t owned_contact_slots() const { return owned_contact_slots_; }
  /// Returns the number of a slot in that list, or `no_slot`.
  [[nodiscard]] std::int32_t contact_number(std::size_t slot) const {
    return contact_slots_.empty() ? no_slot : contact_number_[slot];
  }
  /// Return the number of node blocks of a slot, and the index of each: that of the slot, then the additional ones.
  [[nodiscard]] std::size_t node_blocks(std::size_t slot) const {
    return contact_number(slot) == no_slot ? 1 : fields_[slot].count();
  }
  [[nodiscard]] std::size_t node_block(std::size_t slot, std::size_t i) const {
    return i == 0 ? slot : further_begin_[static_cast<std::size_t>(contact_number_[slot])] + i - 1;
  }
  /// Returns the undivided field of the nodes of a block; 0 where fields are not distinguished.
  [[nodiscard]] unsigned whole_of_block(std::size_t block) const {
    return whole(static_cast<unsigned>(std::max(field_of_block(block), 0)));
  }
  /// Returns the field whose nodes a part of a mixed particle has.
  [[nodiscard]] unsigned field_of_part(std::uint32_t part) const {
    return meets_contact(slot_of_part(part)) ? field_[mixed_of_part(part).particle] : 0U;
  }
  /// Returns the fields that reach a slot, since `separate_fields`.
  [[nodiscard]] const FieldSet& fields(std::size_t slot) const { return fields_[slot]; }

 protected:
  using PointBins::PointBins;
  /// Finds which fields reach each slot (BlockGrid::separate_fields); returns whether anything changed. Collective.
  bool find_fields(Stencil stencil, const FieldPoints& particles, const FieldPoints& guests, unsigned fields,
                   bool everywhere);
  /// Returns to one field shared by all points.
  void forget_fields() { fields_.clear(); }
  /// Orders the particles of every slot by field, if fields are divided, until the next `bin`.
  void list_by_field();
  /// Numbers the blocks of nodes, including the additional ones of contact slots.
  void number_blocks();
  [[nodiscard]] std::size_t block_count() const { return slots() + slot_of_further_.size(); }
  [[nodiscard]] std::size_t slot_of_block(std::size_t block) const {
    return block < slots() ? block : slot_of_further_[block - slots()];
  }
  /// Returns the field of the nodes of a block; -1: no or any field.
  [[nodiscard]] int field_of_block(std::size_t block) const;
  /// Returns the block of nodes of a field in a slot; that of the slot itself where the field has no separate nodes.
  [[nodiscard]] std::size_t block_of_field(std::size_t slot, unsigned field) const {
    if (contact_slots_.empty() || contact_number_[slot] == no_slot || !fields_[slot].contains(field)) {
      return slot;
    }
    const std::size_t before = fields_[slot].count_below(field);
    return before == 0 ? slot : further_begin_[static_cast<std::size_t>(contact_number_[slot])] + before - 1;
  }
  /// Returns whether a field reaches a slot, as far as fields are distinguished.
  [[nodiscard]] bool reaches(std::size_t slot, unsigned field) const {
    return fields_.empty() || fields_[slot].empty() || fields_[slot].contains(field);
  }

 private:
  /// Finds the fields that reach each slot, in sets of one word or of several.
  template <class Set>
  std::vector<FieldSet> fields_that_reach(Stencil stencil, const FieldPoints& particles,
                                          const FieldPoints& guests) const;

  std::array<std::uint8_t, maximum_fields> whole_ = [] {
    std::array<std::uint8_t, maximum_fields> each{};
    std::iota(each.begin(), each.end(), std::uint8_t{0});
    return each;
  }();
  bool is_divided_ = false;
  std::vector<std::uint8_t> field_;  // of each particle
  std::vector<std::uint8_t> field_of_guest_;
  std::vector<FieldSet> fields_;             // of each slot: those that reach it
  std::vector<std::uint8_t> meets_contact_;  // of each slot: 1 if one of its neighbours is a contact slot
  std::vector<std::uint32_t> contact_slots_;
  std::vector<std::int32_t> contact_number_;    // of each slot
  std::vector<std::uint32_t> further_begin_;    // of each contact slot: its first additional block
  std::vector<std::uint32_t> slot_of_further_;  // of each additional block
  std::size_t owned_contact_slots_ = 0, owned_further_ = 0;
};

}  // namespace whipple::grid
