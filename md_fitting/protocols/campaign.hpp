// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mpi.h>

#include <filesystem>
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
};

/// Computes what is missing of the tasks, one task per rank at a time from a common queue, and adds each
/// finished point to the store at once. A task that fails is named, stored as failed with its message, and
/// the others go on. The numbers do not depend on the number of ranks. Collective.
/// @param retry_failed also compute points that failed in an earlier call
/// @throws InputError on every rank if the store cannot be written.
CampaignSummary run_campaign(std::span<const Task> tasks, const std::filesystem::path& store,
                             MPI_Comm communicator, bool retry_failed);

/// "pressure = 45.312 +- 0.011 GPa" for people: usual units, two digits of the error.
std::string format_result(const std::string& quantity, const Estimate& estimate);

/// "isotherm at specific_volume = 0.1119 cm^3/g, temperature = 293 K"
std::string short_label(const PointRecord& point);

/// One line on a point: what it is and what it brought.
std::string summarize(const PointRecord& point);

}  // namespace whipple::md
