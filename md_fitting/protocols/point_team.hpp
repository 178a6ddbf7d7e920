// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <optional>

namespace whipple::md {

/// The ranks on which the calling rank's simulations run: its own alone, unless a PointTeam says otherwise.
MPI_Comm point_communicator();

/// Ranks that compute one point together: the first of each, its leader, takes points from the queue and
/// talks to the store, the others follow it. While a team lives, simulations run on its ranks.
class PointTeam {
 public:
  /// Splits the ranks into teams of neighbours. Collective.
  /// @throws InputError on every rank if the ranks are no multiple of those of a team
  PointTeam(MPI_Comm communicator, int ranks_per_point);
  PointTeam(const PointTeam&) = delete;
  PointTeam& operator=(const PointTeam&) = delete;
  ~PointTeam();

  [[nodiscard]] bool leads() const { return rank_ == 0; }
  /// Returns the communicator of all leaders; null on the others.
  [[nodiscard]] MPI_Comm leaders() const { return leaders_; }

  /// One point, or a further segment of it, that the team computes.
  struct Order {
    long task = 0;
    long segment = 0;
  };
  /// Leader: tells the others what they compute with it now.
  void announce(const Order& order) const;
  /// Leader: there is nothing more to do.
  void dismiss() const;
  /// Follower: waits for an order; nothing if dismissed.
  [[nodiscard]] std::optional<Order> wait() const;

 private:
  void tell(long task, long segment) const;

  MPI_Comm team_ = MPI_COMM_NULL, leaders_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1;
};

}  // namespace whipple::md
