// SPDX-License-Identifier: BSD-3-Clause
#include "src/grid/block_grid.hpp"

#include <algorithm>

#include "src/core/parallel/mpi.hpp"

namespace whipple::grid {

void BlockGrid::activate(std::span<const Vector3> position, std::span<const Vector3> velocity,
                         double lookahead, Stencil stencil, std::size_t guests) {
  Topology::activate(position, velocity, lookahead, stencil);
  forget_fields();
  lay_out_nodes();
  find_border();
  set_apart();
  look_up(position.first(position.size() - guests));
}

void BlockGrid::shift(const Vector3& cells) {
  Topology::shift(cells);
  forget_runs();
}

void BlockGrid::separate_fields(Stencil stencil, const FieldPoints& particles, const FieldPoints& guests,
                                unsigned fields, bool everywhere) {
  if (find_fields(stencil, particles, guests, fields, everywhere)) lay_out_nodes();
  list_by_field();
}

void BlockGrid::set_apart() {
  const int halved = slots() >= slots_for_cubes ? 1 : 0;
  const auto group_of = [&](std::uint32_t slot) {
    const BlockCoordinate& c = coordinate(slot);
    return BlockCoordinate{{(c[0] + 1) >> halved, (c[1] + 1) >> halved, (c[2] + 1) >> halved}, c.level};
  };
  apart_ = {};
  BlockTable group_number;  // of each region and colour
  std::array<std::array<std::vector<std::pair<std::uint32_t, std::uint32_t>>, 8>, 2> members;
  group_number.reserve(slots());
  std::int32_t groups = 0;
  for (std::uint32_t s = 0; s < slots(); ++s) {
    const BlockCoordinate c = group_of(s);
    std::int32_t& number = group_number.find_or_insert(c, groups);
    if (number == groups) ++groups;
    members[static_cast<std::size_t>(region(s))]
           [static_cast<std::size_t>((c[0] & 1) << 2 | (c[1] & 1) << 1 | (c[2] & 1))]
               .emplace_back(static_cast<std::uint32_t>(number), s);
  }
  for (std::size_t r = 0; r < members.size(); ++r) {
    for (std::size_t colour = 0; colour < 8; ++colour) {
      auto& list = members[r][colour];
      std::ranges::sort(list);
      SlotGroups& of_colour = apart_[r][colour];
      for (std::size_t i = 0; i < list.size(); ++i) {
        if (i == 0 || list[i].first != list[i - 1].first) {
          of_colour.begin.push_back(static_cast<std::uint32_t>(i));
        }
        of_colour.slots.push_back(list[i].second);
      }
      of_colour.begin.push_back(static_cast<std::uint32_t>(list.size()));
    }
  }
}

std::size_t BlockGrid::bytes() const {
  return all_nodes().size() * sizeof(Node) +
         slots() * (sizeof(std::array<std::int32_t, 27>) + sizeof(BlockCoordinate)) + bytes_of_bins();
}

// --- Exchange of node values between ranks ------------------------------------------------------------------

namespace {

constexpr int tag_of_nodes = 11, tag_of_values = 12;

}  // namespace

void BlockGrid::send_nodes(Part part, SharedSlots from, SharedSlots to) {
  const std::size_t registers = part == Part::both ? 2 : 1;
  send(
      communicator(), peers(), node_messages_, tag_of_nodes, from, to,
      [&](std::size_t slot) { return node_blocks(slot) * registers * nodes_per_block; },
      [&](std::size_t slot, Lanes* out) {
        for (std::size_t i = 0; i < node_blocks(slot); ++i) {
          const Node* of_block = &all_nodes()[node_block(slot, i) * nodes_per_block];
          for (std::size_t n = 0; n < nodes_per_block; ++n) {
            *out++ = of_block[n].registers.first;
            if (part == Part::both) *out++ = of_block[n].registers.second;
          }
        }
      });
}

template <class Combine>
void BlockGrid::receive_nodes(Part part, SharedSlots to, Combine&& combine) {
  const std::size_t registers = part == Part::both ? 2 : 1;
  receive(
      peers(), node_messages_, to,
      [&](std::size_t slot) { return node_blocks(slot) * registers * nodes_per_block; },
      [&](std::size_t slot, const Lanes* in) {
        for (std::size_t i = 0; i < node_blocks(slot); ++i) {
          Node* of_block = &all_nodes()[node_block(slot, i) * nodes_per_block];
          for (std::size_t n = 0; n < nodes_per_block; ++n, in += registers) combine(of_block[n], in);
        }
      });
}

void BlockGrid::begin_sum_to_owners(Part part) {
  send_nodes(part, &BlockSet::Peer::borrowed, &BlockSet::Peer::lent);
}

void BlockGrid::finish_sum_to_owners(Part part) {
  receive_nodes(part, &BlockSet::Peer::lent, [part](Node& node, const Lanes* in) {
    node.registers.first += in[0];
    if (part == Part::both) node.registers.second += in[1];
  });
}

void BlockGrid::begin_borrow_from_owners(Part part) {
  send_nodes(part, &BlockSet::Peer::lent, &BlockSet::Peer::borrowed);
}

void BlockGrid::finish_borrow_from_owners(Part part) {
  receive_nodes(part, &BlockSet::Peer::borrowed, [part](Node& node, const Lanes* in) {
    node.registers.first = in[0];
    if (part == Part::both) node.registers.second = in[1];
  });
}

void BlockGrid::progress() {
  std::vector<MPI_Request>& requests = node_messages_.requests;
  if (requests.empty() || !parallel::is_first_thread()) return;
  int complete = 0;
  MPI_Testall(static_cast<int>(requests.size()), requests.data(), &complete, MPI_STATUSES_IGNORE);
}

/// Exchanges the values of shared slots and combines received values with those of this rank.
/// @param range  range(slot): values of the slot
template <class Range, class Combine>
void BlockGrid::exchange_values(Range&& range, SharedSlots from, SharedSlots to, Combine&& combine) {
  exchange<Lanes>(
      communicator(), peers(), tag_of_values, from, to, [&](std::size_t slot) { return range(slot).size(); },
      [&](std::size_t slot, Lanes* out) { std::ranges::copy(range(slot), out); },
      [&](std::size_t slot, const Lanes* in) {
        for (Lanes& value : range(slot)) combine(value, *in++);
      });
}

namespace {

auto values_of(const BlockGrid& grid, ContactValues& values) {
  return [&](std::size_t slot) {
    const std::int32_t number = grid.contact_number(slot);
    if (number == BlockGrid::no_slot) return std::span<Lanes>();
    const auto c = static_cast<std::size_t>(number);
    return std::span(values.values).subspan(values.begin[c], values.begin[c + 1] - values.begin[c]);
  };
}
auto values_of(const BlockGrid&, SlotValues& values) {
  return [&](std::size_t slot) {
    return std::span(values.values).subspan(values.begin[slot], values.begin[slot + 1] - values.begin[slot]);
  };
}

void add(Lanes& value, const Lanes& in) { value += in; }
void take_larger(Lanes& value, const Lanes& in) { value = value > in ? value : in; }
void replace(Lanes& value, const Lanes& in) { value = in; }

}  // namespace

void BlockGrid::sum_to_owners(ContactValues& values) {
  exchange_values(values_of(*this, values), &BlockSet::Peer::borrowed, &BlockSet::Peer::lent, add);
}

void BlockGrid::maximum_to_owners(ContactValues& values) {
  exchange_values(values_of(*this, values), &BlockSet::Peer::borrowed, &BlockSet::Peer::lent, take_larger);
}

void BlockGrid::borrow_from_owners(ContactValues& values) {
  exchange_values(values_of(*this, values), &BlockSet::Peer::lent, &BlockSet::Peer::borrowed, replace);
}

void BlockGrid::sum_to_owners(SlotValues& values) {
  exchange_values(values_of(*this, values), &BlockSet::Peer::borrowed, &BlockSet::Peer::lent, add);
}

void BlockGrid::maximum_to_owners(SlotValues& values) {
  exchange_values(values_of(*this, values), &BlockSet::Peer::borrowed, &BlockSet::Peer::lent, take_larger);
}

void BlockGrid::borrow_from_owners(SlotValues& values) {
  exchange_values(values_of(*this, values), &BlockSet::Peer::lent, &BlockSet::Peer::borrowed, replace);
}

}  // namespace whipple::grid
