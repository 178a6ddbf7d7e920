// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <optional>

namespace whipple::md {

/// Returns the communicator for the simulations of the calling rank: the rank alone, unless a PointTeam exists.
MPI_Comm point_communicator();

/// Groups ranks that compute one point together: the first rank of each team, its leader, takes points from the
/// queue and accesses the database; the others follow it. While a team exists, simulations run on its ranks.
class PointTeam {
 public:
  /// Splits the ranks into teams of consecutive ranks. Collective.
  /// @throws InputError on every rank if the number of ranks is not a multiple of the team size
  PointTeam(MPI_Comm communicator, int ranks_per_point);
  PointTeam(const PointTeam&) = delete;
  PointTeam& operator=(const PointTeam&) = delete;
  ~PointTeam();

  [[nodiscard]] bool leads() const { return rank_ == 0; }
  /// Returns the communicator of all leaders; null on the others.
  [[nodiscard]] MPI_Comm leaders() const { return leaders_; }

  /// Identifies a point, or a further segment of it, for the team to compute.
  struct Order {
    long task = 0;
    long segment = 0;
  };
  /// Announces to the followers the order that they compute with the leader. Leader only.
  void announce(const Order& order) const;
  /// Dismisses the followers at the end of the campaign. Leader only.
  void dismiss() const;
  /// Waits for an order; returns nothing if dismissed. Followers only.
  [[nodiscard]] std::optional<Order> wait() const;

 private:
  void tell(long task, long segment) const;

  MPI_Comm team_ = MPI_COMM_NULL, leaders_ = MPI_COMM_NULL;
  int rank_ = 0, size_ = 1;
};

}  // namespace whipple::md
