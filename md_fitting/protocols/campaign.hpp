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
  int present = 0;   ///< points that the store held already
  int computed = 0;  ///< points computed now
  int failed = 0;    ///< points that failed now
  int left = 0;      ///< points that failed in an earlier call and were left alone
  int blocked = 0;   ///< points whose dependency failed
  int molten = 0;    ///< states of isotherms and isochores, of this call or earlier, whose crystal melted
  int code = 0;      ///< exit code of what stopped the work before its end; 0: nothing did
  /// s, all teams together: in points; waiting for points of other teams; the whole call. What is missing is
  /// the cost of queue and store.
  double busy = 0.0, waiting = 0.0, elapsed = 0.0;
  /// s of processor time in points, by protocol, all ranks together.
  std::map<std::string, double> processor_time{};
};

/// Computes what is missing of the tasks, one task per rank (or team of ranks) at a time from a common queue,
/// and adds each finished point to the store at once. A task that fails is named, stored as failed with its
/// message, and the others go on. The numbers do not depend on the number of teams. A store that cannot be
/// written any more (a full disk) stops the work: its message is a warning, and the summary says so. At the
/// end the store is put in order
/// (`normalise_store`): the same points give the same bytes. Collective.
/// @param retry_failed    also compute points that failed in an earlier call
/// @param ranks_per_point ranks of a team; the last digits of the numbers depend on it
/// @throws InputError on every rank if the store is none, or the ranks are no multiple of those of a team
CampaignSummary run_campaign(std::span<const Task> tasks, const std::filesystem::path& store,
                             MPI_Comm communicator, bool retry_failed, int ranks_per_point = 1);

/// "pressure = 45.312 +- 0.011 GPa" for people: usual units, two digits of the error.
std::string format_result(const std::string& quantity, const Estimate& estimate);

/// "isotherm at specific_volume = 0.1119 cm^3/g, temperature = 293 K"
std::string short_label(const PointRecord& point);

/// One line on a point: what it is and what it brought.
std::string summarize(const PointRecord& point);

}  // namespace whipple::md
