// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <filesystem>
#include <map>
#include <span>
#include <string>

#include "md_fitting/protocols/tasks.hpp"

namespace whipple::md {

struct CampaignSummary {
  int present = 0;   ///< points already in the database
  int computed = 0;  ///< points computed in this call
  int failed = 0;    ///< points that failed in this call
  int left = 0;      ///< points that failed in an earlier call and were skipped
  int blocked = 0;   ///< points whose dependency failed
  int molten = 0;    ///< states of isotherms and isochores, of this or earlier calls, whose crystal melted
  int code = 0;      ///< exit code of the error that stopped the campaign early; 0: none
  /// s, summed over all teams: computing points; waiting for points of other teams; the whole call. The remainder
  /// is the cost of queue and database.
  double busy = 0.0, waiting = 0.0, elapsed = 0.0;
  /// s of processor time spent on points, by protocol, all ranks together.
  std::map<std::string, double> processor_time{};
};

/// Computes the missing points of the tasks, one task per rank (or team of ranks) at a time from a common queue,
/// and adds each finished point to the database immediately. A failed task is reported and stored as failed with
/// its message; the others continue. The numbers do not depend on the number of teams. If the database can no
/// longer be written (a full disk), the campaign stops with a warning, which the summary records. At the end the
/// database is normalised (`normalise_store`): the same points give the same bytes. Collective.
/// @param retry_failed    also compute points that failed in an earlier call
/// @param ranks_per_point ranks of a team; the last digits of the numbers depend on it
/// @throws InputError on every rank if the file is not a database, or if the number of ranks is not a multiple of
/// the team size
CampaignSummary run_campaign(std::span<const Task> tasks, const std::filesystem::path& store,
                             MPI_Comm communicator, bool retry_failed, int ranks_per_point = 1);

}  // namespace whipple::md
