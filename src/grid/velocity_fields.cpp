// SPDX-License-Identifier: BSD-3-Clause
#include "src/grid/velocity_fields.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "src/core/parallel/threads.hpp"
#include "src/grid/block_reach.hpp"

namespace whipple::grid {
namespace {

/// Holds a set of the first 64 fields: a `FieldSet` of one word, for few bodies.
struct OneWord {
  std::uint64_t bits = 0;

  void insert(unsigned field) { bits |= std::uint64_t{1} << field; }
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(std::popcount(bits)); }
  OneWord& operator|=(const OneWord& other) {
    bits |= other.bits;
    return *this;
  }
};

FieldSet whole_set(const FieldSet& set) { return set; }
FieldSet whole_set(const OneWord& set) { return FieldSet::of_bits(set.bits); }

}  // namespace

template <class Set>
std::vector<FieldSet> VelocityFields::fields_that_reach(Stencil stencil, const FieldPoints& particles,
                                                        const FieldPoints& guests) const {
  // In and around most blocks there are points of one field only.
  std::vector<Set> inside(slots()), around(slots());
  parallel::for_each(slots(), [&](std::size_t s) {
    for (const std::uint32_t p : particles_in(s)) inside[s].insert(particles.field[p]);
    for (const std::uint32_t p : guests_in(s)) inside[s].insert(guests.field[p]);
    for (const std::uint32_t part : parts_in(s)) inside[s].insert(field_[mixed_of_part(part).particle]);
  });
  parallel::for_each(slots(), [&](std::size_t s) {
    for (const std::int32_t n : neighbours(s)) {
      if (n != no_slot) around[s] |= inside[static_cast<std::size_t>(n)];
    }
  });
  const auto may_meet = [&](std::size_t s) { return is_shared() || around[s].count() > 1; };
  // For each slot: fields of its points that reach each of the 27 blocks.
  std::vector<std::array<Set, 27>> reached(slots());
  parallel::for_each_uneven(slots(), [&](std::size_t s) {
    const auto counts = [&](std::int32_t n) { return n != no_slot && may_meet(static_cast<std::size_t>(n)); };
    if (!std::ranges::any_of(neighbours(s), counts)) return;
    const auto reach = [&](const FieldPoints& points, std::uint32_t p) {
      const std::uint32_t touched = touched_neighbours(in_cells(points.position[p], s) - corner(s), stencil);
      for_each_bit(touched, [&](unsigned n) { reached[s][n].insert(points.field[p]); });
    };
    for (const std::uint32_t p : particles_in(s)) reach(particles, p);
    for (const std::uint32_t p : guests_in(s)) reach(guests, p);
    for (const std::uint32_t part : parts_in(s)) reach(particles, mixed_of_part(part).particle);
  });
  std::vector<FieldSet> present(slots());
  parallel::for_each(slots(), [&](std::size_t s) {
    if (!may_meet(s)) {
      present[s] = whole_set(around[s]);
      return;
    }
    Set all;
    for (std::size_t n = 0; n < 27; ++n) {
      const std::int32_t neighbour = neighbours(s)[n];
      if (neighbour != no_slot) all |= reached[static_cast<std::size_t>(neighbour)][26 - n];
    }
    present[s] = whole_set(all);
  });
  return present;
}

bool VelocityFields::find_fields(Stencil stencil, const FieldPoints& particles, const FieldPoints& guests,
                                 unsigned fields, bool everywhere) {
  field_.assign(particles.field.begin(), particles.field.end());
  field_of_guest_.assign(guests.field.begin(), guests.field.end());
  std::vector<FieldSet> present;
  if (everywhere) {
    FieldSet all;
    for (unsigned field = 0; field < std::min(fields, maximum_fields); ++field) all.insert(field);
    present.assign(slots(), all);
  } else {
    present = fields <= 64 ? fields_that_reach<OneWord>(stencil, particles, guests)
                           : fields_that_reach<FieldSet>(stencil, particles, guests);
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
    const std::size_t fields = fields_[s].count();
    if (fields < 2) continue;
    contact_number_[s] = static_cast<std::int32_t>(contact_slots_.size());
    contact_slots_.push_back(static_cast<std::uint32_t>(s));
    further_begin_.push_back(static_cast<std::uint32_t>(slots() + slot_of_further_.size()));
    slot_of_further_.insert(slot_of_further_.end(), fields - 1, static_cast<std::uint32_t>(s));
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
    return static_cast<int>(fields_[s].nth(block < slots() ? 0 : block - first_further + 1));
  }
  return !fields_.empty() && !fields_[s].empty() ? static_cast<int>(fields_[s].nth(0)) : -1;
}

}  // namespace whipple::grid
