// SPDX-License-Identifier: BSD-3-Clause
#include "src/core/parallel/mpi.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <new>
#include <thread>

#include "src/core/base/error.hpp"
#include "src/core/base/surroundings.hpp"
#include "src/core/parallel/address_space.hpp"

namespace whipple::parallel {
namespace {

/// Handles exhausted memory. OpenMP does not pass exceptions out of parallel loops, and would terminate the process
/// without a message.
void on_exhausted_memory() {
  if (omp_get_level() == 0) throw std::bad_alloc();
  std::fputs(
      "whipple: error: the memory that this process may use is exhausted; a run goes on from its last "
      "checkpoint with --restart\n",
      stderr);
  std::fflush(stderr);
  std::_Exit(static_cast<int>(ExitCode::state));
}

/// Manages the lifetime of MPI, which is bound to the process and not to an object of the program.
class Session {
 public:
  Session() {
    int initialised = 0;
    MPI_Initialized(&initialised);
    if (initialised != 0) return;
    require_address_space(1);
    require_room_for_mpi();
    let_mpi_start_alone();
    std::set_new_handler(on_exhausted_memory);
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    owner_ = true;
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session() {
    int finalised = 0;
    MPI_Finalized(&finalised);
    if (owner_ && finalised == 0) MPI_Finalize();
  }

 private:
  bool owner_ = false;
};

}  // namespace

MPI_Comm world() {
  static const Session session;
  return MPI_COMM_WORLD;
}

int rank(MPI_Comm comm) {
  int value = 0;
  MPI_Comm_rank(comm, &value);
  return value;
}

int size(MPI_Comm comm) {
  int value = 1;
  MPI_Comm_size(comm, &value);
  return value;
}

int ranks_on_machine(MPI_Comm comm) {
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  const int ranks = size(machine);
  MPI_Comm_free(&machine);
  return ranks;
}

void end_all_ranks(MPI_Comm comm, const std::string& message, int exit_code) {
  if (rank(comm) != 0) std::this_thread::sleep_for(std::chrono::seconds(2));
  std::fprintf(stderr, "%s\n", message.c_str());
  std::fflush(nullptr);
  MPI_Abort(comm, exit_code);
  std::abort();  // not reached: MPI_Abort does not return
}

void maximum(MPI_Comm comm, std::span<double> values) {
  if (size(comm) == 1) return;
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MAX, comm);
}

double maximum(MPI_Comm comm, double value) {
  maximum(comm, std::span(&value, 1));
  return value;
}

void sum(MPI_Comm comm, std::span<double> values) {
  constexpr int sum_tag = 5;
  const int ranks = size(comm), own = rank(comm), count = static_cast<int>(values.size());
  if (ranks == 1) return;
  // A custom binomial tree: MPI_SUM may use another order from run to run.
  std::vector<double> other(values.size());
  for (int reach = 1; reach < ranks; reach *= 2) {
    if ((own & reach) != 0) {
      MPI_Send(values.data(), count, MPI_DOUBLE, own - reach, sum_tag, comm);
      break;
    }
    if (own + reach >= ranks) continue;
    MPI_Recv(other.data(), count, MPI_DOUBLE, own + reach, sum_tag, comm, MPI_STATUS_IGNORE);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += other[i];
  }
  MPI_Bcast(values.data(), count, MPI_DOUBLE, 0, comm);
}

bool any(MPI_Comm comm, bool value) { return maximum(comm, value ? 1.0 : 0.0) > 0.0; }

void throw_together(MPI_Comm comm, const std::string& error) {
  const int ranks = size(comm), own = rank(comm);
  int first = error.empty() ? ranks : own;
  if (ranks > 1) MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, comm);
  if (first == ranks) return;
  std::string text = error;
  int length = static_cast<int>(text.size());
  MPI_Bcast(&length, 1, MPI_INT, first, comm);
  text.resize(static_cast<std::size_t>(length));
  MPI_Bcast(text.data(), length, MPI_CHAR, first, comm);
  throw StateError(text);
}

void gather_rows(MPI_Comm comm, const RowsOfRanks& rows, std::size_t piece,
                 const std::function<void(std::size_t first, std::span<const std::byte> rows)>& take) {
  constexpr int tag = 9;
  const int ranks = size(comm), own = rank(comm);
  using Range = std::array<unsigned long, 2>;  // first row, row behind the last
  const Range mine = {rows.first, rows.first + rows.own.size() / rows.row_size};
  std::vector<Range> of_rank(static_cast<std::size_t>(ranks));
  MPI_Gather(mine.data(), 2, MPI_UNSIGNED_LONG, of_rank.data(), 2, MPI_UNSIGNED_LONG, 0, comm);
  const auto own_part = [&](std::size_t begin, std::size_t end) {
    return rows.own.subspan((begin - mine[0]) * rows.row_size, (end - begin) * rows.row_size);
  };
  if (own != 0) {
    for (std::size_t begin = mine[0]; begin < mine[1];) {
      const std::size_t end = std::min<std::size_t>((begin / piece + 1) * piece, mine[1]);
      const std::span<const std::byte> part = own_part(begin, end);
      MPI_Send(part.data(), static_cast<int>(part.size()), MPI_BYTE, 0, tag, comm);
      begin = end;
    }
    return;
  }
  const std::size_t total = std::ranges::max(of_rank, {}, [](const Range& range) { return range[1]; })[1];
  std::vector<std::byte> gathered(std::min(piece, total) * rows.row_size);
  for (std::size_t begin = 0; begin < total; begin += piece) {
    const std::size_t end = std::min(begin + piece, total);
    for (int r = 0; r < ranks; ++r) {
      const Range& range = of_rank[static_cast<std::size_t>(r)];
      const std::size_t from = std::max<std::size_t>(begin, range[0]),
                        to = std::min<std::size_t>(end, range[1]);
      if (from >= to) continue;
      std::byte* const place = gathered.data() + (from - begin) * rows.row_size;
      const std::size_t bytes = (to - from) * rows.row_size;
      if (r == 0) {
        std::ranges::copy(own_part(from, to), place);
      } else {
        MPI_Recv(place, static_cast<int>(bytes), MPI_BYTE, r, tag, comm, MPI_STATUS_IGNORE);
      }
    }
    take(begin, std::span(gathered).first((end - begin) * rows.row_size));
  }
}

std::vector<std::vector<std::byte>> exchange_bytes(MPI_Comm comm,
                                                   const std::vector<std::vector<std::byte>>& outgoing) {
  const auto ranks = static_cast<std::size_t>(size(comm));
  const auto own = static_cast<std::size_t>(rank(comm));
  if (outgoing.size() != ranks) throw InternalError("exchange: one entry per rank is needed");
  std::vector<std::vector<std::byte>> incoming(ranks);
  incoming[own] = outgoing[own];
  if (ranks == 1) return incoming;
  std::vector<unsigned long> to(ranks), from(ranks);
  for (std::size_t r = 0; r < ranks; ++r) to[r] = outgoing[r].size();
  MPI_Alltoall(to.data(), 1, MPI_UNSIGNED_LONG, from.data(), 1, MPI_UNSIGNED_LONG, comm);
  // MPI counts are int: longer messages are sent in pieces.
  constexpr std::size_t piece = std::numeric_limits<int>::max() / 2;
  constexpr int tag = 7;
  std::vector<MPI_Request> requests;
  const auto in_pieces = [&](std::size_t bytes, const auto& start) {
    for (std::size_t at = 0; at < bytes; at += piece) {
      start(at, static_cast<int>(std::min(piece, bytes - at)), &requests.emplace_back(MPI_REQUEST_NULL));
    }
  };
  for (std::size_t r = 0; r < ranks; ++r) {
    if (r == own) continue;
    incoming[r].resize(from[r]);
    in_pieces(from[r], [&](std::size_t at, int count, MPI_Request* request) {
      MPI_Irecv(incoming[r].data() + at, count, MPI_BYTE, static_cast<int>(r), tag, comm, request);
    });
  }
  for (std::size_t r = 0; r < ranks; ++r) {
    if (r == own) continue;
    in_pieces(to[r], [&](std::size_t at, int count, MPI_Request* request) {
      MPI_Isend(outgoing[r].data() + at, count, MPI_BYTE, static_cast<int>(r), tag, comm, request);
    });
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return incoming;
}

}  // namespace whipple::parallel
