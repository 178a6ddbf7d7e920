// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Figures of the problems with exact solutions, for tests and for docs/generated/exact_suite.md.
namespace whipple::verification::exact {

/// One measured number beside the one of the exact solution.
struct Figure {
  std::string name;
  double exact;  ///< NaN: there is none
  double value;
};

/// A row of numbers: layers from a wall, a contact or a free surface inwards.
struct Profile {
  std::string name;
  std::vector<double> values;
};

/// What one run of a problem at one resolution gave.
struct Result {
  std::string resolution;  ///< as it stands in the table, "0.2 mm", "100 cells"
  double cell = 0.0;       ///< in units of the problem, for orders
  std::vector<Figure> figures;
  std::vector<Profile> profiles;

  void add(std::string name, double exact, double value) {
    figures.push_back({std::move(name), exact, value});
  }
  void add(std::string name, std::vector<double> values) {
    profiles.push_back({std::move(name), std::move(values)});
  }
  /// @throws StateError if there is no such figure
  [[nodiscard]] double at(std::string_view figure) const;
};

/// Order of convergence of a figure between two results: log of the ratio of the deviations from the exact
/// value over that of the cells.
double order_of(const Result& coarse, const Result& fine, std::string_view figure);

/// The figures of one problem as a table of Markdown, one column per resolution, with the orders of those
/// whose name begins with "L1", and its profiles as a second table.
std::string markdown(std::span<const Result> results);

/// Prints the figures and profiles of a result, one a line.
void print(const std::string& problem, const Result& result);

}  // namespace whipple::verification::exact
