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

/// Communication between the processes of the solver. All functions with a communicator are collective, and free on one
/// rank. Sums use a fixed tree of ranks: results are bitwise equal for the same number of ranks.
namespace whipple::parallel {

/// Initialises MPI on the first call of the process (threads: only the main thread communicates) and finalises it at
/// exit. Later calls are free. @returns MPI_COMM_WORLD
MPI_Comm world();

/// Returns the rank (number of ranks) in a communicator.
int rank(MPI_Comm comm);
int size(MPI_Comm comm);

/// Returns the number of ranks of the communicator on this machine.
int ranks_on_machine(MPI_Comm comm);

/// Terminates all ranks when one of them cannot continue: an error may not reach the others, which may be waiting for
/// this one. The first rank prints the message; another rank does so only if the first does not terminate it soon.
[[noreturn]] void end_all_ranks(MPI_Comm comm, const std::string& message, int exit_code);

/// Returns the maximum over all ranks.
double maximum(MPI_Comm comm, double value);
/// Replaces the values by their maximum over all ranks, element by element.
void maximum(MPI_Comm comm, std::span<double> values);
/// Replaces the values by their sum over all ranks, element by element.
void sum(MPI_Comm comm, std::span<double> values);
/// Returns whether the value is true on any rank.
bool any(MPI_Comm comm, bool value);

/// Ends a failed step on every rank: if any rank passes an error (a non-empty text), all throw a StateError with the
/// text of the lowest such rank.
void throw_together(MPI_Comm comm, const std::string& error);

/// Describes rows of an array distributed over several ranks, consecutive in the order of the ranks.
struct RowsOfRanks {
  std::span<const std::byte> own;  ///< rows of this rank
  std::size_t first = 0;           ///< number of the first row
  std::size_t row_size = 1;        ///< bytes
};
/// Gathers all rows on the first rank, piece by piece, so that it does not need memory for all of them.
/// @param piece  rows per piece
/// @param take   called on the first rank with the number of the first row of every piece, and the piece
void gather_rows(MPI_Comm comm, const RowsOfRanks& rows, std::size_t piece,
                 const std::function<void(std::size_t first, std::span<const std::byte> rows)>& take);

/// Sends raw bytes to every rank; entry r of the result is from rank r.
std::vector<std::vector<std::byte>> exchange_bytes(MPI_Comm comm,
                                                   const std::vector<std::vector<std::byte>>& outgoing);

/// Sends outgoing[r] to rank r; entry r of the result is from rank r.
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
