// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "md_fitting/data_set/data_set.hpp"

namespace whipple::fit {

/// Returns one bootstrap replicate of a database: the means of every point over a draw, with replacement, of its
/// blocks, with P and E of a state from the same blocks. Results without blocks are perturbed by a normal deviate
/// of their stated error.
std::vector<md::PointRecord> resampled(std::span<const md::PointRecord> points, std::mt19937_64& generator);

/// Holds the scatter of the constants over replicates.
struct BootstrapResult {
  int replicates = 0;  ///< replicates that could be fitted
  int failed = 0;
  int points_with_blocks = 0, points_without = 0;
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

/// Fits replicates of the points and returns the scatter of the constants.
/// @param fit  constants from points. @throws StateError, InputError for points that cannot be fitted
/// @throws InputError for fewer than two replicates, StateError if most of them cannot be fitted
BootstrapResult bootstrap(std::span<const md::PointRecord> points, int replicates, std::uint64_t seed,
                          const std::function<Eigen::VectorXd(std::span<const md::PointRecord>)>& fit);

}  // namespace whipple::fit
