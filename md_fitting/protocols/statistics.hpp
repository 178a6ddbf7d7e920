// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "md_fitting/data_set/data_set.hpp"

namespace whipple::md {

/// Returns the arithmetic mean of at least one value.
double mean(std::span<const double> values);

/// Returns the mean of a correlated series with its standard error. The variance of the mean is that of independent
/// samples times 2 tau, with tau the integrated autocorrelation time over a window of five tau (Sokal, in
/// Functional Integration, NATO ASI B 361 (1997) 131), corrected for the use of the sample mean (Wolff, Comput.
/// Phys. Commun. 156 (2004) 143, equation 49). A mostly oscillating series, such as the volume under a barostat,
/// has no such window: the error is then that of the means of about 16 blocks of whole periods.
/// docs/theory/molecular_dynamics.md, "Errors".
/// @throws InternalError for fewer than 16 samples; StateError if a sample is not finite.
Estimate series_mean(std::span<const double> series);

/// Holds the mean of a series with its error, and the quantities by which that error is judged.
struct SeriesMean {
  Estimate estimate;
  double variance = 0.0;  ///< of the samples about their sample mean
  double spread = 0.0;    ///< relative standard error of the variance
};
SeriesMean series_statistics(std::span<const double> series);

/// Returns the covariance of two series that were sampled together, with its standard error. If the first mostly
/// oscillates, the products of the deviations oscillate with its period, and the error is that of their means over
/// single periods; otherwise that of `series_mean`. docs/theory/molecular_dynamics.md, "Errors".
/// @throws as `series_mean`; InternalError for different lengths.
Estimate series_covariance(std::span<const double> first, std::span<const double> second);

/// Returns weighted averages over all windows of `length` samples (Hann window: the weights fall to zero at both ends).
/// They retain slow fluctuations, which determine the error of the mean, and suppress oscillations within a window.
/// @throws InternalError for a window longer than the series, or empty.
std::vector<double> window_averages(std::span<const double> series, std::size_t length);

/// Returns means over the 16 longest blocks of equal length; leftover samples at the beginning are dropped. A block
/// bootstrap draws from these means.
/// @throws InternalError for fewer than 16 samples.
std::vector<double> block_means(std::span<const double> series);

/// Returns the correlation of the errors of the means of two series that were sampled together, computed from their
/// 16 block means. Covariance and both variances come from the same blocks, so that by the Cauchy-Schwarz
/// inequality it is +-1 only for proportional series; one standard error of the result r is (1 - r^2)/sqrt(15).
/// Zero if one of the series is constant.
/// @throws InternalError for fewer than 16 samples or different lengths.
double error_correlation(std::span<const double> first, std::span<const double> second);

}  // namespace whipple::md
