// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/protocols/point_team.hpp"

#include <fmt/format.h>

#include <array>

#include "src/core/base/error.hpp"

namespace whipple::md {
namespace {

constexpr long dismissal = -1;

MPI_Comm& present_communicator() {
  static MPI_Comm communicator = MPI_COMM_SELF;
  return communicator;
}

}  // namespace

MPI_Comm point_communicator() { return present_communicator(); }

PointTeam::PointTeam(MPI_Comm communicator, int ranks_per_point) : size_(ranks_per_point) {
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &ranks);
  if (ranks % ranks_per_point != 0) {
    throw InputError(fmt::format("ranks_per_point = {} needs a multiple of {} ranks, not {}", ranks_per_point,
                                 ranks_per_point, ranks));
  }
  MPI_Comm_split(communicator, rank / ranks_per_point, rank, &team_);
  MPI_Comm_rank(team_, &rank_);
  MPI_Comm_split(communicator, leads() ? 0 : MPI_UNDEFINED, rank, &leaders_);
  present_communicator() = size_ > 1 ? team_ : MPI_COMM_SELF;
}

PointTeam::~PointTeam() {
  present_communicator() = MPI_COMM_SELF;
  if (leaders_ != MPI_COMM_NULL) MPI_Comm_free(&leaders_);
  MPI_Comm_free(&team_);
}

void PointTeam::tell(long task, long segment) const {
  if (size_ == 1) return;
  std::array<long, 2> numbers = {task, segment};
  MPI_Bcast(numbers.data(), 2, MPI_LONG, 0, team_);
}

void PointTeam::announce(const Order& order) const { tell(order.task, order.segment); }

void PointTeam::dismiss() const { tell(dismissal, 0); }

std::optional<PointTeam::Order> PointTeam::wait() const {
  std::array<long, 2> numbers{};
  MPI_Bcast(numbers.data(), 2, MPI_LONG, 0, team_);
  if (numbers[0] == dismissal) return std::nullopt;
  return Order{numbers[0], numbers[1]};
}

}  // namespace whipple::md
