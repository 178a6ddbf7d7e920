// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace whipple::sweep {

/// Draws independent points of the unit cube; equal seeds give equal points.
/// @returns `count` points of `dimensions` numbers in (0, 1]
std::vector<std::vector<double>> random_samples(std::size_t count, std::size_t dimensions,
                                                std::uint64_t seed);

/// Draws points of the unit cube with one in each of `count` strata along every dimension (McKay, Beckman and Conover,
/// Technometrics 21 (1979) 239).
std::vector<std::vector<double>> latin_hypercube(std::size_t count, std::size_t dimensions,
                                                 std::uint64_t seed);

/// Tells how the values of an input were chosen: at random, or from a list that combines with all other values.
enum class Design : std::uint8_t { sampled, listed };

/// Estimates the first-order index of Sobol, Var E(y | x) / Var y: the part of the variance that would vanish if the
/// input were known. The mean of y over equal x gives it for lists. Sorted by a sampled input, neighbours have almost
/// the same x, so that products of neighbouring outputs estimate E(E(y | x)^2) (Gamboa, Gremaud, Klein and Lagnoux,
/// Bernoulli 28 (2022) 2343; here without the product of the last and the first); the standard error is about
/// 1/sqrt(n).
/// @returns NaN for fewer than three samples or an output that does not vary
double first_order_index(std::span<const double> x, std::span<const double> y, Design design);

}  // namespace whipple::sweep
