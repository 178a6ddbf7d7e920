// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "src/case/case.hpp"
#include "src/io/history.hpp"
#include "src/solver/phase_masses.hpp"
#include "src/solver/simulation.hpp"

namespace whipple::run {

/// Holds the source data of the columns of history.csv: a simulation, and sums and maxima over all ranks (SI).
struct HistorySource {
  const solver::RunState& state;
  const solver::Ledger& ledger;
  const solver::Totals& totals;
  solver::TimeStepBound time_step_bound;
  solver::State::Equilibrium equilibrium;
  std::vector<solver::PhaseMasses> by_body;
  solver::PhaseMasses all_bodies;
  solver::Figures figures;
  double particles = 0.0, elements = 0.0;

  /// Computes the sums and maxima. Collective.
  explicit HistorySource(const solver::Simulation& simulation);
};

/// Describes a column of history.csv.
struct HistoryColumn {
  std::string name;
  std::string unit;
  std::string meaning;
  std::function<double(const HistorySource&)> value;
};

/// Lists the columns of a case, in the order of the file.
std::vector<HistoryColumn> history_columns(const cases::Case& setup);

/// Lists all available columns as rows `| name | unit | meaning |` of docs/manual/output.md.
std::string history_columns_as_markdown();

/// Lists the accounts of energy that leaves the resolved motion, and the limiters, as two tables of
/// docs/manual/output.md.
std::string accounts_as_markdown();

/// Describes columns for other programs (columns.json): a list of {name, unit, meaning}; limiters also have `limiter`,
/// the limited quantity; accounts of energy that leaves the resolved motion have `taken_by` and `taken_to`.
std::string columns_as_json(std::span<const HistoryColumn> columns);

/// Computes the current row. Collective.
std::vector<io::HistoryValue> history_row(std::span<const HistoryColumn> columns,
                                          const solver::Simulation& simulation);

}  // namespace whipple::run
