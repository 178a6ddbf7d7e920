// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <cstdint>
#include <vector>

#include "src/core/parallel/threads.hpp"
#include "src/grid/forest.hpp"

/// Messages with values of the slots that ranks share.
namespace whipple::grid {

/// Selects the slots shared with a peer: those lent to it or those borrowed from it.
using SharedSlots = std::vector<std::uint32_t> BlockSet::Peer::*;

/// Holds the buffers of pending messages, by peer.
template <class Value>
struct SlotMessages {
  std::vector<std::vector<Value>> outgoing, incoming;
  std::vector<MPI_Request> requests;
  void wait() {
    if (requests.empty()) return;
    MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
    requests.clear();
  }
  SlotMessages() = default;
  SlotMessages(SlotMessages&&) = default;
  SlotMessages& operator=(SlotMessages&&) = delete;
  ~SlotMessages() { wait(); }  // all ranks have begun; no message may write to freed memory
};

/// Returns the begin of each shared slot's values in a buffer, and the end of the last.
template <class Size>
std::vector<std::size_t> begins(const std::vector<std::uint32_t>& shared, Size&& size) {
  std::vector<std::size_t> begin(shared.size() + 1, 0);
  for (std::size_t i = 0; i < shared.size(); ++i) begin[i + 1] = begin[i] + size(shared[i]);
  return begin;
}

/// Calls pack(slot of `from`, buffer) and sends the buffers, with size(slot) values for each slot.
template <class Value, class Size, class Pack>
void send(MPI_Comm communicator, const std::vector<BlockSet::Peer>& peers, SlotMessages<Value>& messages,
          int tag, SharedSlots from, SharedSlots to, Size&& size, Pack&& pack) {
  static_assert(sizeof(Value) % sizeof(double) == 0);
  constexpr int words = sizeof(Value) / sizeof(double);
  auto& [outgoing, incoming, requests] = messages;
  outgoing.resize(peers.size());
  incoming.resize(peers.size());
  requests.assign(2 * peers.size(), MPI_REQUEST_NULL);
  for (std::size_t i = 0; i < peers.size(); ++i) {
    incoming[i].resize(begins(peers[i].*to, size).back());
    MPI_Irecv(incoming[i].data(), words * static_cast<int>(incoming[i].size()), MPI_DOUBLE, peers[i].rank,
              tag, communicator, &requests[2 * i]);
  }
  for (std::size_t i = 0; i < peers.size(); ++i) {
    const std::vector<std::uint32_t>& sent = peers[i].*from;
    const std::vector<std::size_t> begin = begins(sent, size);
    outgoing[i].resize(begin.back());
    parallel::for_each(sent.size(), [&](std::size_t s) { pack(sent[s], &outgoing[i][begin[s]]); });
    MPI_Isend(outgoing[i].data(), words * static_cast<int>(outgoing[i].size()), MPI_DOUBLE, peers[i].rank,
              tag, communicator, &requests[2 * i + 1]);
  }
}

/// Waits for the buffers and calls unpack(slot of `to`, buffer).
template <class Value, class Size, class Unpack>
void receive(const std::vector<BlockSet::Peer>& peers, SlotMessages<Value>& messages, SharedSlots to,
             Size&& size, Unpack&& unpack) {
  messages.wait();
  for (std::size_t i = 0; i < peers.size(); ++i) {  // in the order of the ranks, for reproducible sums
    const std::vector<std::uint32_t>& received = peers[i].*to;
    const std::vector<std::size_t> begin = begins(received, size);
    parallel::for_each(received.size(),
                       [&](std::size_t s) { unpack(received[s], &messages.incoming[i][begin[s]]); });
  }
}

/// Sends and receives in one call.
template <class Value, class Size, class Pack, class Unpack>
void exchange(MPI_Comm communicator, const std::vector<BlockSet::Peer>& peers, int tag, SharedSlots from,
              SharedSlots to, Size&& size, Pack&& pack, Unpack&& unpack) {
  SlotMessages<Value> messages;
  send(communicator, peers, messages, tag, from, to, size, pack);
  receive(peers, messages, to, size, unpack);
}

}  // namespace whipple::grid
