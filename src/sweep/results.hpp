// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "src/sweep/bisection.hpp"
#include "src/sweep/computing.hpp"
#include "src/sweep/points.hpp"

namespace whipple::sweep {

/// Holds one result of a point (SI).
struct Result {
  std::string name, unit;
  double value;
};

/// Reads the results of a finished point: the wanted ones, or all measures. Missing ones are left out, as are measures
/// that were made with other options than those of the study.
/// @throws InputError if a table of the run is damaged
std::vector<Result> read_results(const Computer& computer, const Point& point, const Record& record,
                                 std::span<const Wanted> wanted);

/// Holds a table of a study; a column holds numbers or words.
struct Column {
  std::string name, unit, meaning;
  std::vector<double> numbers;
  std::vector<std::string> words;  ///< empty: numbers
};
struct Table {
  std::string name, meaning;
  std::vector<Column> columns;
  [[nodiscard]] std::size_t rows() const {
    return columns.empty() ? 0 : std::max(columns.front().numbers.size(), columns.front().words.size());
  }
};

/// Holds the results of a study.
struct Results {
  Table points;         ///< one row per point and variant
  Table bands;          ///< one row per point, over its variants; no columns without variants
  Table sensitivities;  ///< first-order indices; no columns with fewer than three points
  Table limits;         ///< one row per group; no columns without [find]
  std::vector<Variable> variables;
  std::vector<std::string> quantities;  ///< columns of `points` that hold results
};

/// Returns the verdict of a point on the threshold of the limit.
/// @throws InputError if the threshold has another unit than the quantity
Verdict verdict_of(const Plan& plan, const Computer& computer, const Point& point);

/// Searches the limits: computes the middles of all changes of verdicts, of all groups and variants together, until
/// each is narrower than the tolerance. It waits for points that were ended from outside or are computed elsewhere: it
/// goes on when it is called again.
/// @param points  those of the plan; the computed ones are added
/// @returns false if a signal ended it before
bool search(const Plan& plan, Computer& computer, std::vector<Point>& points);

/// Collects the tables from the finished points.
/// @param points  all, those of the search included
Results collect(const Plan& plan, const Computer& computer, std::span<const Point> points);

}  // namespace whipple::sweep
