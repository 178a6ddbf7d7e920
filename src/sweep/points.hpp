// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/case/case.hpp"
#include "src/sweep/study.hpp"

namespace whipple::sweep {

/// Describes a varied number or word: a column of the table.
struct Variable {
  std::string name;  ///< the key
  std::string unit = {};
  bool is_number = true;
  bool is_sampled = false;
};

/// Holds one computation: the case with changed keys.
struct Point {
  std::vector<std::string> texts;  ///< value of each variable as written
  std::vector<double> numbers;     ///< the same as a number in the unit of the variable; NaN for words
  std::vector<std::pair<std::string, std::string>> changes;  ///< keys of the case and their values
  std::map<std::string, std::string> materials;              ///< changed material files by name
  std::size_t group = 0;  ///< number of its values; its numerical variants share it
  std::string cell_size;  ///< of the variant; empty: that of the case
  double offset = 0.0;    ///< of the variant, in cells
  std::string digest;     ///< of the complete input

  /// Returns the name of its run folder.
  [[nodiscard]] std::string name() const { return digest.substr(0, 16); }
};

/// Holds a study with the case that it changes.
struct Plan {
  Study study;
  cases::Case base;
  std::vector<Variable> variables;  ///< with the key that is sought, if there is one, last
  std::vector<Point> points;  ///< all of them; of a limit the first ones, `scan` of each group and variant
  double most_memory = 0.0;   ///< bytes that the largest point is expected to take
};

/// Reads a study and prepares all points: their cases are read and checked.
/// @param is_asked_to_end  called between two points
/// @returns nothing if it was asked to end
/// @throws InputError with the faults of the study, its case, and its points
std::optional<Plan> make_plan(const std::filesystem::path& study,
                              const std::function<bool()>& is_asked_to_end);

/// Returns a point of the study with another value of the key that is sought.
/// @throws InputError if its case is at fault
Point with_sought(const Plan& plan, const Point& point, double value);

/// Returns the changes of a point, with its materials written into a folder.
std::vector<std::pair<std::string, std::string>> changes_in(const Point& point,
                                                            const std::filesystem::path& folder);

}  // namespace whipple::sweep
