// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "md_fitting/data_set/data_set.hpp"

namespace whipple::md {

/// Mean of a correlated series with its standard error by block averages: the series is cut into blocks of
/// growing length, and the largest error over all lengths that leave at least 16 blocks is taken (Flyvbjerg
/// and Petersen, J. Chem. Phys. 91 (1989) 461, who read the plateau; the largest is a little conservative and
/// needs no reader).
/// @throws InternalError for fewer than 16 samples; StateError if a sample is not finite.
Estimate block_average(std::span<const double> series);

/// Means over the 16 longest blocks of equal length; what is left over at the beginning is dropped. They are
/// what a bootstrap over blocks draws from.
/// @throws InternalError for fewer than 16 samples.
std::vector<double> block_means(std::span<const double> series);

/// Correlation (-1 ... 1) of the errors of the means of two series that were sampled together.
double error_correlation(std::span<const double> first, std::span<const double> second);

}  // namespace whipple::md
