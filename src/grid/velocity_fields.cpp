// SPDX-License-Identifier: BSD-3-Clause
#include "src/grid/velocity_fields.hpp"

#include <algorithm>
#include <array>

#include "src/core/parallel/threads.hpp"
#include "src/grid/block_reach.hpp"

namespace whipple::grid {
namespace {

/// Returns the position of the n-th set bit.
int nth_bit(std::uint64_t bits, std::size_t n) {
  for (; n > 0; --n) bits &= bits - 1;
  return std::countr_zero(bits);
}

}  // namespace

bool VelocityFields::find_fields(Stencil stencil, const FieldPoints& particles, const FieldPoints& guests,
                                 unsigned fields, bool everywhere) {
  field_.assign(particles.field.begin(), particles.field.end());
  field_of_guest_.assign(guests.field.begin(), guests.field.end());
  const std::uint64_t all = fields >= maximum_fields ? ~std::uint64_t{0} : (std::uint64_t{1} << fields) - 1;
  std::vector<std::uint64_t> present(slots(), everywhere ? all : 0);
  if (!everywhere) {
    // In and around most blocks there are points of one field only.
    std::vector<std::uint64_t> inside(slots(), 0), around(slots(), 0);
    parallel::for_each(slots(), [&](std::size_t s) {
      for (const std::uint32_t p : particles_in(s)) inside[s] |= std::uint64_t{1} << particles.field[p];
      for (const std::uint32_t p : guests_in(s)) inside[s] |= std::uint64_t{1} << guests.field[p];
    });
    parallel::for_each(slots(), [&](std::size_t s) {
      for (const std::int32_t n : neighbours(s)) {
        if (n != no_slot) around[s] |= inside[static_cast<std::size_t>(n)];
      }
    });
    const auto may_meet = [&](std::size_t s) { return is_shared() || std::popcount(around[s]) > 1; };
    // For each slot: fields of its points that reach each of the 27 blocks.
    std::vector<std::array<std::uint64_t, 27>> reached(slots());
    parallel::for_each_uneven(slots(), [&](std::size_t s) {
      reached[s].fill(0);
      const auto counts = [&](std::int32_t n) {
        return n != no_slot && may_meet(static_cast<std::size_t>(n));
      };
      if (!std::ranges::any_of(neighbours(s), counts)) return;
      const auto reach = [&](std::span<const std::uint32_t> members, const FieldPoints& points) {
        for (const std::uint32_t p : members) {
          const std::uint32_t touched = touched_neighbours(in_cells(points.position[p]) - corner(s), stencil);
          for_each_bit(touched, [&](unsigned n) { reached[s][n] |= std::uint64_t{1} << points.field[p]; });
        }
      };
      reach(particles_in(s), particles);
      reach(guests_in(s), guests);
    });
    parallel::for_each(slots(), [&](std::size_t s) {
      if (!may_meet(s)) {
        present[s] = around[s];
        return;
      }
      for (std::size_t n = 0; n < 27; ++n) {
        const std::int32_t neighbour = neighbours(s)[n];
        if (neighbour != no_slot) present[s] |= reached[static_cast<std::size_t>(neighbour)][26 - n];
      }
    });
    join_bits_of_ranks(present);
  }
  if (present == fields_) return false;
  fields_ = std::move(present);
  return true;
}

void VelocityFields::list_by_field() {
  if (contact_slots_.empty() || !is_divided_) return;
  const auto field_of = [&](std::uint32_t p) { return field_[p]; };
  parallel::for_each_uneven(slots(), [&](std::size_t s) {
    if (!meets_contact(s) || std::ranges::is_sorted(particles_in(s), {}, field_of)) return;
    std::ranges::stable_sort(listed_in(s), {}, field_of);
  });
}

void VelocityFields::number_blocks() {
  contact_slots_.clear();
  contact_number_.assign(slots(), no_slot);
  further_begin_.clear();
  slot_of_further_.clear();
  owned_contact_slots_ = owned_further_ = 0;
  for (std::size_t s = 0; s < fields_.size(); ++s) {
    const int fields = std::popcount(fields_[s]);
    if (fields < 2) continue;
    contact_number_[s] = static_cast<std::int32_t>(contact_slots_.size());
    contact_slots_.push_back(static_cast<std::uint32_t>(s));
    further_begin_.push_back(static_cast<std::uint32_t>(slots() + slot_of_further_.size()));
    slot_of_further_.insert(slot_of_further_.end(), static_cast<std::size_t>(fields - 1),
                            static_cast<std::uint32_t>(s));
    if (s < owned_slots()) {
      owned_contact_slots_ = contact_slots_.size();
      owned_further_ = slot_of_further_.size();
    }
  }
  meets_contact_.assign(contact_slots_.empty() ? 0 : slots(), 0);
  for (const std::uint32_t s : contact_slots_) {
    for (const std::int32_t neighbour : neighbours(s)) {
      if (neighbour != no_slot) meets_contact_[static_cast<std::size_t>(neighbour)] = 1;
    }
  }
}

int VelocityFields::field_of_block(std::size_t block) const {
  const std::size_t s = slot_of_block(block);
  if (contact_number(s) != no_slot) {
    const std::size_t first_further = further_begin_[static_cast<std::size_t>(contact_number(s))];
    return nth_bit(fields_[s], block < slots() ? 0 : block - first_further + 1);
  }
  return !fields_.empty() && fields_[s] != 0 ? nth_bit(fields_[s], 0) : -1;
}

}  // namespace whipple::grid
