// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "md_fitting/data_set/data_set.hpp"

namespace whipple::md {

/// Arithmetic mean of at least one value.
double mean(std::span<const double> values);

/// Mean of a correlated series with its standard error. The variance of the mean is that of independent
/// samples times 2 tau, tau the integrated autocorrelation time over a window of five tau (Sokal, in
/// Functional Integration, NATO ASI B 361 (1997) 131), corrected for the mean being the series' own (Wolff,
/// Comput. Phys. Commun. 156 (2004) 143, equation 49). A series that mostly oscillates, as the volume does
/// under a barostat, has no such window: there the error is that of the means of about 16 blocks of whole
/// periods. docs/theory/molecular_dynamics.md, "Errors".
/// @throws InternalError for fewer than 16 samples; StateError if a sample is not finite.
Estimate series_mean(std::span<const double> series);

/// Holds the mean of a series with its error, and the numbers by which that error is judged.
struct SeriesMean {
  Estimate estimate;
  double variance = 0.0;  ///< of the samples about their own mean
  double spread = 0.0;    ///< standard error of the variance over the variance
};
SeriesMean series_statistics(std::span<const double> series);

/// Covariance of two series that were sampled together, with its standard error. If the first mostly
/// vibrates, the products of the deviations beat with its period, and the error is that of their means over
/// single periods; else that of `series_mean`. docs/theory/molecular_dynamics.md, "Errors".
/// @throws as `series_mean`; InternalError for different lengths.
Estimate series_covariance(std::span<const double> first, std::span<const double> second);

/// Weighted averages over all windows of `length` samples (Hann window: the weights fall to zero at both
/// ends). They keep what wanders slowly, from which the error of the mean comes, and lose what swings within
/// a window.
/// @throws InternalError for a window longer than the series, or empty.
std::vector<double> window_averages(std::span<const double> series, std::size_t length);

/// Means over the 16 longest blocks of equal length; what is left over at the beginning is dropped. They are
/// what a bootstrap over blocks draws from.
/// @throws InternalError for fewer than 16 samples.
std::vector<double> block_means(std::span<const double> series);

/// Correlation of the errors of the means of two series that were sampled together: that of their 16 block
/// means. Covariance and both variances come from the same blocks, so that by Cauchy's and Schwarz's
/// inequality it is +-1 only for series that are proportional; one standard error of the result r is (1 -
/// r^2)/sqrt(15). Zero if one of the series is constant.
/// @throws InternalError for fewer than 16 samples or different lengths.
double error_correlation(std::span<const double> first, std::span<const double> second);

}  // namespace whipple::md
