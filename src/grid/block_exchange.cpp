// SPDX-License-Identifier: BSD-3-Clause
// What the ranks tell each other about the blocks that they share.
#include <algorithm>

#include "src/grid/block_grid.hpp"
#include "src/core/parallel/mpi.hpp"
#include "src/core/parallel/threads.hpp"

namespace whipple::grid {

bool BlockGrid::is_shared() const { return parallel::size(communicator_) > 1; }

namespace {

constexpr int tag_of_nodes = 11, tag_of_values = 12;

/// Returns where the values of each shared slot begin in a buffer, and the end of the last.
template <class Size>
std::vector<std::size_t> begins(const std::vector<std::uint32_t>& shared, Size&& size) {
  std::vector<std::size_t> begin(shared.size() + 1, 0);
  for (std::size_t i = 0; i < shared.size(); ++i) begin[i + 1] = begin[i] + size(shared[i]);
  return begin;
}

}  // namespace

template <class Value, class Size, class Pack>
void BlockGrid::send(Messages<Value>& messages, int tag, SharedSlots from, SharedSlots to, Size&& size,
                     Pack&& pack) {
  static_assert(sizeof(Value) % sizeof(double) == 0);
  constexpr int words = sizeof(Value) / sizeof(double);
  const std::vector<BlockSet::Peer>& peers = blocks_.peers;
  auto& [outgoing, incoming, requests] = messages;
  outgoing.resize(peers.size());
  incoming.resize(peers.size());
  requests.assign(2 * peers.size(), MPI_REQUEST_NULL);
  for (std::size_t i = 0; i < peers.size(); ++i) {
    incoming[i].resize(begins(peers[i].*to, size).back());
    MPI_Irecv(incoming[i].data(), words * static_cast<int>(incoming[i].size()), MPI_DOUBLE, peers[i].rank,
              tag, communicator_, &requests[2 * i]);
  }
  for (std::size_t i = 0; i < peers.size(); ++i) {
    const std::vector<std::uint32_t>& sent = peers[i].*from;
    const std::vector<std::size_t> begin = begins(sent, size);
    outgoing[i].resize(begin.back());
    parallel::for_each(sent.size(), [&](std::size_t s) { pack(sent[s], &outgoing[i][begin[s]]); });
    MPI_Isend(outgoing[i].data(), words * static_cast<int>(outgoing[i].size()), MPI_DOUBLE, peers[i].rank,
              tag, communicator_, &requests[2 * i + 1]);
  }
}

template <class Value, class Size, class Unpack>
void BlockGrid::receive(Messages<Value>& messages, SharedSlots to, Size&& size, Unpack&& unpack) {
  messages.wait();
  for (std::size_t i = 0; i < blocks_.peers.size(); ++i) {  // in the order of the ranks: sums are repeatable
    const std::vector<std::uint32_t>& received = blocks_.peers[i].*to;
    const std::vector<std::size_t> begin = begins(received, size);
    parallel::for_each(received.size(),
                       [&](std::size_t s) { unpack(received[s], &messages.incoming[i][begin[s]]); });
  }
}

template <class Value, class Size, class Pack, class Unpack>
void BlockGrid::exchange(SharedSlots from, SharedSlots to, Size&& size, Pack&& pack, Unpack&& unpack) {
  Messages<Value> messages;
  send(messages, tag_of_values, from, to, size, pack);
  receive(messages, to, size, unpack);
}

void BlockGrid::send_nodes(Part part, SharedSlots from, SharedSlots to) {
  const std::size_t registers = part == Part::both ? 2 : 1;
  send(
      node_messages_, tag_of_nodes, from, to,
      [&](std::size_t slot) { return node_blocks(slot) * registers * nodes_per_block; },
      [&](std::size_t slot, Lanes* out) {
        for (std::size_t i = 0; i < node_blocks(slot); ++i) {
          const Node* of_block = &nodes_[node_block(slot, i) * nodes_per_block];
          for (std::size_t n = 0; n < nodes_per_block; ++n) {
            *out++ = of_block[n].first;
            if (part == Part::both) *out++ = of_block[n].second;
          }
        }
      });
}

template <class Combine>
void BlockGrid::receive_nodes(Part part, SharedSlots to, Combine&& combine) {
  const std::size_t registers = part == Part::both ? 2 : 1;
  receive(
      node_messages_, to, [&](std::size_t slot) { return node_blocks(slot) * registers * nodes_per_block; },
      [&](std::size_t slot, const Lanes* in) {
        for (std::size_t i = 0; i < node_blocks(slot); ++i) {
          Node* of_block = &nodes_[node_block(slot, i) * nodes_per_block];
          for (std::size_t n = 0; n < nodes_per_block; ++n, in += registers) combine(of_block[n], in);
        }
      });
}

void BlockGrid::begin_sum_to_owners(Part part) {
  send_nodes(part, &BlockSet::Peer::borrowed, &BlockSet::Peer::lent);
}

void BlockGrid::finish_sum_to_owners(Part part) {
  receive_nodes(part, &BlockSet::Peer::lent, [part](Node& node, const Lanes* in) {
    node.first += in[0];
    if (part == Part::both) node.second += in[1];
  });
}

void BlockGrid::begin_borrow_from_owners(Part part) {
  send_nodes(part, &BlockSet::Peer::lent, &BlockSet::Peer::borrowed);
}

void BlockGrid::finish_borrow_from_owners(Part part) {
  receive_nodes(part, &BlockSet::Peer::borrowed, [part](Node& node, const Lanes* in) {
    node.first = in[0];
    if (part == Part::both) node.second = in[1];
  });
}

void BlockGrid::progress() {
  std::vector<MPI_Request>& requests = node_messages_.requests;
  if (requests.empty() || !parallel::is_first_thread()) return;
  int complete = 0;
  MPI_Testall(static_cast<int>(requests.size()), requests.data(), &complete, MPI_STATUSES_IGNORE);
}

/// @param range  range(slot): its values
template <class Range, class Combine>
void BlockGrid::exchange_values(Range&& range, SharedSlots from, SharedSlots to, Combine&& combine) {
  exchange<Lanes>(
      from, to, [&](std::size_t slot) { return range(slot).size(); },
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

void BlockGrid::maximum_to_owners(SlotValues& values) {
  exchange_values(values_of(*this, values), &BlockSet::Peer::borrowed, &BlockSet::Peer::lent, take_larger);
}

void BlockGrid::borrow_from_owners(SlotValues& values) {
  exchange_values(values_of(*this, values), &BlockSet::Peer::lent, &BlockSet::Peer::borrowed, replace);
}

void BlockGrid::join_bits_of_ranks(std::vector<std::uint64_t>& of_slot) {
  const auto one = [](std::size_t) { return std::size_t{1}; };
  const auto pack = [&](std::size_t slot, std::uint64_t* out) { *out = of_slot[slot]; };
  exchange<std::uint64_t>(&BlockSet::Peer::borrowed, &BlockSet::Peer::lent, one, pack,
                          [&](std::size_t slot, const std::uint64_t* in) { of_slot[slot] |= *in; });
  exchange<std::uint64_t>(&BlockSet::Peer::lent, &BlockSet::Peer::borrowed, one, pack,
                          [&](std::size_t slot, const std::uint64_t* in) { of_slot[slot] = *in; });
}

}  // namespace whipple::grid
