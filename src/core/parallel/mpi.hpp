// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

/// Communicates between the processes of the solver. Everything with a communicator is collective, and free on one
/// rank. Sums are taken along one tree of ranks: the same bits for the same number of ranks.
namespace whipple::parallel {

/// Initialises MPI on the first call of the process (threads: only the main thread communicates) and
/// finalises it at exit. Every later call is free. @returns MPI_COMM_WORLD
MPI_Comm world();

/// Rank and number of ranks of a communicator.
int rank(MPI_Comm comm);
int size(MPI_Comm comm);

/// Ranks of the communicator on this machine.
int ranks_on_machine(MPI_Comm comm);

/// Ends all ranks when one of them cannot go on: an error need not reach the others, which may be waiting for
/// this one. The first rank prints the message; another one only if the first does not end it soon.
[[noreturn]] void end_all_ranks(MPI_Comm comm, const std::string& message, int exit_code);

/// Largest value of all ranks.
double maximum(MPI_Comm comm, double value);
/// Replaces the values by their maximum over all ranks, element by element.
void maximum(MPI_Comm comm, std::span<double> values);
/// Sum over all ranks, element by element and in place.
void sum(MPI_Comm comm, std::span<double> values);
/// Returns whether the value is true on any rank.
bool any(MPI_Comm comm, bool value);

/// Ends a failed step on every rank: if any rank brings an error (a text that is not empty), all throw a
/// StateError with the text of the lowest such rank.
void throw_together(MPI_Comm comm, const std::string& error);

/// Rows of an array that lie on several ranks, one behind the other in the order of the ranks.
struct RowsOfRanks {
  std::span<const std::byte> own;  ///< those of this rank
  std::size_t first = 0;           ///< number of the first of them
  std::size_t row_size = 1;        ///< bytes
};
/// Brings all rows to the first rank, piece by piece, so that it needs no room for all.
/// @param piece  rows of a piece
/// @param take   gets there the number of the first row of every piece, and the piece
void gather_rows(MPI_Comm comm, const RowsOfRanks& rows, std::size_t piece,
                 const std::function<void(std::size_t first, std::span<const std::byte> rows)>& take);

/// Sends raw bytes to every rank; entry r of the result came from rank r.
std::vector<std::vector<std::byte>> exchange_bytes(MPI_Comm comm,
                                                   const std::vector<std::vector<std::byte>>& outgoing);

/// Sends outgoing[r] to rank r; entry r of the result came from rank r.
template <class T>
  requires std::is_trivially_copyable_v<T>
std::vector<std::vector<T>> exchange(MPI_Comm comm, const std::vector<std::vector<T>>& outgoing) {
  std::vector<std::vector<std::byte>> bytes(outgoing.size());
  for (std::size_t r = 0; r < outgoing.size(); ++r) {
    const std::span<const std::byte> source = std::as_bytes(std::span(outgoing[r]));
    bytes[r].assign(source.begin(), source.end());
  }
  std::vector<std::vector<T>> incoming(outgoing.size());
  bytes = exchange_bytes(comm, bytes);
  for (std::size_t r = 0; r < bytes.size(); ++r) {
    incoming[r].resize(bytes[r].size() / sizeof(T));
    std::copy(bytes[r].begin(), bytes[r].end(), std::as_writable_bytes(std::span(incoming[r])).begin());
  }
  return incoming;
}

}  // namespace whipple::parallel
